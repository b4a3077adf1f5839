// How many photons or light sub-paths a pass has, and within which radii they are gathered.
#include "vpm/tune/choose_records.h"

#include <fmt/format.h>
#include <algorithm>
#include <string_view>

#include "vpm/estimate/photon_map.h"
#include "vpm/integrators/combined/combined_pass.h"
#include "vpm/integrators/photon_map/plan.h"
#include "vpm/integrators/photon_map/volume/estimator_info.h"
#include "vpm/tune/choice_rules.h"

namespace vpm {
namespace {

constexpr uint64_t kPhotonsOfPilot = 100'000, kPhotonsOfDefaults = 20'000;  // by which densities are measured

/// A gather radius to be chosen.
struct OpenRadius {
  const char* key;
  AskedGather& gather;
  const std::optional<MapDensity>& density;
  double emitted;
};

/// Those of maps that the render has.
std::vector<OpenRadius> open_radii(const Scene& scene, const AutomaticSettings& automatic,
                                   const MapDensities& densities, RenderSettings& s) {
  const Estimators planned = plan_estimators(scene, s, 0);
  const auto has = [&](std::string_view section) {
    for (const MapInfo& map : planned.maps())
      if (map.section == section) return true;
    return false;
  };
  const double emitted = photons_of_pass(s, densities.stored_per_photon);
  const double aimed = s.aimed_photons() > 0 ? static_cast<double>(s.aimed_photons()) : emitted;
  std::vector<OpenRadius> open;
  const auto add = [&](const char* section, const char* key, AskedGather& gather,
                       const std::optional<MapDensity>& density, double photons) {
    const bool asked = gather.goes_by_count() ? automatic.keys.contains(key) : automatic.has(key);
    if (asked && has(section)) open.push_back({key, gather, density, photons});
  };
  add("volume", "integrator.volume.radius", s.volume, densities.volume, emitted);
  add("surface", "integrator.surface.radius", s.surface, densities.surface, emitted);
  add("caustics", "integrator.caustics.radius", s.caustics, densities.caustics, aimed);
  return open;
}

/// The photon maps whose radii merges have, where techniques are combined; else the settings themselves.
RenderSettings as_maps(const RenderSettings& settings) {
  RenderSettings maps = settings;
  if (settings.integrator != Integrator::combined) return maps;
  maps.integrator = Integrator::photon;
  maps.volume.choose("radius");
  maps.surface.mode = GatherMode::radius;
  return maps;
}

/// Merges of combined techniques lose light within a radius of borders, and other techniques find what few photons do
/// not: they are no wider than what is taken where nobody chooses, unless a pilot then measures less error.
ChosenRadius narrow(const ChosenRadius& chosen, const OpenRadius& open, const Scene& scene) {
  AskedGather usual = open.gather;
  usual.radius = {};
  const bool media = open.key == std::string_view("integrator.volume.radius");
  const float most = media ? first_radius_of_merges(usual, scene) : first_radius(usual, scene);
  if (chosen.radius <= most) return chosen;
  return {most, fmt::format("1 % of the scene's or the grid's diagonal, as merges are not corrected at "
                            "borders; photon maps would have {:.3g} m: {}",
                            chosen.radius, chosen.reason)};
}

/// Sets the radii that are chosen, for the settings' number of photons.
std::vector<Choice> choose_radii(const Scene& scene, const AutomaticSettings& automatic, const MapDensities& densities,
                                 RenderSettings& settings) {
  std::vector<Choice> choices;
  RenderSettings maps = as_maps(settings);
  const double diagonal = scene.bounds.diagonal();
  for (const OpenRadius& open : open_radii(scene, automatic, densities, maps)) {
    ChosenRadius chosen;
    if (open.gather.goes_by_count())
      chosen = {rounded_radius(kDefaultSearch * diagonal), "a tenth of the scene at the most: 'count' decides"};
    else if (!open.density)
      chosen = {rounded_radius(kLargestRadius * diagonal), "a twentieth of the scene: the pilot met too few photons"};
    else
      chosen = choose_radius(*open.density, open.emitted, diagonal);
    if (settings.integrator == Integrator::combined) chosen = narrow(chosen, open, scene);
    open.gather.radius = chosen.radius;
    choices.push_back({open.key, fmt::format("{}", chosen.radius), chosen.reason});
  }
  settings.volume.radius = maps.volume.radius;
  settings.surface.radius = maps.surface.radius;
  settings.caustics.radius = maps.caustics.radius;
  return choices;
}

/// For points, whose eye pass takes about as long under radii that are chosen for any number of photons.
ChosenCount choose_count_of_points(double seconds, const std::function<PassCost(uint64_t)>& cost_of) {
  constexpr uint64_t kFirst = 20'000;    // photons
  constexpr uint64_t kMost = 1'000'000;  // of a pilot that asks again with the number found
  ChosenCount chosen{kFirst, ""};
  for (int round = 0; round < 2; ++round) chosen = choose_count(cost_of(std::min(chosen.count, kMost)), seconds);
  if (seconds == 0.0) return chosen;
  return make_fit(chosen, seconds,
                  [&](uint64_t photons) { return cost_of(photons).seconds(static_cast<double>(photons)); });
}

/// Costs a pass under radii as they would be, in timings of `limit` s at the most.
Choice choose_photons(const Scene& scene, const AutomaticSettings& automatic, const MapDensities& densities,
                      double limit, RenderSettings& settings) {
  const double seconds = settings.until.seconds;
  RenderSettings tried = settings;
  const auto cost_of = [&](uint64_t photons) {
    tried.photons.emitted = photons;
    choose_radii(scene, automatic, densities, tried);
    return time_pass(scene, tried, limit);
  };
  const ChosenCount chosen =
      (crosses_flights(settings) ? choose_count_of_flights : choose_count_of_points)(kPassesShare * seconds, cost_of);
  settings.photons.emitted = chosen.count;
  std::string reason = chosen.reason;
  if (settings.volume.info().planes && settings.integrator == Integrator::photon)
    reason += fmt::format(
        "; with {} planes ('planes' of [integrator.volume]), each of which costs a shadow ray where it is "
        "crossed",
        settings.volume.planes);
  return {"integrator.photons.emitted", fmt::format("{}", chosen.count), reason};
}

/// What a pilot of so many photons says of densities; nothing where there is nothing to choose.
std::optional<MapDensities> densities_by(uint64_t photons, const Scene& scene, const AutomaticSettings& automatic,
                                         const RenderSettings& settings) {
  if (settings.integrator == Integrator::path) return std::nullopt;
  const RenderSettings maps = as_maps(settings);
  const Estimators planned = plan_estimators(scene, maps, 0);
  for (const MapInfo& map : planned.maps())
    if (automatic.has("integrator.photons.emitted") || automatic.has(fmt::format("integrator.{}.radius", map.section)))
      return map_densities(scene, maps, photons);
  return std::nullopt;
}

}  // namespace

bool crosses_flights(const RenderSettings& settings) {
  const TechniqueSet& techniques = settings.combined.techniques;
  return settings.integrator == Integrator::combined ? techniques.has(Technique::short_beams)
                                                     : settings.volume.info().flights;
}

std::optional<MapDensities> densities_for_records(const Scene& scene, const AutomaticSettings& automatic,
                                                  const RenderSettings& settings) {
  return densities_by(in_a_hurry(kPhotonsOfPilot, settings), scene, automatic, settings);
}

std::vector<Choice> choose_default_radii(const Scene& scene, const AutomaticSettings& automatic,
                                         RenderSettings& settings) {
  RenderSettings unhurried = settings;
  unhurried.until = {};
  const uint64_t emitted = settings.photons.emitted;
  const uint64_t photons = emitted > 0 ? std::min(emitted, kPhotonsOfDefaults) : kPhotonsOfDefaults;
  const auto densities = densities_by(photons, scene, automatic, unhurried);
  return densities ? choose_radii(scene, automatic, *densities, settings) : std::vector<Choice>();
}

std::vector<Choice> choose_records(const Scene& scene, const AutomaticSettings& automatic,
                                   const std::optional<MapDensities>& densities, double limit,
                                   RenderSettings& settings) {
  if (!densities) return {};
  std::vector<Choice> choices;
  if (automatic.has("integrator.photons.emitted"))
    choices.push_back(choose_photons(scene, automatic, *densities, limit, settings));
  for (Choice& choice : choose_radii(scene, automatic, *densities, settings)) choices.push_back(std::move(choice));
  return choices;
}

std::vector<Choice> choose_records(const Scene& scene, const AutomaticSettings& automatic, double limit,
                                   RenderSettings& settings) {
  return choose_records(scene, automatic, densities_for_records(scene, automatic, settings), limit, settings);
}

}  // namespace vpm
