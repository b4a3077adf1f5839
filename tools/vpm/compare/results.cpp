// Numbers and what they are called.
#include "compare/results.h"

#include <fmt/format.h>
#include <sys/utsname.h>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <thread>

#include "compare/store.h"
#include "json.h"
#include "vpm/base/parallel.h"
#include "vpm/base/version.h"

namespace vpm::tools {
namespace {

/// Null where it is not known.
Json number_or_null(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }
Json interval_json(const ConfidenceInterval& b) {
  return {{"value", number_or_null(b.value)}, {"lo", number_or_null(b.lo)}, {"hi", number_or_null(b.hi)}};
}

Json comparison_json(const Comparison& comparison) {
  Json json = interval_json(comparison.ratio);
  json["p"] = comparison.known ? number_or_null(comparison.p) : Json(nullptr);
  json["p_holm"] = comparison.known ? number_or_null(comparison.p_holm) : Json(nullptr);
  return json;
}

/// The processor's name, as Linux names it.
std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name")) return line.substr(std::min(line.size(), line.find(':') + 2));
  return "unknown";
}

Json machine_json() {
  utsname system{};
  uname(&system);
  return {{"processor", processor()},
          {"cores", std::thread::hardware_concurrency()},
          {"threads", thread_count()},
          {"system", fmt::format("{} {} {}", system.sysname, system.release, system.machine)}};
}

Json budget_json(const BudgetSummary& budget, const MethodSummary& method, size_t b) {
  Json runs = Json::array();
  for (size_t i = 0; i < budget.each.size(); ++i) {
    Json run = Json::parse(cost_json(budget.costs[i]));
    run["mse"] = number_or_null(budget.each[i].mse);
    run["relative_mse"] = number_or_null(budget.each[i].relative_mse);
    run["relative_mse_of_pbrt"] = number_or_null(budget.each[i].relative_mse_of_pbrt);
    run["mean_ratio"] = number_or_null(budget.each[i].mean_ratio);
    run["variance"] = number_or_null(budget.errors.deviations[i]);
    runs.push_back(std::move(run));
  }
  const RepeatedErrors& errors = budget.errors;
  return {{"mse", interval_json(errors.mse)},
          {"relative_mse", interval_json(errors.relative_mse)},
          {"bias", interval_json(errors.bias)},
          {"own_bias", method.own_bias[b] ? interval_json(method.own_bias[b]->value) : Json(nullptr)},
          {"why_bias_unknown", budget.why_bias_unknown},
          {"squared_bias", interval_json(errors.squared_bias)},
          {"variance", number_or_null(errors.variance)},
          {"efficiency_by_mse", comparison_json(method.by_mse[b])},
          {"efficiency_by_variance", comparison_json(method.by_variance[b])},
          {"efficiency", comparison_json(method.by_relative_mse[b])},
          {"runs", std::move(runs)}};
}

Json verdict_json(const BiasEvidence& evidence) {
  return {{"says", verdict_name(evidence.verdict)},
          {"p", is_judged(evidence) ? number_or_null(evidence.p) : Json(nullptr)},
          {"p_holm", is_judged(evidence) ? number_or_null(evidence.p_holm) : Json(nullptr)},
          {"why", evidence.why}};
}

Json method_json(const ComparisonPlan& plan, const SceneResults& scene, size_t m) {
  const MethodSummary& summary = scene.summary.methods[m];
  Json budgets = Json::array(), equal_error = Json::array();
  for (size_t b = 0; b < plan.budgets.size(); ++b) budgets.push_back(budget_json(scene.budgets[m][b], summary, b));
  for (const std::optional<double>& cost : summary.equal_error)
    equal_error.push_back(cost ? Json(*cost) : Json(nullptr));
  return {{"name", plan.methods[m].name},
          {"overrides", plan.methods[m].settings},
          {"settings", scene.settings[m]},
          {"scene_hash", scene.hashes[m]},
          {"slope", interval_json(summary.slope)},
          {"equal_error", std::move(equal_error)},
          {"verdict", verdict_json(scene.verdicts[m])},
          {"techniques", techniques_json(scene.techniques[m])},
          {"budgets", std::move(budgets)}};
}

Json scene_json(const ComparisonPlan& plan, const ComparedScene& compared, const SceneResults& scene) {
  Json methods = Json::array(), pairs = Json::array();
  for (size_t m = 0; m < plan.methods.size(); ++m) methods.push_back(method_json(plan, scene, m));
  for (const PairSummary& pair : scene.summary.pairs) {
    Json json{{"first", pair.first}, {"second", pair.second}};
    json.update(comparison_json(pair.comparison));
    pairs.push_back(std::move(json));
  }
  return {{"name", compared.name},
          {"file", compared.file},
          {"overrides", compared.settings},
          {"text", scene.scene_text},
          {"width", scene.width},
          {"height", scene.height},
          {"reference", {{"source", scene.reference}, {"relative_mse", scene.reference_error}}},
          {"best", scene.summary.best_by_relative_mse},
          {"best_by_mse", scene.summary.best_by_mse},
          {"best_by_variance", scene.summary.best_by_variance},
          {"targets", scene.summary.targets},
          {"methods", std::move(methods)},
          {"pairs", std::move(pairs)}};
}

size_t judged_count(const std::vector<SceneResults>& scenes) {
  size_t count = 0;
  for (const SceneResults& scene : scenes)
    for (const BiasEvidence& evidence : scene.verdicts) count += is_judged(evidence);
  return count;
}

/// Text in quotes, those in it doubled.
std::string csv_text(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string with_interval(const ConfidenceInterval& b) {
  return fmt::format("{:.3g} [{:.3g}, {:.3g}]", b.value, b.lo, b.hi);
}

std::string percent_with_interval(const ConfidenceInterval& b) {
  return with_interval({100.0 * b.value, 100.0 * b.lo, 100.0 * b.hi});
}

std::string efficiency_text(size_t m, size_t best, const Comparison& comparison) {
  return m == best ? "best" : with_interval(comparison.ratio);
}

/// The methods at one budget.
std::string equal_cost_table(const ComparisonPlan& plan, const SceneResults& scene, size_t b) {
  constexpr const char* kRow = "    {:32} {:>28} {:>26} {:>24} {:>24}\n";
  std::string text = fmt::format("  at {:g} {}:\n", plan.budgets[b], unit_name(plan.unit)) +
                     fmt::format(kRow, "", "relative MSE", "bias, %", "efficiency over best", "by variance alone");
  for (size_t m = 0; m < plan.methods.size(); ++m) {
    const BudgetSummary& budget = scene.budgets[m][b];
    const MethodSummary& method = scene.summary.methods[m];
    text += fmt::format(kRow, plan.methods[m].name, with_interval(budget.errors.relative_mse),
                        budget.why_bias_unknown.empty() ? percent_with_interval(budget.errors.bias) : "not determined",
                        efficiency_text(m, scene.summary.best_by_relative_mse[b], method.by_relative_mse[b]),
                        efficiency_text(m, scene.summary.best_by_variance[b], method.by_variance[b]));
  }
  return text;
}

/// What is known of each method's bias at the last budget.
std::string verdicts_text(const ComparisonPlan& plan, const SceneResults& scene, size_t judged) {
  std::string text =
      fmt::format("  bias at the last budget{} ({} verdicts, family-wise at most {:g} %):\n",
                  plan.baseline ? " against " + plan.methods[*plan.baseline].name : "", judged, 100.0 * kFalseVerdicts);
  for (size_t m = 0; m < plan.methods.size(); ++m) {
    const BiasEvidence& evidence = scene.verdicts[m];
    if (evidence.verdict == BiasVerdict::baseline) continue;
    const std::optional<Tested>& own = scene.summary.methods[m].own_bias.back();
    const std::string bias = percent_with_interval(own ? own->value : scene.budgets[m].back().errors.bias);
    text +=
        fmt::format("    {:32} {:15} {}\n", plan.methods[m].name, verdict_name(evidence.verdict),
                    is_judged(evidence) ? fmt::format("{} %, p (Holm) {:.2g}", bias, evidence.p_holm) : evidence.why);
  }
  return text;
}

std::string pairs_text(const ComparisonPlan& plan, const SceneResults& scene) {
  constexpr double kRate = 0.05;
  std::string text;
  size_t unknown = 0;
  for (const PairSummary& pair : scene.summary.pairs) {
    const Comparison& c = pair.comparison;
    unknown += !c.known;
    if (!c.known || c.p_holm >= kRate) continue;
    const bool first = c.ratio.value > 1.0;
    const ConfidenceInterval ratio =
        first ? c.ratio : ConfidenceInterval{1.0 / c.ratio.value, 1.0 / c.ratio.hi, 1.0 / c.ratio.lo};
    text += fmt::format("    {} is {} times as efficient as {} (p (Holm) {:.1g})\n",
                        plan.methods[first ? pair.first : pair.second].name, with_interval(ratio),
                        plan.methods[first ? pair.second : pair.first].name, c.p_holm);
  }
  if (text.empty()) text = "    none\n";
  if (unknown > 0) text += fmt::format("    not determined: {} pairs, for the reference is too noisy\n", unknown);
  return fmt::format("  significant differences among {} pairs, at the last budget (family-wise at most {:g} %):\n{}",
                     scene.summary.pairs.size(), 100.0 * kRate, text);
}

}  // namespace

std::string unit_name(CostUnit unit) {
  switch (unit) {
    case CostUnit::seconds:
      return "s of CPU time";
    case CostUnit::passes:
      return "passes";
    case CostUnit::photons:
      return "photons emitted";
    case CostUnit::lookups:
      break;
  }
  return "look-ups of density";
}

std::string results_json(const ComparisonPlan& plan, const std::vector<SceneResults>& scenes) {
  Json all = Json::array();
  for (size_t i = 0; i < scenes.size(); ++i) all.push_back(scene_json(plan, plan.scenes[i], scenes[i]));
  const Json json{
      {"vpm", version()},
      {"title", plan.title},
      {"experiment", plan.text},
      {"machine", machine_json()},
      {"seed", plan.seed},
      {"repetitions", plan.repetitions},
      {"unit", unit_name(plan.unit)},
      {"budgets", plan.budgets},
      {"baseline", plan.baseline ? Json(plan.methods[*plan.baseline].name) : Json(nullptr)},
      {"verdicts", {{"rate", kFalseVerdicts}, {"count", judged_count(scenes)}}},
      {"formulas",
       {{"mse", "mean over pixels and channels of (I - R)^2, less the reference's own variance"},
        {"relative_mse", "mean of (I - R)^2 / (R^2 + 0.01 mean(R)^2), mean(R) by channel, less the reference's own"},
        {"relative_mse_of_pbrt", "mean of (I - R)^2 / (R + 0.01)^2, less the reference's own"},
        {"bias",
         "mean over pixels and channels of I over that of R, less 1; the interval has the reference's noise in it"},
        {"own_bias",
         "the mean over that of the baseline, less 1: what is left of bias that all methods share; by the "
         "jackknife over pairs of repetitions"},
        {"verdict",
         "of the bias at the last budget (of the own bias, where there is a baseline): p_holm is p, corrected for "
         "all verdicts of the experiment"},
        {"efficiency_by_variance",
         "1 / (variance x cost), over that of the best method; the variance is half the mean square of differences "
         "between two repetitions, over the scale of relative_mse"},
        {"squared_bias", "relative MSE of the mean of repetitions, less its variance"},
        {"efficiency", "1 / (relative MSE x cost), over that of the best method; whether two differ is seen by pairs"},
        {"share_of_light",
         "of a technique, where a method has integrator.layers: the sum over pixels and channels of what it finds, "
         "times its shares, over that of all techniques; mean over repetitions, as all of techniques"},
        {"found_alone",
         "the sum of what the technique finds without its shares, over the same: 1 where it alone finds all light, "
         "more where it finds paths in several ways"},
        {"variance_of_technique",
         "mean of V / (R^2 + 0.01 mean(R)^2), R the run's own picture, V the variance of the mean of what the "
         "technique "
         "finds, times its shares, estimated from passes"},
        {"intervals",
         "95 %: Student's t over repetitions; ratios: jackknife of their logarithm over pairs of repetitions"},
        {"p", "Student's t of the jackknife over pairs of repetitions; p_holm: corrected for all pairs of a scene"}}},
      {"scenes", std::move(all)}};
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string results_csv(const ComparisonPlan& plan, const std::vector<SceneResults>& scenes) {
  std::string csv = "scene,method,repetition,seed,budget,";
  const RunCost none;
  for_each_counter(none, [&](const std::string& name, const auto&) { csv += name + ','; });
  csv += "mse,relative_mse,relative_mse_of_pbrt,mean_ratio,variance,vpm,scene_hash,settings,processor,threads\n";
  const std::string made_by = fmt::format("{},{}", csv_text(processor()), thread_count());
  for (size_t s = 0; s < scenes.size(); ++s)
    for (size_t m = 0; m < plan.methods.size(); ++m)
      for (size_t b = 0; b < plan.budgets.size(); ++b)
        for (size_t r = 0; r < scenes[s].budgets[m][b].each.size(); ++r) {
          csv += fmt::format("{},{},{},{},{},", csv_text(plan.scenes[s].name), csv_text(plan.methods[m].name), r,
                             plan.seed + r, plan.budgets[b]);
          for_each_counter(scenes[s].budgets[m][b].costs[r],
                           [&](const std::string&, const auto& number) { csv += fmt::format("{},", number); });
          const PictureErrors& e = scenes[s].budgets[m][b].each[r];
          csv +=
              fmt::format("{},{},{},{},{},{},{},{},{}\n", e.mse, e.relative_mse, e.relative_mse_of_pbrt, e.mean_ratio,
                          scenes[s].budgets[m][b].errors.deviations[r], csv_text(std::string(version())),
                          scenes[s].hashes[m], csv_text(scenes[s].settings[m]), made_by);
        }
  return csv;
}

std::string results_text(const ComparisonPlan& plan, const std::vector<SceneResults>& scenes) {
  std::string text;
  for (size_t i = 0; i < scenes.size(); ++i) {
    text += fmt::format("{} (reference: {})\n", plan.scenes[i].name, scenes[i].reference);
    for (size_t b = 0; b < plan.budgets.size(); ++b) text += equal_cost_table(plan, scenes[i], b);
    text += verdicts_text(plan, scenes[i], judged_count(scenes));
    text += pairs_text(plan, scenes[i]);
  }
  return text;
}

}  // namespace vpm::tools
