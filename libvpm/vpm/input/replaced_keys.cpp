// Settings before and after an option are those that the components describe under the values said by then.
#include "vpm/input/replaced_keys.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <map>

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

/// The keys of settings. Of an integrator that is still to be chosen none is known.
std::set<std::string> keys_with(const Values& values) {
  const auto integrator = values.find("integrator.type");
  const bool chosen = integrator != values.end() && integrator->second == kAuto;
  RenderSettings settings = settings_with(values);
  std::set<std::string> keys;
  for (const Setting& setting : describe(settings))
    if (!chosen || !setting.key.starts_with("integrator.") || setting.key == "integrator.type")
      keys.insert(setting.key);
  return keys;
}

/// The default of a key that nothing is said of.
std::string default_of(const std::string& key, const Values& values) {
  RenderSettings settings = settings_with(values);
  const std::optional<Setting> setting = find_setting(settings, key);
  return setting ? text_of(setting->default_value) : "";
}

}  // namespace

ReplacedKeys::ReplacedKeys(const Document& document) : document_(document) {
  Values values = values_of(document);
  for (auto by = document.replaced.rbegin(); by != document.replaced.rend(); ++by) {
    values.erase(by->key);
    if (by->before) values[by->key] = *by->before;
  }
  for (const Replacement& by : document.replaced) {
    Change change{&by, by.before ? *by.before : default_of(by.key, values), keys_with(values), {}};
    values[by.key] = by.after;
    const std::set<std::string> after = keys_with(values);
    std::set_difference(change.keys.begin(), change.keys.end(), after.begin(), after.end(),
                        std::inserter(change.gone, change.gone.end()));
    if (!change.gone.empty() || by.key == "integrator.type") changes_.push_back(std::move(change));
  }
}

bool ReplacedKeys::stands_before(const Node& node, const Change& change) const {
  const auto number_of = [&](const Source* source) {
    return std::find_if(document_.sources.begin(), document_.sources.end(),
                        [&](const auto& each) { return each.get() == source; });
  };
  return number_of(node.place.source) < number_of(change.by->option);
}

bool ReplacedKeys::has_table(const std::string& path) const {
  return std::any_of(changes_.begin(), changes_.end(), [&](const Change& change) {
    const auto first = change.keys.lower_bound(path + ".");
    return first != change.keys.end() && first->starts_with(path + ".");
  });
}

bool ReplacedKeys::leave_out(const std::string& key, const Node& node) {
  for (Change& change : changes_)
    if (change.gone.contains(key) && stands_before(node, change)) {
      change.left_out_any = true;
      left_out_.push_back(key);
      return true;
    }
  return false;
}

bool ReplacedKeys::leave_out_value(const std::string& key, const Node& node) {
  for (Change& change : changes_)
    if (change.by->key == "integrator.type" && change.keys.contains(key) && stands_before(node, change)) {
      change.left_out_any = true;
      left_out_.push_back(key);
      return true;
    }
  return false;
}

std::string ReplacedKeys::note() const {
  if (left_out_.empty()) return "";
  std::vector<std::string> options;
  for (const Change& change : changes_)
    if (change.left_out_any)
      options.push_back(
          fmt::format("{} is \"{}\" in place of \"{}\"", change.by->key, change.by->after, change.before));
  return fmt::format("{}: left out are {}", fmt::join(options, ", "), fmt::join(left_out_, ", "));
}

}  // namespace vpm
