// From a folder to verdicts.
#include <fmt/format.h>
#include <algorithm>
#include <cstdio>

#include "check_report.h"
#include "commands.h"
#include "json.h"
#include "oracles/read_folder.h"
#include "vpm/base/atomic_file.h"
#include "vpm/base/clock.h"
#include "vpm/base/parallel.h"
#include "vpm/base/statistics/tails.h"
#include "vpm/base/version.h"

namespace vpm::tools {
namespace {

/// The results of one list of cases.
struct ListResult {
  std::string title;  // the file, and the list's name where it is not the only kind
  std::vector<CaseResult> cases;
  double seconds = 0.0;
};

std::vector<CaseResult> run_list(const OracleList& list, const Effort& effort) {
  const CaseRunner runner = runner_of(list.file, list.name);
  std::vector<CaseResult> results;
  if (runner) {
    results = runner(list, effort);
  } else {
    results.resize(list.cases.size());
    for (CaseResult& r : results) r.unchecked = "no problem of this name is known: " + list.file + ", " + list.name;
  }
  for (size_t i = 0; i < results.size(); ++i) {
    CaseResult& r = results[i];
    r.id = list.cases[i].id();
    const auto determined = [](const Check& check) { return check.kind != CheckKind::undetermined; };
    if (r.checks.empty() && r.unchecked.empty()) r.unchecked = "it has no quantity that is known";
    if (r.unchecked.empty() && std::none_of(r.checks.begin(), r.checks.end(), determined))
      r.unchecked = "none of its quantities is determined";
  }
  return results;
}

std::vector<ListResult> run_folder(const OracleFolder& folder, const ValidateOptions& options) {
  const Effort effort{options.seed, options.full};
  std::vector<ListResult> all;
  Progress bar("oracles", folder.lists.size() + folder.tables.size(), progress_enabled(options.progress));
  for (const OracleList& list : folder.lists) {
    const Stopwatch stopwatch;
    std::string title = list.name == "cases" ? list.file : list.file + ", " + list.name;
    all.push_back({std::move(title), run_list(list, effort), 0.0});
    all.back().seconds = stopwatch.seconds();
    bar.advance();
  }
  for (const OracleList& table : folder.tables) {
    const Stopwatch stopwatch;
    OracleList alone{table.file, "cases", {}};
    const CaseResult compared = compare_table(table, folder.lists, alone);
    all.push_back({table.file, run_list(alone, effort), 0.0});
    if (!compared.checks.empty()) all.back().cases.push_back(compared);
    all.back().seconds = stopwatch.seconds();
    bar.advance();
  }
  bar.finish();
  return all;
}

/// Judges all checks of the run as one family; returns the threshold.
double judge_all(std::vector<ListResult>& lists, double rate) {
  std::vector<Check> checks;
  for (const ListResult& list : lists)
    for (const CaseResult& c : list.cases) checks.insert(checks.end(), c.checks.begin(), c.checks.end());
  const double threshold = judge(checks, rate);
  size_t next = 0;
  for (ListResult& list : lists)
    for (CaseResult& c : list.cases)
      for (Check& check : c.checks) check = std::move(checks[next++]);
  return threshold;
}

/// What one list, or all of them, come to.
struct Totals {
  size_t cases = 0, unchecked = 0, checks = 0, passed = 0, failed = 0, undetermined = 0;
  double smallest_p = 1.0;
  std::string where;  // of the smallest p-value
  double seconds = 0.0;

  void add(const ListResult& list) {
    seconds += list.seconds;
    for (const CaseResult& c : list.cases) {
      ++cases;
      unchecked += !c.unchecked.empty();
      checks += c.checks.size();
      passed += count_verdicts(c.checks, Verdict::pass);
      failed += count_verdicts(c.checks, Verdict::fail);
      undetermined += count_verdicts(c.checks, Verdict::undetermined);
      for (const Check& check : c.checks) {
        if (check.kind != CheckKind::statistical || check.p >= smallest_p) continue;
        smallest_p = check.p;
        where = c.id + ", " + check.name;
      }
    }
  }
  /// The normal deviation that is as rare as the smallest p-value.
  double largest_deviation() const { return smallest_p > 0.0 ? normal_quantile(smallest_p) : HUGE_VAL; }
  bool passes() const { return failed == 0 && unchecked == 0; }
};

void print_cases(const ListResult& list) {
  fmt::print("\n{}\n", list.title);
  for (const CaseResult& c : list.cases) {
    if (!c.unchecked.empty()) fmt::print("  {:<84} unchecked: {}\n", c.id, c.unchecked);
    for (const Check& check : c.checks)
      fmt::print("  {:<84} {}\n", fmt::format("{:<40} {}", c.id, check.name), check_row(check));
  }
}

void print_totals(const std::vector<ListResult>& lists, const Totals& all) {
  fmt::print("\n{:<36} {:>6} {:>9} {:>7} {:>7} {:>15} {:>8}  largest deviation (as of a normal distribution)\n", "file",
             "cases", "unchecked", "checks", "failed", "not determined", "seconds");
  const auto line = [](const std::string& title, const Totals& t) {
    fmt::print("{:<36} {:>6} {:>9} {:>7} {:>7} {:>15} {:>8.1f}  {:.2f} s.e. {}\n", title, t.cases, t.unchecked,
               t.checks, t.failed, t.undetermined, t.seconds, t.largest_deviation(), t.where);
  };
  for (const ListResult& list : lists) {
    Totals totals;
    totals.add(list);
    line(list.title, totals);
  }
  line("all", all);
}

std::string json_report(const std::vector<ListResult>& lists, const ValidateOptions& options, const Totals& all,
                        double threshold) {
  Json files = Json::array();
  for (const ListResult& list : lists) {
    Json cases = Json::array();
    for (const CaseResult& c : list.cases) {
      Json checks = Json::array();
      for (const Check& check : c.checks) checks.push_back(Json::parse(check_json(check)));
      cases.push_back({{"id", c.id}, {"unchecked", c.unchecked}, {"checks", checks}});
    }
    files.push_back({{"file", list.title}, {"seconds", list.seconds}, {"cases", std::move(cases)}});
  }
  const Json report{{"vpm", version()},
                    {"mode", options.full ? "full" : "quick"},
                    {"seed", options.seed},
                    {"threads", thread_count()},
                    {"seconds", all.seconds},
                    {"false_alarm_rate_of_the_run", options.rate},
                    {"p_threshold", threshold},
                    {"cases", all.cases},
                    {"unchecked", all.unchecked},
                    {"failed", all.failed},
                    {"not_determined", all.undetermined},
                    {"files", std::move(files)}};
  return report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

int oracle_command(const ValidateOptions& options) {
  const OracleFolder folder = read_oracle_folder(options.oracles);
  std::vector<ListResult> lists = run_folder(folder, options);
  const double threshold = judge_all(lists, options.rate);
  Totals all;
  for (const ListResult& list : lists) {
    print_cases(list);
    all.add(list);
  }
  print_totals(lists, all);
  fmt::print(
      "\n{} cases, {} unchecked; {} checks: {} passed, {} FAILED, {} not determined; {:.1f} s, "
      "{} thread(s), seed {}\n",
      all.cases, all.unchecked, all.checks, all.passed, all.failed, all.undetermined, all.seconds, thread_count(),
      options.seed);
  fmt::print("a check fails where p < {:.3g}: right code fails one run in {:.0f}\n", threshold, 1.0 / options.rate);
  if (!options.json.empty()) write_text(options.json, json_report(lists, options, all, threshold));
  return all.passes() ? 0 : 1;
}

}  // namespace vpm::tools
