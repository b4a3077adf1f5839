// Checks as lines of text and as JSON.
#include "check_report.h"

#include <fmt/format.h>
#include <algorithm>

#include "json.h"

namespace vpm::tools {

const char* verdict_word(Verdict verdict) {
  switch (verdict) {
    case Verdict::pass:
      return "pass";
    case Verdict::fail:
      return "FAIL";
    case Verdict::undetermined:
      break;
  }
  return "not determined";
}

std::string check_columns() {
  return fmt::format("{:>13} {:>13} {:>10} {:>12} {:>8}", "value", "exact", "error", "deviation", "p");
}

std::string check_row(const Check& check) {
  const std::string note = check.note.empty() ? "" : "  (" + check.note + ")";
  const std::string numbers = fmt::format("{:>13.7g} {:>13.7g}", check.value, check.exact);
  const char* word = verdict_word(check.verdict);
  switch (check.kind) {
    case CheckKind::statistical:
      return fmt::format("{} {:>10.2g} {:>+7.2f} s.e. {:>8.2g}  {}{}", numbers, check.error, check.deviation(), check.p,
                         word, note);
    case CheckKind::bounded:
      return fmt::format("{} {:>10.2g} {:>+7.2f} bound {:>7}  {}{}", numbers, check.error, check.deviation(), "-", word,
                         note);
    case CheckKind::undetermined:
      break;
  }
  return fmt::format("{} {:>10} {:>12} {:>8}  {}{}", numbers, "-", "-", "-", word, note);
}

std::string check_json(const Check& check) {
  Json json{{"name", check.name},
            {"value", number(check.value)},
            {"exact", number(check.exact)},
            {"error", number(check.error)}};
  json["error_is"] = check.kind == CheckKind::statistical ? "standard error"
                     : check.kind == CheckKind::bounded   ? "bound"
                                                          : "not known";
  json["deviation"] = number(check.kind == CheckKind::undetermined ? 0.0 : check.deviation());
  if (check.kind == CheckKind::statistical) json["p"] = number(check.p);
  json["verdict"] = check.verdict == Verdict::fail ? "fail" : verdict_word(check.verdict);
  json["note"] = check.note;
  return json.dump();
}

size_t count_verdicts(const std::vector<Check>& checks, Verdict verdict) {
  return static_cast<size_t>(
      std::count_if(checks.begin(), checks.end(), [&](const Check& c) { return c.verdict == verdict; }));
}

}  // namespace vpm::tools
