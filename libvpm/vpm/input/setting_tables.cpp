// Tables are read by the domains of settings.
#include "vpm/input/setting_tables.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "vpm/integrators/describe.h"
#include "vpm/integrators/every_setting.h"

namespace vpm {
namespace {

constexpr uint64_t kLargestOfToml = std::numeric_limits<int64_t>::max();

Words with_auto(Words words) {
  words.words.emplace_back(kAuto);
  return words;
}

/// An array of words, in the order of the set.
std::string read_word_set(TableReader& table, const std::string& key, const WordSet& set) {
  const std::vector<std::string> given = table.words(key, set.words);
  std::string joined;
  for (const std::string& word : set.words)
    if (std::find(given.begin(), given.end(), word) != given.end()) joined += (joined.empty() ? "" : "+") + word;
  return joined;
}

bool holds(const std::vector<std::string>& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// Without what holds already: the integrator that is chosen.
std::string condition(const SettingOfSome& each, const std::string& integrator) {
  std::vector<std::string> all;
  if (!each.integrators.empty() && !holds(each.integrators, integrator))
    all.push_back(fmt::format("type = \"{}\" of [integrator]", fmt::join(each.integrators, "\", \"")));
  all.insert(all.end(), each.with.begin(), each.with.end());
  std::string text = fmt::format("{}", fmt::join(all, " and "));
  std::erase(text, '`');
  return text;
}

/// Of all settings of a table, as if it were one.
std::optional<SettingOfSome> all_of_table(const std::string& path) {
  std::optional<SettingOfSome> all;
  for (const SettingOfSome& each : every_setting()) {
    if (!(each.setting.table() + ".").starts_with(path + ".")) continue;
    if (!all) all = each;
    for (const std::string& integrator : each.integrators)
      if (!holds(all->integrators, integrator)) all->integrators.push_back(integrator);
  }
  return all;
}

/// Where a key that these components do not have is one: "there is 'count' with type = "nearest"; ".
std::string elsewhere(const std::string& path, const std::string& key, const std::string& integrator) {
  std::vector<std::string> conditions, tables;
  if (const auto table = all_of_table(path + "." + key)) conditions = {condition(*table, integrator)};
  for (const SettingOfSome& each : every_setting()) {
    const std::string title = "[" + each.setting.table() + "]";
    if (each.setting.key == path + "." + key) conditions.push_back(condition(each, integrator));
    if (each.setting.name() == key && !holds(tables, title)) tables.push_back(title);
  }
  const std::string chosen = integrator == kAuto && path.starts_with("integrator")
                                 ? "\"auto\" chooses all of [integrator]: name its 'type' to give it other keys; "
                                 : "";
  if (!conditions.empty())
    return fmt::format("{}there is '{}' with {}; ", chosen, key, fmt::join(conditions, ", or with "));
  return tables.empty() ? chosen : fmt::format("{}there is '{}' in {}; ", chosen, key, fmt::join(tables, ", "));
}

}  // namespace

std::optional<SettingValue> read_value(TableReader& table, const Setting& setting) {
  const std::string key = setting.name();
  if (const auto* words = std::get_if<Words>(&setting.domain)) {
    std::vector<std::pair<std::string, std::string>> allowed;
    for (const std::string& word : (setting.automatic ? with_auto(*words) : *words).words)
      allowed.emplace_back(word, word);
    const std::string word = table.choice<std::string>(key, allowed);
    return setting.automatic && word == kAuto ? std::nullopt : std::optional<SettingValue>(word);
  }
  if (const auto* set = std::get_if<WordSet>(&setting.domain)) {
    if (setting.automatic && table.says(key, std::string(kAuto))) return std::nullopt;
    return read_word_set(table, key, *set);
  }
  if (setting.automatic && table.says_auto(key)) return std::nullopt;
  if (const auto* integers = std::get_if<Integers>(&setting.domain))
    return table.integer(key, integers->lo, std::min(integers->hi, kLargestOfToml));
  if (const auto* numbers = std::get_if<Numbers>(&setting.domain)) return table.number(key, numbers->range);
  return table.flag(key, false);
}

TableReader* SettingTables::find(const std::string& path) {
  const auto [found, first] = tables_.try_emplace(path);
  if (first) {
    const size_t dot = path.rfind('.');
    TableReader* const outer = dot == std::string::npos ? &root_ : find(path.substr(0, dot));
    if (outer) tables_[path] = outer->table(path.substr(dot + 1), "[" + path + "]");
  }
  std::optional<TableReader>& table = tables_[path];
  return table ? &*table : nullptr;
}

void SettingTables::finish(const std::string& integrator, ReplacedKeys& replaced) {
  std::vector<std::pair<std::string, std::vector<const Entry*>>> unknown;  // finish() of one may read further tables
  for (const auto& [path, table] : tables_)
    if (table) unknown.emplace_back(path, table->unknown());
  for (const auto& [path, entries] : unknown)
    for (const Entry* entry : entries) finish(path, *entry, integrator, replaced);
}

void SettingTables::finish(const std::string& path, const Entry& entry, const std::string& integrator,
                           ReplacedKeys& replaced) {
  const std::string key = path + "." + entry.key;
  const Node::Table* const inner = entry.node.table();
  if (inner && replaced.has_table(key)) {
    find(key);  // titles what is unknown within
    for (const Entry& each : *inner) finish(key, each, integrator, replaced);
  } else if (!replaced.leave_out(key, entry.node)) {
    find(path)->refuse_unknown(entry, elsewhere(path, entry.key, integrator));
  }
}

void SettingTables::fail(const SettingError& error) {
  std::string path = error.key();
  size_t dot = path.rfind('.');
  std::string name = path.substr(dot + 1);
  for (path.resize(dot); !find(path); path.resize(dot)) {
    dot = path.rfind('.');
    if (dot == std::string::npos) root_.fail_here(error.key() + ": " + error.wrong(), error.right());
    name = path.substr(dot + 1);
  }
  find(path)->fail(name, error.wrong(), error.right());
}

}  // namespace vpm
