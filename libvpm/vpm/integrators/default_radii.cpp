// A radius holds so many photons, within bounds of the picture, the medium and the scene.
#include "vpm/integrators/default_radii.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <string_view>
#include <tuple>

#include "vpm/estimate/photon_map.h"
#include "vpm/integrators/combined/combined_pass.h"
#include "vpm/integrators/describe.h"
#include "vpm/integrators/photon_map/plan.h"

namespace vpm {
namespace {

constexpr double kHalfPixel = 0.5;               // pixels: the least radius
constexpr uint64_t kPhotonsOfDefaults = 20'000;  // by which densities are measured

float rounded_radius(double radius) { return static_cast<float>(rounded(radius, 3)); }

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
/// not: they are no wider than what is taken where nobody chooses, nor than the medium is thick, unless a pilot then
/// measures less error.
ChosenRadius narrow(const ChosenRadius& chosen, const OpenRadius& open, const Scene& scene) {
  AskedGather usual = open.gather;
  usual.radius = {};
  const bool media = open.key == std::string_view("integrator.volume.radius");
  float most = media ? first_radius_of_merges(usual, scene) : first_radius(usual, scene);
  const char* bound = "1 % of the scene's or the grid's diagonal";
  if (media && open.density) {
    const double thin = std::max(open.density->thickness, kHalfPixel * open.density->footprint);
    if (thin < double{most})
      std::tie(most, bound) = std::pair(rounded_radius(thin), "the thickness of the medium, or half a pixel");
  }
  if (chosen.radius <= most) return chosen;
  return {most, fmt::format("{}, as merges are not corrected at borders; photon maps would have {:.3g} m: {}", bound,
                            chosen.radius, chosen.reason)};
}

}  // namespace

double rounded(double value, int digits) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) + 1 - digits);
  return unit >= 1.0 ? std::round(value / unit) * unit : std::round(value / unit) / std::round(1.0 / unit);
}

ChosenRadius choose_radius(const MapDensity& density, double emitted, double diagonal) {
  const auto holding = [&](double records) {  // the radius, m
    const double share = records / density.within * density.emitted / emitted;
    return density.reach * std::pow(share, 1.0 / density.dimension);
  };
  const auto within = [&](double records) {
    return fmt::format("{:g} {} of the first pass are within it at a typical place of the picture", records,
                       density.records);
  };
  const double wanted = holding(kPhotonsWithin), half_pixel = kHalfPixel * density.footprint;
  const std::string would = fmt::format("{:.3g} m would hold {:g} {} at a typical place of the picture", wanted,
                                        kPhotonsWithin, density.records);
  double radius = wanted;
  std::string reason = within(kPhotonsWithin);
  if (radius < half_pixel) std::tie(radius, reason) = std::pair(half_pixel, "half a pixel; " + would);
  const auto keep_below = [&](double bound, const std::string& name) {
    if (radius > bound) std::tie(radius, reason) = std::pair(bound, name + "; " + would);
  };
  const auto keep_in_medium = [&](double bound, const std::string& name) {
    const double least = holding(kLeastWithin);
    if (bound < least)
      keep_below(least, within(kLeastWithin) + ", and fewer within " + name);
    else
      keep_below(bound, name);
  };
  keep_in_medium(kShareOfMedium * density.thickness, "a tenth of the medium's thickness");
  keep_in_medium(density.free_path, "the mean free path there");
  keep_below(kLargestRadius * diagonal, "a twentieth of the scene");
  return {rounded_radius(radius), reason};
}

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

std::optional<MapDensities> densities_for_radii(uint64_t photons, const Scene& scene,
                                                const AutomaticSettings& automatic, const RenderSettings& settings) {
  if (settings.integrator == Integrator::path) return std::nullopt;
  const RenderSettings maps = as_maps(settings);
  const Estimators planned = plan_estimators(scene, maps, 0);
  for (const MapInfo& map : planned.maps())
    if (automatic.has("integrator.photons.emitted") || automatic.has(fmt::format("integrator.{}.radius", map.section)))
      return map_densities(scene, maps, photons);
  return std::nullopt;
}

std::vector<Choice> choose_default_radii(const Scene& scene, const AutomaticSettings& automatic,
                                         RenderSettings& settings) {
  const uint64_t emitted = settings.photons.emitted;
  const uint64_t photons = emitted > 0 ? std::min(emitted, kPhotonsOfDefaults) : kPhotonsOfDefaults;
  const auto densities = densities_for_radii(photons, scene, automatic, settings);
  return densities ? choose_radii(scene, automatic, *densities, settings) : std::vector<Choice>();
}

void scale_radii(const std::vector<Choice>& radii, double factor, RenderSettings& settings) {
  for (const Choice& choice : radii) {
    const Setting setting = find_setting(settings, choice.key).value();
    setting.set(static_cast<float>(rounded(factor * std::get<float>(setting.get()), 3)));
  }
}

double widest_factor(const std::vector<Choice>& radii, const Scene& scene, RenderSettings settings) {
  double widest = kInfinity;
  for (const Choice& choice : radii)
    widest = std::min(widest, kLargestRadius * double{scene.bounds.diagonal()} /
                                  double{std::get<float>(find_setting(settings, choice.key)->get())});
  return std::max(1.0, widest);
}

}  // namespace vpm
