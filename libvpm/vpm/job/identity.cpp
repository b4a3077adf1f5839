// The fields of an identity, and how two differ.
#include "vpm/job/identity.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <sstream>

#include "vpm/base/version.h"
#include "vpm/job/setting.h"

namespace vpm {
namespace {

constexpr const char* kChosen = "chosen";  // the field that lists the keys of settings that were chosen

/// The value of a field; null where there is none of that name.
const std::string* find(const Identity& identity, const std::string& name) {
  const auto found =
      std::find_if(identity.begin(), identity.end(), [&](const auto& field) { return field.first == name; });
  return found == identity.end() ? nullptr : &found->second;
}

std::string value_or_nothing(const std::string* value) { return value ? *value : "nothing"; }

}  // namespace

Identity identity_of(const RenderJob& job) {
  std::string options = fmt::format("{}", fmt::join(job.overrides, " "));
  std::replace(options.begin(), options.end(), '\n', ' ');
  Identity identity{{"program", fmt::format("vpm {}", version())},
                    {"scene", job.hash},
                    {"options", options},
                    {"film", fmt::format("{} x {}", job.scene.camera.width, job.scene.camera.height)},
                    {"render.seed", std::to_string(job.settings.seed)}};
  for (const Field& field : estimate_fields(job.settings)) identity.emplace_back(field.key, text_of(field.value));
  std::vector<std::string> keys;
  for (const Choice& choice : job.choices) keys.push_back(choice.key);
  if (!keys.empty()) identity.emplace_back(kChosen, fmt::format("{}", fmt::join(keys, ",")));
  return identity;
}

std::vector<Choice> choices_of(const Identity& identity) {
  std::vector<Choice> choices;
  const std::string* const chosen = find(identity, kChosen);
  std::istringstream keys(chosen ? *chosen : "");
  for (std::string key; std::getline(keys, key, ',');) {
    const std::string* const value = find(identity, key);
    choices.push_back({key, value ? *value : "", "as chosen when the render began"});
  }
  return choices;
}

std::string differences(const Identity& in_file, const Identity& asked) {
  std::string lines;
  const auto tell = [&](const std::string& name, const std::string* there, const std::string* here) {
    lines += fmt::format("\n  {}: {} in the file, {} asked for", name, value_or_nothing(there), value_or_nothing(here));
  };
  for (const auto& [name, value] : in_file) {
    const std::string* const other = find(asked, name);
    if (!other || *other != value) tell(name, &value, other);
  }
  for (const auto& [name, value] : asked)
    if (!find(in_file, name)) tell(name, nullptr, &value);
  return lines;
}

}  // namespace vpm
