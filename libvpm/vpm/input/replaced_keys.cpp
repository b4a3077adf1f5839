// Settings before and after an option are those that the components describe.
#include "vpm/input/replaced_keys.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <utility>

#include "vpm/integrators/describe.h"

namespace vpm {
namespace {

using Values = std::map<std::string, std::string>;

void add_values(const std::string& path, const Node& node, Values& values) {
  if (const Node::Table* const table = node.table())
    for (const Entry& entry : *table) add_values(path + "." + entry.key, entry.node, values);
  else
    values[path] = text_of(node);
}

/// What a document says of settings.
Values values_of(const Document& document) {
  Values values;
  for (const char* const name : {"render", "integrator"})
    if (const Entry* const entry = find_entry(*document.root.table(), name)) add_values(name, entry->node, values);
  return values;
}

std::set<std::string> keys_with(const Values& values) {
  RenderSettings settings = settings_with(values);
  std::set<std::string> keys;
  for (const Setting& setting : describe(settings)) keys.insert(setting.key);
  return keys;
}

/// Settings of integrators that are still to be chosen are not known.
bool chooses_integrator(const Replacement& by) { return by.key == "integrator.type" && by.after == kAuto; }

}  // namespace

ReplacedKeys::ReplacedKeys(const Document& document) : document_(document) {
  if (document.replaced.empty()) return;
  Values values = values_of(document);
  for (auto by = document.replaced.rbegin(); by != document.replaced.rend(); ++by) {
    values.erase(by->key);
    if (by->said) values[by->key] = by->before;
  }
  before_ = keys_with(values);
  for (const Replacement& by : document.replaced) {
    values[by.key] = by.after;
    const std::set<std::string> after = keys_with(values);
    if (chooses_integrator(by) || !std::includes(after.begin(), after.end(), before_.begin(), before_.end()))
      replaced_.push_back(&by);
  }
}

bool ReplacedKeys::has_table(const std::string& path) const {
  const auto first = before_.lower_bound(path + ".");
  return !replaced_.empty() && first != before_.end() && first->starts_with(path + ".");
}

bool ReplacedKeys::leave_out(const std::string& key, const Node& node) {
  const auto number_of = [&](const Source* source) {
    return std::find_if(document_.sources.begin(), document_.sources.end(),
                        [&](const auto& each) { return each.get() == source; });
  };
  const bool stands_before = std::any_of(replaced_.begin(), replaced_.end(), [&](const Replacement* by) {
    return number_of(node.place.source) < number_of(by->option);
  });
  if (!before_.contains(key) || !stands_before) return false;
  left_out_.push_back(key);
  return true;
}

std::string ReplacedKeys::note() const {
  if (left_out_.empty()) return "";
  std::vector<std::string> changes;
  for (const Replacement* by : replaced_)
    changes.push_back(fmt::format("{} is \"{}\" in place of \"{}\"", by->key, by->after, by->before));
  return fmt::format("{}: left out are {}", fmt::join(changes, ", "), fmt::join(left_out_, ", "));
}

}  // namespace vpm
