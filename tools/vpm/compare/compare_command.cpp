// vpm compare: an experiment in, tables and a page out.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <set>

#include "commands.h"
#include "compare/page.h"
#include "compare/results.h"
#include "compare/run.h"
#include "compare/store.h"
#include "pass_run.h"
#include "vpm/base/atomic_file.h"
#include "vpm/base/cancel.h"
#include "vpm/base/error.h"
#include "vpm/base/parallel.h"
#include "vpm/base/progress.h"
#include "vpm/base/version.h"
#include "vpm/image/metrics.h"
#include "vpm/input/source.h"
#include "vpm/integrators/describe.h"
#include "vpm/medium/distance/strategy.h"
#include "vpm/study/check.h"
#include "vpm/study/compare/exact_picture.h"
#include "vpm/study/compare/experiment.h"

namespace vpm::tools {
namespace {

/// A method on a scene, ready to run.
struct Entrant {
  RenderJob loaded;
  std::string identity;  // of its runs, without the seed
};

/// A scene with all its methods.
struct Contest {
  const ComparedScene* compared = nullptr;
  std::vector<std::unique_ptr<Entrant>> methods;
  std::unique_ptr<Entrant> reference_entrant;  // null where no reference is rendered
  Reference reference;
};

std::vector<std::string> joined(std::vector<std::string> first, const std::vector<std::string>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

/// Its settings, and those that each of its runs chooses.
std::string settings_text(const RenderJob& loaded) {
  std::string text = settings_line(loaded.settings);
  if (!loaded.automatic.keys.empty())
    text += fmt::format("; chosen by each run: {}", fmt::join(loaded.automatic.keys, " "));
  return text;
}

/// Only time can pay for a pilot, and it chooses for some time; references have no end that is a time.
void check_choices(const Entrant& entrant, CostUnit unit, const std::string& who) {
  if (!entrant.loaded.automatic.keys.empty() && unit != CostUnit::seconds)
    throw InputError(
        fmt::format("{}: settings are chosen for a time, but budgets are in {}: name a value of {}, or write "
                    "unit = \"seconds\"",
                    who, unit_name(unit), fmt::join(entrant.loaded.automatic.to_be_named(), ", ")));
}

/// `who` it is for, and its place in the experiment's file, as messages name it.
std::unique_ptr<Entrant> make_entrant(const ComparedScene& scene, const std::string& who, const std::string& place,
                                      const std::vector<std::string>& settings, const std::string& purpose) {
  try {
    auto entrant = std::make_unique<Entrant>(Entrant{load_scene(scene.file, joined(scene.settings, settings)), ""});
    if (entrant->loaded.scene.camera.crop)
      throw InputError("whole pictures are compared; leave out film.crop, and make the film smaller");
    choose_default_radii(entrant->loaded);  // all repetitions have the same
    entrant->identity = fmt::format("vpm {}; scene {}; {}; {}", version(), entrant->loaded.hash,
                                    settings_text(entrant->loaded), purpose);
    return entrant;
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {} on scene '{}': {}", place, who, scene.name, error.what()));
  }
}

std::string run_purpose(const ComparisonPlan& plan) {
  std::string text = fmt::format("{} threads; budgets in {}:", thread_count(), unit_name(plan.unit));
  for (const double budget : plan.budgets) text += fmt::format(" {}", budget);
  return text;
}

/// The reference's. A method may have the reference's settings, and must not have its random numbers: no repetition has
/// this seed.
uint64_t reference_seed(const ComparisonPlan& plan) { return plan.seed + (uint64_t{1} << 40); }

void check_size(const Image& reference, const Camera& camera, const ComparedScene& scene) {
  if (reference.width == camera.width && reference.height == camera.height) return;
  throw InputError(fmt::format("{}: the reference of scene '{}' has {} x {} pixels, but a method renders {} x {}",
                               scene.place, scene.name, reference.width, reference.height, camera.width,
                               camera.height));
}

Reference exact_reference(const ComparedScene& scene) {
  const std::unique_ptr<Entrant> entrant = make_entrant(scene, "exact picture", scene.place, {}, "");
  try {
    const Image picture = exact_picture(entrant->loaded.scene);
    return {picture, Image(picture.width, picture.height)};
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: scene '{}': {}", scene.place, scene.name, error.what()));
  }
}

/// Loads everything that will be needed, so that what is wrong is refused before anything is rendered.
std::vector<Contest> load_contests(const ComparisonPlan& plan) {
  std::vector<Contest> contests;
  for (const ComparedScene& scene : plan.scenes) {
    Contest contest;
    contest.compared = &scene;
    for (const Method& method : plan.methods) {
      const std::string who = fmt::format("method '{}'", method.name);
      contest.methods.push_back(make_entrant(scene, who, method.place, method.settings, run_purpose(plan)));
      check_choices(*contest.methods.back(), plan.unit, method.place + ": " + who);
    }
    if (scene.source == ReferenceSource::exact) {
      contest.reference = exact_reference(scene);
    } else if (scene.source == ReferenceSource::rendered) {
      const std::string seed = fmt::format("render.seed={}", reference_seed(plan));
      contest.reference_entrant =
          make_entrant(scene, "reference", scene.place, joined(scene.rendered.settings, {seed}),
                       fmt::format("reference of relative MSE {}, {}", scene.rendered.error, seed));
      refuse_automatic(contest.reference_entrant->loaded, "the reference of vpm compare");
      const Camera& camera = contest.reference_entrant->loaded.scene.camera;
      contest.reference.mean = contest.reference.variance = Image(camera.width, camera.height);
    } else {
      contest.reference = read_reference(scene.reference_file);
      if (contest.reference.part)
        throw InputError(fmt::format("{}: the reference of scene '{}' is a crop; whole pictures are compared",
                                     scene.place, scene.name));
    }
    for (const auto& method : contest.methods) check_size(contest.reference.mean, method->loaded.scene.camera, scene);
    contests.push_back(std::move(contest));
  }
  return contests;
}

/// Says once what methods leave out of scenes.
void print_left_out(const std::vector<Contest>& contests, const ComparisonPlan& plan) {
  std::set<std::string> printed;
  for (const Contest& contest : contests)
    for (size_t m = 0; m < plan.methods.size(); ++m)
      if (const std::string& replaced = contest.methods[m]->loaded.replaced; !replaced.empty())
        if (const std::string note = fmt::format("note: method '{}': {}\n", plan.methods[m].name, replaced);
            printed.insert(note).second)
          fmt::print(stderr, "{}", note);
}

/// Finds the reference of a scene, or makes it.
void make_reference(Contest& contest, const Store& store, const CompareOptions& options) {
  if (!contest.reference_entrant) return;
  if (std::optional<Reference> known = store.find_reference(contest.reference_entrant->identity)) {
    contest.reference = std::move(*known);
  } else {
    const RenderResult result =
        run_reference(contest.reference_entrant->loaded, contest.compared->rendered.error, options.progress);
    cancellation_point();
    contest.reference = {result.film.mean(), result.film.variance_of_mean()};
    store.add_reference(contest.reference_entrant->identity, contest.reference);
  }
  if (contest.reference_entrant->loaded.settings.integrator != Integrator::path) contest.reference.doubt = kOfPhotons;
}

/// The first repetition alone keeps what techniques find as pictures, so it is another run than one of its seed that
/// was not the first.
std::string run_identity(const Entrant& entrant, const ComparisonPlan& plan, int repetition) {
  const bool keeps_parts = repetition == 0 && entrant.loaded.settings.combined.layers;
  return fmt::format("{}; seed {}{}", entrant.identity, plan.seed + static_cast<uint64_t>(repetition),
                     keeps_parts ? "; with layers" : "");
}

/// Makes the runs that are missing. Repetitions are interleaved, and each begins with another method, so that what
/// changes about the machine in the meantime meets all methods alike.
void make_runs(const std::vector<Contest>& contests, const ComparisonPlan& plan, const Store& store,
               const CompareOptions& options) {
  const size_t methods = plan.methods.size();
  const auto repetitions = static_cast<size_t>(plan.repetitions);
  Progress bar("compare", repetitions * contests.size() * methods, progress_enabled(options.progress));
  for (size_t r = 0; r < repetitions; ++r)
    for (const Contest& contest : contests)
      for (size_t turn = 0; turn < methods; ++turn) {
        const Entrant& entrant = *contest.methods[(turn + r) % methods];
        const std::string identity = run_identity(entrant, plan, static_cast<int>(r));
        if (!store.find_run(identity)) {
          const MethodRun run = run_method(entrant.loaded, plan, static_cast<int>(r));
          cancellation_point();
          store.add_run(identity, run);
        }
        bar.advance(1);
      }
  bar.finish();
}

bool has_bounded_weights(const RenderJob& loaded) {
  bool grids = false;
  for (const Medium& medium : loaded.scene.media) grids |= !medium.homogeneous();
  const StrategyInfo& info = strategy_info(loaded.settings.distance.strategy);
  return info.bounded_weight || (!grids && info.positive);
}

/// Why repetitions cannot show a bias; empty where they can. Means of heavy-tailed weights look biased in nearly
/// all repetitions, and their intervals lie.
std::string why_bias_unknown(const RenderJob& loaded, const std::vector<RunCost>& costs) {
  if (loaded.scene.media.empty() || has_bounded_weights(loaded)) return "";
  double least = costs.front().effective_sample_size;
  for (const RunCost& cost : costs) least = std::min(least, cost.effective_sample_size);
  return least < kLeastSampleSize ? fmt::format("effective sample size {:.3g} < {:g}", least, kLeastSampleSize) : "";
}

BudgetSummary summarise(const Entrant& entrant, const Reference& reference, const ComparisonPlan& plan,
                        const Store& store, size_t budget) {
  std::vector<RunCost> costs;
  std::vector<Image> images;
  for (int r = 0; r < plan.repetitions; ++r) {
    const std::string identity = run_identity(entrant, plan, r);
    costs.push_back(store.find_run(identity)->at(budget));
    images.push_back(store.picture(identity, budget));
  }
  BudgetSummary summary = summarise_budget(costs, images, reference);
  summary.why_bias_unknown = why_bias_unknown(entrant.loaded, costs);
  return summary;
}

std::string reference_text(const Contest& contest, double error) {
  if (contest.compared->source == ReferenceSource::exact) return "the exact solution";
  if (contest.compared->source == ReferenceSource::file) return contest.compared->reference_file;
  const auto by = [&] {
    switch (contest.reference_entrant->loaded.settings.integrator) {
      case Integrator::path:
        return "the path tracer";
      case Integrator::combined:
        return "techniques combined";
      case Integrator::photon:
        return "photon mapping";
    }
    __builtin_unreachable();
  };
  return fmt::format("{}, relative MSE {:.2g}", by(), error);
}

/// Of all scenes together.
void judge_biases(std::vector<SceneResults>& scenes) {
  std::vector<BiasEvidence*> all;
  for (SceneResults& scene : scenes)
    for (BiasEvidence& evidence : scene.verdicts) all.push_back(&evidence);
  judge(all);
}

/// "; chosen: key=value key=value", for each choice that a run made.
std::string choices_text(const Entrant& entrant, const ComparisonPlan& plan, const Store& store) {
  std::set<std::string> all;
  for (int r = 0; r < plan.repetitions; ++r) all.insert(store.chosen(run_identity(entrant, plan, r)));
  std::string text;
  for (const std::string& chosen : all)
    if (!chosen.empty()) text += "; chosen: " + chosen;
  return text;
}

std::vector<FoundByTechnique> techniques_of_method(const Entrant& entrant, const ComparisonPlan& plan,
                                                   const Store& store) {
  std::vector<std::vector<FoundByTechnique>> repetitions;
  for (int r = 0; r < plan.repetitions; ++r) repetitions.push_back(store.techniques(run_identity(entrant, plan, r)));
  return mean_of_techniques(repetitions);
}

SceneResults results_of(const Contest& contest, const ComparisonPlan& plan, const Store& store) {
  SceneResults results;
  results.scene_text = read_whole_file(contest.compared->file);
  results.width = contest.reference.mean.width;
  results.height = contest.reference.mean.height;
  results.reference_error = reference_noise(contest.reference);
  results.reference = reference_text(contest, results.reference_error);
  for (const auto& entrant : contest.methods) {
    results.hashes.push_back(entrant->loaded.hash);
    results.settings.push_back(settings_text(entrant->loaded) + choices_text(*entrant, plan, store));
    std::vector<BudgetSummary> budgets;
    for (size_t b = 0; b < plan.budgets.size(); ++b)
      budgets.push_back(summarise(*entrant, contest.reference, plan, store, b));
    results.budgets.push_back(std::move(budgets));
    results.techniques.push_back(techniques_of_method(*entrant, plan, store));
  }
  results.summary = summarise_scene(results.budgets, plan.unit, plan.baseline);
  results.verdicts = bias_evidence(results.budgets, results.summary, plan.baseline, contest.reference);
  return results;
}

/// Of runs at the last budget.
PageImages images_of(const Contest& contest, const ComparisonPlan& plan, const Store& store) {
  PageImages images{contest.reference.mean, {}};
  for (const auto& entrant : contest.methods) {
    const size_t at_last = plan.budgets.size() - 1;
    std::vector<Image> repetitions;
    for (int r = 0; r < plan.repetitions; ++r)
      repetitions.push_back(store.picture(run_identity(*entrant, plan, r), at_last));
    images.methods.push_back(method_images(repetitions));
    images.methods.back().techniques = store.parts(run_identity(*entrant, plan, 0), at_last);
  }
  return images;
}

}  // namespace

int compare_command(const CompareOptions& options) {
  set_threads(options.threads);
  const ComparisonPlan plan = load_comparison_plan(options.experiment, options.overrides);
  std::vector<Contest> contests = load_contests(plan);
  print_left_out(contests, plan);
  const Store store(options.output);
  try {
    for (Contest& contest : contests) make_reference(contest, store, options);
    make_runs(contests, plan, store, options);
  } catch (const Cancelled&) {
    fmt::print(stderr, "interrupted: finished runs are kept in {}; the same command goes on\n", options.output);
    return kInterrupted;
  }
  std::vector<SceneResults> scenes;
  std::vector<PageImages> images;
  for (const Contest& contest : contests) {
    scenes.push_back(results_of(contest, plan, store));
    images.push_back(images_of(contest, plan, store));
  }
  judge_biases(scenes);
  const std::filesystem::path folder = options.output;
  const std::string results = results_json(plan, scenes);
  write_text(folder / "results.json", results);
  write_text(folder / "results.csv", results_csv(plan, scenes));
  write_text(folder / "report.html", results_page(results, images));
  fmt::print("{}{}: report.html, results.json, results.csv\n", results_text(plan, scenes), folder.string());
  return 0;
}

}  // namespace vpm::tools
