// What holds for every integrator.
#include "vpm/integrators/render_scene.h"

#include <fmt/format.h>

#include <utility>

#include "vpm/base/settings/setting_error.h"
#include "vpm/film/view_layers.h"
#include "vpm/integrators/describe.h"
#include "vpm/integrators/integrator.h"
#include "vpm/integrators/words.h"

namespace vpm {
namespace {

/// Each setting by itself.
void check_values(RenderSettings settings) {
  for (const Setting& setting : describe(settings)) {
    const SettingValue value = setting.get();
    if (value == setting.default_value) continue;
    if (const std::string wrong = outside_of(setting.domain, value); !wrong.empty())
      throw SettingError(setting.key, fmt::format("'{}' of [{}] {}", setting.name(), setting.table(), wrong), "");
  }
}

/// Strategies for grids that the integrator has.
std::vector<std::string> strategies_for_grids(RenderSettings settings) {
  const std::optional<Setting> type = find_setting(settings, "integrator.distance.type");
  std::vector<std::string> names = std::get<Words>(type->domain).words;
  std::erase_if(names, [](const std::string& name) { return !strategy_info(name).heterogeneous; });
  return names;
}

void check_strategy(const RenderSettings& s, const SceneFacts& facts) {
  if (!facts.grids || strategy_info(s.distance.strategy).heterogeneous) return;
  throw SettingError("integrator.distance.type",
                     "the strategy '" + s.distance.strategy + "' is wrong in a grid medium, and the scene has one",
                     listed("for grids", strategies_for_grids(s)));
}

/// Numbers by name are those of the component that is chosen.
void check_numbers(const Parameters& given, std::span<const Parameter> list, const std::string& table,
                   const std::string& component) {
  for (const auto& [name, number] : given)
    refuse_if(among(list, {{name, number}}).empty(), (table + "." + name).c_str(),
              "'" + component + "' has no number of that name", "leave it out, or name another type");
}

/// The pictures of a pass, cut to the camera's crop.
Pass cut(Pass pass, const Camera& camera) {
  if (!camera.crop) return pass;
  pass.image = cropped(pass.image, *camera.crop);
  if (!pass.correction.pixels.empty()) pass.correction = cropped(pass.correction, *camera.crop);
  for (Image& layer : pass.layers) layer = cropped(layer, *camera.crop);
  return pass;
}

}  // namespace

void validate(const RenderSettings& settings, const SceneFacts& facts) {
  refuse_if(facts.cyclic, "world.cyclic", "a scene that repeats itself is for photons alone: it makes no picture",
            "measure it, by vpm measure or vpm fluence, or leave out 'cyclic'");
  check_values(settings);
  check_strategy(settings, facts);
  const auto& [strategy, of_flights] = settings.distance;
  check_numbers(of_flights, strategy_info(strategy).parameters, "integrator.distance", strategy);
  for (const EstimatorInfo& info : transmittance_estimators())
    if (info.name == settings.transmittance.estimator)
      check_numbers(settings.transmittance.parameters, info.parameters, "integrator.transmittance",
                    settings.transmittance.estimator);
  if (const auto check = info_of(settings.integrator).check) check(settings, facts);
}

void validate_light_map(const RenderSettings& settings, const SceneFacts& facts) {
  validate(settings, facts);
  refuse_if(
      settings.integrator != Integrator::photon, "integrator.type",
      "light maps are made of photon maps, but 'type' of [integrator] is \"" + word_of(settings.integrator) + "\"",
      "write \"photon-map\", or add --set integrator.type=photon-map");
  refuse_if(settings.radii == RadiusSchedule::per_pixel, "integrator.radii",
            "texels of a light map have no radii of their own, but 'radii' of [integrator] are \"per-pixel\"",
            "write \"per-pass\", or add --set integrator.radii=per-pass");
  refuse_if(!settings.layers.empty(), "render.layers", "a light map has no layers of what a camera sees",
            "leave out 'layers'");
  refuse_if(settings.until.error > 0.0, "render.error", "a light map is not baked until an error is reached",
            "write 'passes' instead, or add --passes N");
}

void check_begun(const Scene& scene, const RenderSettings& settings, const RenderResult& result) {
  validate(settings, facts_of(scene));
  check_goes_on(result, scene.camera, layer_films(settings), settings.until.first);
}

PassMaker pass_maker(const Scene& scene, const RenderSettings& settings) {
  PassMaker maker = info_of(settings.integrator).passes(scene, settings);
  maker.make = [whole = std::move(maker.make), &scene](int pass, const RenderResult& so_far,
                                                       const PassProgress& progress) {
    return cut(whole(pass, so_far, progress), scene.camera);
  };
  return maker;
}

RenderResult render(const Scene& scene, const RenderSettings& settings, RenderResult result,
                    const RunControl& control) {
  check_begun(scene, settings, result);
  return run_passes(settings.until, pass_maker(scene, settings), std::move(result), control);
}

bool gathers(const Scene& scene, const RenderSettings& settings) {
  const auto gathers = info_of(settings.integrator).gathers;
  return gathers && gathers(scene, settings);
}

std::vector<std::string> stage_lines(const Scene& scene, const RenderSettings& settings, const SceneFacts& shown) {
  return info_of(settings.integrator).stages(scene, settings, shown);
}

std::vector<std::string> integrator_warnings(const SceneFacts& shown, const RenderSettings& settings,
                                             const RenderStatistics& statistics) {
  const auto warnings = info_of(settings.integrator).warnings;
  return warnings ? warnings(shown, settings, statistics) : std::vector<std::string>{};
}

std::vector<std::string> layer_names(const RenderSettings& settings) {
  const auto layers = info_of(settings.integrator).layers;
  return layers ? layers(settings) : std::vector<std::string>{};
}

size_t layer_films(const RenderSettings& settings) {
  return layer_names(settings).size() + view_films(settings.layers);
}

size_t layer_channels(const RenderSettings& settings) {
  constexpr size_t kOfTechniqueLayer = 6;  // red, green, blue, and variances of these
  return kOfTechniqueLayer * layer_names(settings).size() + view_channels(settings.layers);
}

}  // namespace vpm
