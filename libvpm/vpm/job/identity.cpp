// The fields of an identity, and how two differ.
#include "vpm/job/identity.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cassert>
#include <charconv>
#include <sstream>

#include "vpm/base/lines.h"
#include "vpm/base/version.h"
#include "vpm/integrators/describe.h"

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

/// Without what would end it in a checkpoint.
std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}
std::string as_name(std::string text) {
  std::replace(text.begin(), text.end(), '=', ' ');
  return one_line(std::move(text));
}

/// A default that stands for no value of its own, as that of radii, is called so.
std::string value_of(const Setting& setting) {
  const SettingValue value = setting.get();
  return value == setting.default_value && !outside_of(setting.domain, value).empty() ? "default" : text_of(value);
}

}  // namespace

Identity identity_of(const RenderJob& job) {
  Identity identity{{"program", fmt::format("vpm {}", version())}};
  for (const auto& [name, value] : job.contents) identity.emplace_back(as_name(name), one_line(value));
  if (job.contents.empty()) {
    identity.emplace_back("scene", job.hash);
    const Camera& camera = job.scene.camera;
    const auto& [x0, y0, x1, y1] = camera.rendered();
    identity.emplace_back("film", fmt::format("{} x {}", camera.width, camera.height));
    identity.emplace_back("crop", fmt::format("{} {} {} {}", x0, y0, x1, y1));
  }
  identity.emplace_back("render.seed", std::to_string(job.settings.seed));
  RenderSettings settings = job.settings;
  for (const Setting& setting : describe(settings))
    if (!setting.of_passes) identity.emplace_back(setting.key, value_of(setting));
  if (!job.automatic.keys.empty())
    identity.emplace_back("left to be chosen", fmt::format("{}", fmt::join(job.automatic.keys, ",")));
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

std::string lines_of(std::string_view title, const Identity& identity) {
  std::string lines = fmt::format("{} {}\n", title, identity.size());
  for (const auto& [name, value] : identity) {
    assert(name.find_first_of("=\n") == std::string::npos && value.find('\n') == std::string::npos);
    lines += name + "=" + value + "\n";
  }
  return lines;
}

std::optional<Identity> take_lines(std::string_view& text, std::string_view title) {
  std::string_view line;
  if (!take_line(text, line) || !line.starts_with(title) || !line.substr(title.size()).starts_with(' '))
    return std::nullopt;
  const std::string_view number = line.substr(title.size() + 1);
  size_t count = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), count);
  if (error != std::errc() || end != number.data() + number.size()) return std::nullopt;
  Identity identity;
  for (size_t i = 0; i < count; ++i) {
    if (!take_line(text, line)) return std::nullopt;
    const size_t equals = line.find('=');
    if (equals == std::string_view::npos) return std::nullopt;
    identity.emplace_back(line.substr(0, equals), line.substr(equals + 1));
  }
  return identity;
}

std::string differences(const Identity& a, const Identity& b, const std::string& of_a, const std::string& of_b) {
  std::string lines;
  const auto list = [&](const std::string& name, const std::string* there, const std::string* here) {
    lines += fmt::format("\n  {}: {} {}, {} {}", name, value_or_nothing(there), of_a, value_or_nothing(here), of_b);
  };
  for (const auto& [name, value] : a) {
    const std::string* const other = find(b, name);
    if (!other || *other != value) list(name, &value, other);
  }
  for (const auto& [name, value] : b)
    if (!find(a, name)) list(name, nullptr, &value);
  return lines.empty() && a != b ? "\n  the same keys stand in another order" : lines;
}

}  // namespace vpm
