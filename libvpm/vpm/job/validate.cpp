// The rules: ranges and needs by the declarations, then what settings ask of each other, section by section.
#include "vpm/job/validate.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "vpm/job/declare.h"
#include "vpm/render/plan.h"

namespace vpm {
namespace {

void refuse_if(bool contradiction, const char* key, const std::string& wrong, const std::string& right) {
  if (contradiction) throw SettingError(key, wrong, right);
}

/// Each setting by itself.
void check_declared(const RenderSettings& s) {
  const RenderSettings usual;
  for (const Setting& setting : all_settings()) {
    if (!setting.stands_for.empty()) continue;
    const SettingValue value = setting.member.get(s);
    if (value == setting.member.get(usual)) continue;
    if (const std::string wrong = outside_of(setting.domain, value); !wrong.empty())
      throw SettingError(setting.key, fmt::format("'{}' of [{}] {}", setting.name(), setting.section(), wrong), "");
    if (!find_setting(setting.key, s))
      throw SettingError(setting.key, setting.need.wrong(s), std::string(setting.need.right));
  }
}

void check_photons(const RenderSettings& s) {
  refuse_if(s.photons_emitted == 0 && s.photons_stored == 0, "photons.emitted",
            "no photon would be emitted: 'emitted' and 'stored' are both 0", "make one of them positive");
  refuse_if(s.photons_in_cube > 0 && s.radii == RadiusSchedule::per_pixel, "photons.in_cube",
            "where render.radii is \"per-pixel\" photons are counted, so that none may be merged",
            "write 0, or other radii");
}

/// Blocks of photons are each gathered as if they were all: sums over photons add up, and nothing else does.
void check_blocks(const RenderSettings& s) {
  if (s.photons_block == 0 || s.integrator != Integrator::photon) return;
  const std::string blocks = "where 'block' of [photons] is above 0 ", or_all = ", or leave out 'block'";
  refuse_if(s.photons_emitted == 0 || s.photons_stored > 0, "photons.stored",
            blocks + "the number of photons of a pass is that of 'emitted'", "write 'emitted' instead" + or_all);
  refuse_if(s.photons_in_cube > 0, "photons.in_cube", blocks + "photons of different blocks cannot be merged",
            "leave out 'in_cube'" + or_all);
  refuse_if(s.flights > 0, "photons.flights", blocks + "flights cannot be drawn from those of all blocks",
            "leave out 'flights'" + or_all);
  const std::string radii = blocks + "no radius can go by a count of photons of all blocks";
  refuse_if(s.volume.goes_by_count(), s.volume.mode == GatherMode::beam ? "volume.count" : "volume.gather", radii,
            "gather photons within a radius" + or_all);
  refuse_if(s.surface.goes_by_count(), "surface.gather", radii, "write \"radius\"" + or_all);
  refuse_if(s.caustics.goes_by_count(), "caustics.gather", radii, "write \"radius\"" + or_all);
  refuse_if(s.volume.mode == GatherMode::photon_planes, "volume.gather",
            blocks + "planes cannot be drawn from the flights of all blocks", "write \"photon-beams\"" + or_all);
  refuse_if(s.volume.mode == GatherMode::beams_points, "volume.gather",
            blocks + "eye rays do not know where the beams of all blocks lie, among which they would march",
            "write \"photon-beams\"" + or_all);
  refuse_if(s.gather_by == GatherBy::photons, "surface.gather_by",
            blocks + "the photons of one block would guide its rays otherwise than those of another",
            "write \"material\"" + or_all);
  refuse_if(s.end_irradiance == EndIrradiance::precomputed, "surface.irradiance",
            blocks + "irradiance would be computed at the places of one block's photons, from these alone",
            "write \"estimate\"" + or_all);
  refuse_if(s.caustics_emitted > 0, "caustics.emitted", blocks + "photons that are aimed have none of their own",
            "leave out 'emitted' of [caustics]" + or_all);
}

/// Ways to use importance, where there is none.
void check_importance(const RenderSettings& s) {
  if (s.guide.importons > 0) return;
  const std::string wrong = "nothing tells what photons are worth: 'importons' of [importance] is 0";
  const std::string right = "make 'importons' positive, or leave out ";
  const GuideSettings usual;
  refuse_if(s.guide.aim != usual.aim, "importance.aim", wrong, right + "'aim'");
  refuse_if(s.guide.split != usual.split, "importance.split", wrong, right + "'split'");
  refuse_if(s.guide.scatter != usual.scatter, "importance.scatter", wrong, right + "'scatter'");
}

/// "did you mean ..." would mislead here: the name exists, but belongs to something else.
std::string strategies_that(bool StrategyInfo::*is, const char* title) {
  std::vector<std::string_view> names;
  for (const StrategyInfo& info : distance_strategies())
    if (info.*is) names.push_back(info.name);
  return fmt::format("{}: {}", title, fmt::join(names, ", "));
}

void check_strategy(const RenderSettings& s, const SceneFacts& facts) {
  const StrategyInfo& info = strategy_info(s.distance.strategy);
  const std::string title = "the strategy '" + s.distance.strategy + "' ";
  refuse_if(facts.grids && !info.heterogeneous, "distance.strategy",
            title + "is wrong in a grid medium, and the scene has one",
            strategies_that(&StrategyInfo::heterogeneous, "right in grids"));
  refuse_if(s.integrator == Integrator::photon && !info.positive, "distance.strategy",
            title + "gives weights below 0, which the power of photons must not have",
            "write integrator = \"path\" in [render], or use another strategy; " +
                strategies_that(&StrategyInfo::positive, "right for photons"));
}

void check_density_floor(const RenderSettings& s) {
  refuse_if(s.density_floor != RenderSettings{}.density_floor && !strategy_info(s.distance.strategy).analog,
            "volume.density_floor",
            "photons by '" + s.distance.strategy + "' do not weigh 1/density, so that there is nothing to bound",
            "leave out 'density_floor', or use another strategy; " +
                strategies_that(&StrategyInfo::analog, "whose photons do"));
  refuse_if(s.density_floor != RenderSettings{}.density_floor && s.volume.mode == GatherMode::beams_points,
            "volume.density_floor",
            "no collisions are gathered whose weights it would bound: 'gather' is \"" + word_of(s.volume.mode) + "\"",
            "leave out 'density_floor', or write another 'gather' in [volume]");
}

void check_estimator(const RenderSettings& s, const SceneFacts& facts) {
  const std::string& name = s.transmittance.estimator;
  refuse_if(name != TransmittanceSettings{}.estimator &&
                !casts_shadow_rays({facts.scattering_media, facts.rough_surfaces}, s),
            "transmittance.estimator", "nothing asks '" + name + "': shadow rays do, and none are cast",
            "write direct = \"shadow-rays\" in [volume] or [surface] of what scatters, or leave out 'estimator'");
}

void check_photon_beams(const RenderSettings& s, const SceneFacts& facts) {
  const std::string gather = "'gather' of [volume] is \"" + word_of(s.volume.mode) + "\"";
  refuse_if(s.planes != RenderSettings{}.planes && s.volume.mode != GatherMode::photon_planes &&
                s.integrator != Integrator::combined,
            "photons.planes", "there are no planes: " + gather,
            "leave out 'planes', or write gather = \"photon-planes\"");
  refuse_if(s.flights > 0 && !s.volume.gathers_flights(), "photons.flights", "no flights are kept: " + gather,
            "leave out 'flights', or write gather = \"photon-beams\"");
  if (!s.volume.gathers_flights() || s.integrator == Integrator::combined) return;
  refuse_if(s.photons_in_cube > 0 && s.volume.crosses_beams(), "photons.in_cube",
            "where beams cross rays, collisions beside these weigh by their own directions, and must not be merged",
            "write 0, or another 'gather' in [volume]");
  refuse_if(s.photons_stored > 0 && s.volume.mode == GatherMode::beams_points, "photons.stored",
            "flights do not count towards the photons stored, and in media nothing else is: " + gather,
            "write 'emitted' instead, or another 'gather' in [volume]");
  refuse_if(facts.endless_flights, "volume.gather",
            "flights have no end in a channel that the medium of the world does not attenuate",
            "write \"beam\", or put the scene into a box of the medium");
  refuse_if(s.beam_length == BeamLength::long_beams && facts.endless, "volume.beams",
            "the medium of the world has no end, and long beams would have none",
            "write \"short\", or put the scene into a box of the medium");
  refuse_if(!strategy_info(s.distance.strategy).analog, "distance.strategy",
            "flights by '" + s.distance.strategy + "' do not end as the transmittance says, so that they are no beams",
            "write another 'gather' in [volume], or another strategy; " +
                strategies_that(&StrategyInfo::analog, "right for photon beams"));
}

void check_borders(const RenderSettings& s) {
  const bool in_media = s.volume.boundary == BoundaryRule::corrected && !s.volume.along_rays();
  const bool on_surfaces = s.surface.boundary == BoundaryRule::corrected;
  refuse_if((in_media || on_surfaces) && s.photons_in_cube > 0, in_media ? "volume.boundary" : "surface.boundary",
            "there is no correction at borders where 'in_cube' of [photons] merges photons across them",
            "leave out 'boundary', or 'in_cube'");
}

void check_final_gathering(const RenderSettings& s) {
  const bool precomputed = s.end_irradiance == EndIrradiance::precomputed;
  refuse_if(precomputed && s.surface.boundary == BoundaryRule::corrected, "surface.irradiance",
            "irradiance is computed beforehand without a correction at borders",
            "write \"estimate\", or make 'boundary' \"none\"");
  refuse_if(precomputed && kernel_order(s.surface.kernel) > 2, "surface.kernel",
            "irradiance computed beforehand must not be negative, as that by a kernel of order 4 may be",
            "use another kernel, or make 'irradiance' \"estimate\"");
  if (s.surface_indirect == IndirectLight::final_gather) return;
  const std::string wrong = "there are no rays to gather light: 'indirect' of [surface] is \"photons\"";
  const std::string right = "make 'method' \"final-gather\", or leave out ";
  refuse_if(s.gather_rays != RenderSettings{}.gather_rays, "surface.gather_rays", wrong, right + "'gather_rays'");
  refuse_if(s.gather_by == GatherBy::photons, "surface.gather_by", wrong, right + "'gather_by'");
  refuse_if(precomputed, "surface.irradiance", wrong, right + "'irradiance'");
  refuse_if(s.caustics_emitted > 0, "caustics.emitted", wrong, right + "'emitted'");
}

/// Radii of pixels' own are those of gathers by radius, straight from the map of single photons.
void check_radii_of_pixels(const RenderSettings& s) {
  if (s.radii != RadiusSchedule::per_pixel) return;
  const std::string pixels = "where render.radii is \"per-pixel\" ";
  refuse_if(
      s.until.first > 0, "render.radii",
      pixels + fmt::format("radii follow from all passes before, so that no piece begins with pass {}", s.until.first),
      "write other radii, or render all passes in one run");
  refuse_if(s.surface.mode != GatherMode::radius, "surface.gather", pixels + "surfaces gather by radius",
            "write \"radius\", or other radii");
  refuse_if(kernel_order(s.surface.kernel) > 2, "surface.kernel",
            pixels + "the rule of radii is for kernels whose bias goes with their square",
            "use another kernel, or write other radii");
  refuse_if(s.surface_indirect == IndirectLight::final_gather, "surface.indirect",
            pixels + "there is no final gathering", "take indirect light from \"photons\", or write other radii");
  refuse_if(s.surface.boundary == BoundaryRule::corrected, "surface.boundary",
            pixels + "the photons found tell the radius, so that none may be left out at borders",
            "write \"none\", or other radii");
}

/// The combined estimator must know the density of each sub-path.
void check_combined(const RenderSettings& s, const SceneFacts& facts) {
  if (s.integrator != Integrator::combined) return;
  const std::string combined = "where render.integrator is \"combined\" ";
  const StrategyInfo& info = strategy_info(s.distance.strategy);
  refuse_if(!info.analog || !info.unbiased, "distance.strategy",
            combined + "flights have the density that the transmittance says, and those by '" + s.distance.strategy +
                "' do not",
            "use \"regular\", which is exact in any medium");
  refuse_if(s.transmittance.estimator != TransmittanceSettings{}.estimator, "transmittance.estimator",
            combined + "transmittance is exact", "leave out 'estimator'");
  refuse_if(s.guide.importons > 0, "importance.importons", combined + "sub-paths go where power does",
            "leave out [importance]");
  refuse_if(s.photons_emitted == 0 || s.photons_stored > 0, "photons.stored",
            combined + "the number of light sub-paths is that of 'emitted'", "write 'emitted' instead");
  refuse_if(s.photons_block > 0, "photons.block", combined + "eye sub-paths have weights by all light sub-paths",
            "leave out 'block'");
  refuse_if(s.photons_in_cube > 0, "photons.in_cube", combined + "each vertex has a weight of its own",
            "leave out 'in_cube'");
  refuse_if(s.radii == RadiusSchedule::per_pixel, "render.radii", combined + "all pixels share their radii",
            "write \"per-pass\" or \"constant\"");
  const TechniqueSet& techniques = s.combined.techniques;
  refuse_if(s.planes != RenderSettings{}.planes && !techniques.has(Technique::planes), "photons.planes",
            "there are no planes: 'techniques' of [combined] leave them out",
            "leave out 'planes', or name \"planes\" in 'techniques'");
  refuse_if(facts.endless && techniques.has(Technique::long_beams), "combined.techniques",
            "the medium of the world has no end, and long beams would have none",
            "leave out \"long-beams\", or put the scene into a box of the medium");
  refuse_if(facts.endless_flights && techniques.has(Technique::short_beams), "combined.techniques",
            "flights have no end in a channel that the medium of the world does not attenuate",
            "leave out \"short-beams\", or put the scene into a box of the medium");
}

}  // namespace

SettingError::SettingError(std::string key, std::string wrong, std::string right)
    : InputError(fmt::format("{}: {}{}{}", key, wrong, right.empty() ? "" : "\n  ", right)),
      key_(std::move(key)),
      wrong_(std::move(wrong)),
      right_(std::move(right)) {}

void SceneFacts::add_world(const Medium& medium) {
  endless = medium.scatters();
  endless_flights = endless && std::min({medium.sigma_t.r, medium.sigma_t.g, medium.sigma_t.b}) == 0.0f;
}

SceneFacts facts_of(const Scene& scene) {
  SceneFacts facts;
  for (const Medium& medium : scene.media) {
    facts.grids |= !medium.homogeneous();
    facts.scattering_media |= medium.scatters();
  }
  if (scene.world_medium != kVacuum) facts.add_world(scene.media[scene.world_medium]);
  for (const Shape& shape : scene.shapes) facts.rough_surfaces |= is_rough(scene.materials[shape.material]);
  return facts;
}

void validate(const RenderSettings& settings, const SceneFacts& facts) {
  check_declared(settings);
  check_photons(settings);
  check_blocks(settings);
  check_importance(settings);
  check_strategy(settings, facts);
  check_density_floor(settings);
  check_photon_beams(settings, facts);
  check_combined(settings, facts);
  check_borders(settings);
  check_final_gathering(settings);
  check_radii_of_pixels(settings);
  check_estimator(settings, facts);
}

void validate_light_map(const RenderSettings& settings, const SceneFacts& facts) {
  validate(settings, facts);
  refuse_if(settings.integrator != Integrator::photon, "render.integrator",
            "light maps are made of photon maps, but render.integrator is \"" + word_of(settings.integrator) + "\"",
            "write \"photon\", or add --set render.integrator=photon");
  refuse_if(settings.radii == RadiusSchedule::per_pixel, "render.radii",
            "texels of a light map have no radii of their own, but render.radii is \"per-pixel\"",
            "write \"per-pass\", or add --set render.radii=per-pass");
  refuse_if(!settings.layers.empty(), "render.layers", "a light map has no layers of what a camera sees",
            "leave out 'layers'");
  refuse_if(settings.until.error > 0.0, "render.error", "a light map is not baked until an error is reached",
            "write 'passes' instead, or add --passes N");
}

}  // namespace vpm
