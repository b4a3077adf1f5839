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

/// Without what holds already: the integrator that is chosen.
std::string condition(const SettingOfSome& each, const std::string& integrator) {
  const auto& all = each.integrators;
  std::string text;
  if (!all.empty() && std::find(all.begin(), all.end(), integrator) == all.end())
    text = fmt::format("type = \"{}\" of [integrator]{}", fmt::join(all, "\", \""), each.with.empty() ? "" : "; ");
  text += each.with;
  std::erase(text, '`');
  return text;
}

/// Where a key that these components do not have is one: "there is 'count' with type = "nearest"; ". Of a table that
/// of its first key.
std::string elsewhere(const std::string& path, const std::string& key, const std::string& integrator) {
  std::string here, tables;
  for (const SettingOfSome& each : every_setting()) {
    const Setting& setting = each.setting;
    const bool in_table = (setting.table() + ".").starts_with(path + "." + key + ".");
    if (setting.key == path + "." + key || (in_table && here.empty()))
      here += (here.empty() ? "" : "; or ") + condition(each, integrator);
    const std::string title = "[" + setting.table() + "]";
    if (setting.name() == key && tables.find(title) == std::string::npos)
      tables += (tables.empty() ? "" : ", ") + title;
  }
  if (!here.empty()) return fmt::format("there is '{}' with {}; ", key, here);
  return tables.empty() ? "" : fmt::format("there is '{}' in {}; ", key, tables);
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
