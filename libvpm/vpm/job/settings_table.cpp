// A row for each setting: table, key, what must be chosen for it, meaning, values, default.
#include "vpm/job/settings_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "vpm/integrators/every_setting.h"

namespace vpm {
namespace {

struct Row {
  std::vector<std::string> tables;
  std::string name, with, meaning, values, default_text;

  bool same_but_for_table(const Row& other) const {
    return name == other.name && with == other.with && meaning == other.meaning && values == other.values &&
           default_text == other.default_text;
  }
};

std::string word(const std::string& text) { return fmt::format("`\"{}\"`", text); }

std::vector<std::string> in_quotes(std::vector<std::string> words) {
  for (std::string& each : words) each = word(each);
  return words;
}

std::string text_of_domain(const Words& domain) { return fmt::format("{}", fmt::join(in_quotes(domain.words), ", ")); }
std::string text_of_domain(const WordSet& domain) { return "some of " + text_of_domain(Words{domain.words}); }
std::string text_of_domain(const Flags&) { return "`true`, `false`"; }
std::string text_of_domain(const Integers& domain) {
  constexpr uint64_t kNoMatter = 1'000'000'000;  // no limit that anybody meets
  if (domain.hi >= kNoMatter) return fmt::format("integer >= {}", domain.lo);
  return fmt::format("integer from {} to {}", domain.lo, domain.hi);
}
std::string text_of_domain(const Numbers& domain) { return text_of(domain.range); }

/// What must be chosen for a setting, the integrator first.
std::string all_of(const SettingOfSome& each) {
  std::vector<std::string> all;
  if (!each.integrators.empty()) all.push_back(fmt::format("{}", fmt::join(in_quotes(each.integrators), ", ")));
  all.insert(all.end(), each.with.begin(), each.with.end());
  return fmt::format("{}", fmt::join(all, "; "));
}

std::vector<Row> rows() {
  std::vector<Row> all;
  for (const SettingOfSome& each : every_setting()) {
    const Setting& setting = each.setting;
    const Row row{{setting.table()}, setting.name(),     all_of(each),
                  setting.meaning,   values_of(setting), default_of(setting)};
    const auto alike = std::find_if(all.begin(), all.end(), [&](const Row& r) { return r.same_but_for_table(row); });
    if (alike != all.end())
      alike->tables.push_back(setting.table());
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

std::string default_of(const Setting& setting) {
  if (!setting.default_text.empty()) return std::string(setting.default_text);
  const std::string text = text_of(setting.default_value);
  if (std::holds_alternative<Words>(setting.domain)) return word(text);
  return std::holds_alternative<Flags>(setting.domain) ? "`" + text + "`" : text;
}

std::string settings_table() {
  std::string table = "| table | key | with | meaning | values | default |\n| --- | --- | --- | --- | --- | --- |\n";
  std::string last;
  for (const Row& row : rows()) {
    const std::string tables = fmt::format("`[{}]`", fmt::join(row.tables, "]`, `["));
    table += fmt::format("| {}| `{}` | {}| {} | {} | {} |\n", tables == last ? "" : tables + " ", row.name,
                         row.with.empty() ? "" : row.with + " ", row.meaning, row.values, row.default_text);
    last = tables;
  }
  return table;
}

}  // namespace vpm
