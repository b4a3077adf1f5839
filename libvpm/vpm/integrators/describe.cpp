// Which settings a render has: those of [render], and those of its integrator.
#include "vpm/integrators/describe.h"

#include <fmt/format.h>

#include <set>

#include "vpm/integrators/integrator.h"
#include "vpm/integrators/words.h"

namespace vpm {
namespace {

using S = RenderSettings;

constexpr uint64_t kMostSamples = 1'000'000;  // rays of a pixel

void describe_render(S& s, Description& d) {
  d.in("render");
  const Members<StopRule> until(s.until, d);
  until.add("passes", &StopRule::passes, Integers{1, kMostPasses}, "independent passes that are averaged",
            {.of_passes = true});
  until.add("seconds", &StopRule::seconds, Numbers{kNotNegative},
            "> 0: passes start until this time, from the start of the process on, is over, or one more would end at "
            "over 1.05 times it and 0.25 s; instead",
            {.unit = "s", .of_passes = true});
  until.add("error", &StopRule::error, Numbers{kNotNegative},
            "> 0: passes start until the relative MSE is below that with a confidence of about 80 %, instead",
            {.of_passes = true});
  const Members<PassSettings> of_passes(s, d);
  of_passes.add("seed", &PassSettings::seed, Integers{}, "of all random numbers", {.of_passes = true});
  of_passes.add("samples_per_pixel", &PassSettings::samples_per_pixel, Integers{1, kMostSamples},
                "camera rays per pixel and pass");
  Members<S>(s, d).add("max_events", &S::max_events, Integers{1, 1'000'000'000},
                       "events of one path before it is cut; cuts are counted in the report");
  of_passes.add_set("layers", &PassSettings::layers, std::span<const ViewLayerInfo>(kViewLayers), &ViewLayerInfo::layer,
                    "layers of the picture that show what its pixels see, see below; `--layers` does the same", {},
                    "none");
}

}  // namespace

std::vector<Setting> describe(RenderSettings& settings) {
  Description description;
  describe_render(settings, description);
  Members<S>(settings, description.in("integrator"))
      .add("type", &S::integrator,
           "photon mapping, the unbiased reference path tracer, or all techniques `\"combined\"`, see below",
           {.automatic = true, .keeps_default = true});
  info_of(settings.integrator).describe(settings, description);
  return description.take();
}

std::optional<Setting> find_setting(RenderSettings& settings, std::string_view key) {
  for (Setting& setting : describe(settings))
    if (setting.key == key) return std::move(setting);
  return std::nullopt;
}

RenderSettings settings_with(const std::map<std::string, std::string>& values) {
  RenderSettings settings;
  std::set<std::string> done;
  // Each value may change which settings follow it.
  const auto set_next = [&] {
    for (const Setting& setting : describe(settings)) {
      if (!done.insert(setting.key).second) continue;
      const auto given = values.find(setting.key);
      const std::optional<SettingValue> value = given == values.end() ? std::nullopt : parse(setting, given->second);
      setting.set(value.value_or(setting.default_value));
      if (value) return true;
    }
    return false;
  };
  while (set_next()) {
  }
  return settings;
}

std::vector<Field> estimate_fields(RenderSettings settings) {
  std::vector<Field> fields;
  for (const Setting& setting : describe(settings))
    if (!setting.of_passes) fields.push_back({setting.key, setting.get()});
  return fields;
}

std::string settings_line(const RenderSettings& settings) {
  std::string line;
  for (const Field& field : estimate_fields(settings))
    line += fmt::format("{}{}={}", line.empty() ? "" : " ", field.key, text_of(field.value));
  return line;
}

std::optional<std::string> integrator_of(std::string_view line) {
  if (std::optional<std::string> named = field_of(line, "integrator.type")) return named;
  const std::optional<std::string> old = field_of(line, "render.integrator");  // up to 2026-11
  return old == "photon" ? "photon-map" : old;
}

std::optional<std::string> field_of(std::string_view line, std::string_view key) {
  while (!line.empty()) {
    const std::string_view word = line.substr(0, line.find(' '));
    line.remove_prefix(std::min(word.size() + 1, line.size()));
    if (word.size() > key.size() && word.starts_with(key) && word[key.size()] == '=')
      return std::string(word.substr(key.size() + 1));
  }
  return std::nullopt;
}

}  // namespace vpm
