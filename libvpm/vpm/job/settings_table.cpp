// A row for each declaration: section, key, meaning, values, default.
#include "vpm/job/settings_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>

namespace vpm {
namespace {

struct Row {
  std::vector<std::string> sections;
  std::string name, meaning, values, usual;

  bool same_but_for_section(const Row& other) const {
    return name == other.name && meaning == other.meaning && values == other.values && usual == other.usual;
  }
};

std::string word(const std::string& text) { return fmt::format("`\"{}\"`", text); }

std::string text_of_domain(const Words& domain) {
  std::vector<std::string> words;
  for (const std::string& each : domain.words) words.push_back(word(each));
  return fmt::format("{}", fmt::join(words, ", "));
}
std::string text_of_domain(const WordSet& domain) { return "some of " + text_of_domain(Words{domain.words}); }
std::string text_of_domain(const Flags&) { return "`true`, `false`"; }
std::string text_of_domain(const Integers& domain) {
  constexpr uint64_t kTellsNothing = 1'000'000'000;
  if (domain.hi >= kTellsNothing) return fmt::format("integer >= {}", domain.lo);
  return fmt::format("integer from {} to {}", domain.lo, domain.hi);
}
std::string text_of_domain(const Numbers& domain) { return text_of(domain.range); }

std::vector<Row> rows() {
  std::vector<Row> all;
  for (const Setting& setting : all_settings()) {
    const Row row{{setting.section()}, setting.name(), setting.meaning, values_of(setting), usual_of(setting)};
    const auto same = std::find_if(all.begin(), all.end(), [&](const Row& r) { return r.same_but_for_section(row); });
    if (same != all.end())
      same->sections.push_back(setting.section());
    else
      all.push_back(row);
  }
  return all;
}

}  // namespace

std::string values_of(const Setting& setting) {
  std::string text = std::visit([](const auto& domain) { return text_of_domain(domain); }, setting.domain);
  if (!setting.unit.empty()) text += fmt::format(" {}", setting.unit);
  return setting.automatic ? text + ", or " + word(kAuto) : text;
}

std::string usual_of(const Setting& setting) {
  if (!setting.default_text.empty()) return std::string(setting.default_text);
  const std::string text = text_of(setting.member.get({}));
  if (std::holds_alternative<Words>(setting.domain)) return word(text);
  return std::holds_alternative<Flags>(setting.domain) ? "`" + text + "`" : text;
}

std::string settings_table() {
  std::string table = "| section | key | meaning | values | default |\n| --- | --- | --- | --- | --- |\n";
  std::string last;
  for (const Row& row : rows()) {
    const std::string sections = fmt::format("`[{}]`", fmt::join(row.sections, "]`, `["));
    table += fmt::format("| {}| `{}` | {} | {} | {} |\n", sections == last ? "" : sections + " ", row.name, row.meaning,
                         row.values, row.usual);
    last = sections;
  }
  return table;
}

}  // namespace vpm
