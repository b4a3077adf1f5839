// vpm validate: the ladder, check by check.
#include <fmt/format.h>
#include <algorithm>
#include <cstdio>

#include "check_report.h"
#include "commands.h"
#include "json.h"
#include "vpm/base/atomic_file.h"
#include "vpm/base/clock.h"
#include "vpm/base/error.h"
#include "vpm/base/parallel.h"
#include "vpm/base/version.h"
#include "vpm/study/validate/ladder.h"

namespace vpm::tools {
namespace {

/// A check with where it stands.
struct Line {
  int level = 0;
  std::string experiment;
};

struct Outcome {
  std::vector<Check> checks;  // judged
  std::vector<Line> lines;    // one for each check
  double threshold = 0.0;     // p-values below it fail
  double seconds = 0.0;

  size_t count(Verdict verdict) const { return count_verdicts(checks, verdict); }
};

/// The experiments that are asked for. Throws InputError where there are none.
std::vector<Experiment> asked_for(const ValidateOptions& options) {
  std::vector<Experiment> all = experiments(options.level.value_or(-1));
  std::string names;
  for (const Experiment& e : all) names += "\n  " + e.name;
  std::erase_if(all, [&](const Experiment& e) { return e.name.find(options.only) == std::string::npos; });
  if (all.empty())
    throw InputError(
        fmt::format("--only: no experiment has '{}' in its name; these are there:{}", options.only, names));
  return all;
}

Outcome climb(const ValidateOptions& options) {
  const Stopwatch climbing;
  const Effort effort{options.seed, options.full};
  const std::vector<Experiment> all = asked_for(options);
  Outcome outcome;
  for (auto first = all.begin(), last = first; first != all.end(); first = last) {
    const int level = first->level;
    last = std::find_if(first, all.end(), [&](const Experiment& e) { return e.level != level; });
    Progress bar(fmt::format("level {}", level), static_cast<uint64_t>(last - first),
                 progress_enabled(options.progress));
    for (auto experiment = first; experiment != last; ++experiment) {
      for (Check& check : experiment->run(effort)) {
        outcome.checks.push_back(std::move(check));
        outcome.lines.push_back({level, experiment->name});
      }
      bar.advance();
    }
    bar.finish();
    // Verdicts depend on how many checks there are, so they come at the end: that it goes on is said before, also in a
    // pipe.
    fmt::print("level {} done: {} checks so far, {:.1f} s\n", level, outcome.checks.size(), climbing.seconds());
    std::fflush(stdout);
  }
  outcome.threshold = judge(outcome.checks, options.rate);
  outcome.seconds = climbing.seconds();
  return outcome;
}

void print(const Outcome& outcome, const ValidateOptions& options) {
  size_t width = 0;
  for (const Check& check : outcome.checks) width = std::max(width, check.name.size());
  for (size_t i = 0; i < outcome.checks.size(); ++i) {
    const Line& line = outcome.lines[i];
    if (i == 0 || line.level != outcome.lines[i - 1].level)
      fmt::print("\nLevel {}: {}\n", line.level, level_title(line.level));
    if (i == 0 || line.experiment != outcome.lines[i - 1].experiment)
      fmt::print("  {:<{}} {}\n", line.experiment, width + 2, check_columns());
    fmt::print("    {:<{}} {}\n", outcome.checks[i].name, width, check_row(outcome.checks[i]));
  }
  fmt::print("\n{} checks: {} passed, {} FAILED, {} not determined; {:.1f} s, {} thread(s), seed {}\n",
             outcome.checks.size(), outcome.count(Verdict::pass), outcome.count(Verdict::fail),
             outcome.count(Verdict::undetermined), outcome.seconds, thread_count(), options.seed);
  fmt::print("a check fails where p < {:.3g}: right code fails one run in {:.0f}\n", outcome.threshold,
             1.0 / options.rate);
}

std::string json_report(const Outcome& outcome, const ValidateOptions& options) {
  Json checks = Json::array();
  for (size_t i = 0; i < outcome.checks.size(); ++i) {
    Json line{{"level", outcome.lines[i].level}, {"experiment", outcome.lines[i].experiment}};
    line.update(Json::parse(check_json(outcome.checks[i])));
    checks.push_back(std::move(line));
  }
  const Json report{{"vpm", version()},
                    {"mode", options.full ? "full" : "quick"},
                    {"seed", options.seed},
                    {"threads", thread_count()},
                    {"seconds", outcome.seconds},
                    {"false_alarm_rate_of_the_run", options.rate},
                    {"p_threshold", outcome.threshold},
                    {"failed", outcome.count(Verdict::fail)},
                    {"not_determined", outcome.count(Verdict::undetermined)},
                    {"checks", std::move(checks)}};
  return report.dump(2) + "\n";
}

}  // namespace

int validate_command(const ValidateOptions& options) {
  set_threads(options.threads);
  if (!options.json.empty()) check_writable(options.json, 1 << 20);
  if (!options.oracles.empty()) return oracle_command(options);
  const Outcome outcome = climb(options);
  print(outcome, options);
  if (!options.json.empty()) write_text(options.json, json_report(outcome, options));
  return outcome.count(Verdict::fail) == 0 ? 0 : 1;
}

}  // namespace vpm::tools
