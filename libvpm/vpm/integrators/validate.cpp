// The rules: ranges by the descriptions of settings, then what components ask of each other and of the scene.
#include "vpm/integrators/validate.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "vpm/integrators/describe.h"
#include "vpm/integrators/photon_map/plan.h"
#include "vpm/integrators/photon_map/volume/estimators.h"
#include "vpm/integrators/words.h"

namespace vpm {
namespace {

void refuse_if(bool contradiction, const char* key, const std::string& wrong, const std::string& right) {
  if (contradiction) throw SettingError(key, wrong, right);
}

/// Each setting by itself.
void check_values(RenderSettings s) {
  for (const Setting& setting : describe(s)) {
    const SettingValue value = setting.get();
    if (value == setting.usual) continue;
    if (const std::string wrong = outside_of(setting.domain, value); !wrong.empty())
      throw SettingError(setting.key, fmt::format("'{}' of [{}] {}", setting.name(), setting.table(), wrong), "");
  }
}

/// "did you mean ..." would mislead here: the name exists, but belongs to something else.
std::string listed(const char* title, const std::vector<std::string>& names) {
  return fmt::format("{}: {}", title, fmt::join(names, ", "));
}

void check_strategy(const RenderSettings& s, const SceneFacts& facts) {
  refuse_if(facts.grids && !strategy_info(s.distance.strategy).heterogeneous, "integrator.distance.type",
            "the strategy '" + s.distance.strategy + "' is wrong in a grid medium, and the scene has one",
            listed("right in grids", strategies_that(&StrategyInfo::heterogeneous)));
}

void check_photons(const RenderSettings& s) {
  refuse_if(s.photons_emitted == 0 && s.photons_stored == 0, "integrator.photons.emitted",
            "no photon would be emitted: 'emitted' and 'stored' are both 0", "make one of them positive");
  refuse_if(s.photons_in_cube > 0 && s.radii == RadiusSchedule::per_pixel, "integrator.photons.in_cube",
            "where 'radii' are \"per-pixel\" photons are counted, so that none may be merged",
            "write 0, or other radii");
}

/// Blocks of photons are each gathered as if they were all: sums over photons add up, and nothing else does.
void check_blocks(const RenderSettings& s) {
  if (s.photons_block == 0) return;
  const std::string blocks = "where 'block' of [integrator.photons] is above 0 ", or_all = ", or leave out 'block'";
  refuse_if(s.photons_emitted == 0 || s.photons_stored > 0, "integrator.photons.stored",
            blocks + "the number of photons of a pass is that of 'emitted'", "write 'emitted' instead" + or_all);
  refuse_if(s.photons_in_cube > 0, "integrator.photons.in_cube",
            blocks + "photons of different blocks cannot be merged", "leave out 'in_cube'" + or_all);
  refuse_if(s.volume.info().flights && s.volume.flights > 0, "integrator.volume.flights",
            blocks + "flights cannot be drawn from those of all blocks", "leave out 'flights'" + or_all);
  const std::string radii = blocks + "no radius can go by a count of photons of all blocks";
  refuse_if(s.volume.goes_by_count(), s.volume.beam_count > 0 ? "integrator.volume.count" : "integrator.volume.type",
            radii, "gather photons within a radius" + or_all);
  refuse_if(s.surface.goes_by_count(), "integrator.surface.type", radii, "write \"radius\"" + or_all);
  refuse_if(s.volume.info().planes, "integrator.volume.type",
            blocks + "planes cannot be drawn from the flights of all blocks", "write \"photon-beams\"" + or_all);
  refuse_if(!s.volume.info().collisions, "integrator.volume.type",
            blocks + "eye rays do not know where the beams of all blocks lie, among which they would march",
            "write \"photon-beams\"" + or_all);
  if (s.surface_indirect != IndirectLight::final_gather) return;
  refuse_if(s.caustics.goes_by_count(), "integrator.caustics.type", radii, "write \"radius\"" + or_all);
  refuse_if(s.gather_by == GatherBy::photons, "integrator.indirect.rays_by",
            blocks + "the photons of one block would guide its rays otherwise than those of another",
            "write \"material\"" + or_all);
  refuse_if(s.end_irradiance == EndIrradiance::precomputed, "integrator.indirect.irradiance",
            blocks + "irradiance would be computed at the places of one block's photons, from these alone",
            "write \"estimate\"" + or_all);
  refuse_if(s.caustics_emitted > 0, "integrator.caustics.emitted",
            blocks + "photons that are aimed have none of their own",
            "leave out 'emitted' of [integrator.caustics]" + or_all);
}

void check_transmittance(const RenderSettings& s, const SceneFacts& facts) {
  const std::string& name = s.transmittance.estimator;
  refuse_if(name != TransmittanceSettings{}.estimator &&
                !casts_shadow_rays({facts.scattering_media, facts.rough_surfaces}, s),
            "integrator.transmittance.type", "nothing asks '" + name + "': shadow rays do, and none are cast",
            "write type = \"shadow-rays\" in [integrator.single_scattering] or [integrator.direct] of what scatters, "
            "or leave out [integrator.transmittance]");
}

void check_flights(const RenderSettings& s, const SceneFacts& facts) {
  const VolumeEstimatorInfo& volume = s.volume.info();
  if (!volume.flights) return;
  refuse_if(s.photons_in_cube > 0 && volume.along_rays, "integrator.photons.in_cube",
            "where beams cross rays, the collisions near these weigh by their own directions, and must not be merged",
            "write 0, or another 'type' in [integrator.volume]");
  refuse_if(s.photons_stored > 0 && !volume.collisions, "integrator.photons.stored",
            "flights do not count towards the photons stored, and in media nothing else is: 'type' of "
            "[integrator.volume] is \"" +
                s.volume.type() + "\"",
            "write 'emitted' instead, or another 'type' in [integrator.volume]");
  refuse_if(facts.endless_flights, "integrator.volume.type",
            "flights have no end in a channel that the medium of the world does not attenuate",
            "write \"beam\", or put the scene into a box of the medium");
  refuse_if(s.volume.length == BeamLength::long_beams && facts.endless, "integrator.volume.length",
            "the medium of the world has no end, and long beams would have none",
            "write \"short\", or put the scene into a box of the medium");
  refuse_if(!strategy_info(s.distance.strategy).analog, "integrator.distance.type",
            "flights by '" + s.distance.strategy + "' do not end as the transmittance says, so that they are no beams",
            "write another 'type' in [integrator.volume], or another strategy; " +
                listed("right for photon beams", strategies_that(&StrategyInfo::analog)));
}

void check_borders(const RenderSettings& s) {
  const bool in_media = s.volume.boundary == BoundaryRule::corrected && !s.volume.info().along_rays;
  const bool on_surfaces = s.surface.boundary == BoundaryRule::corrected;
  refuse_if((in_media || on_surfaces) && s.photons_in_cube > 0,
            in_media ? "integrator.volume.boundary" : "integrator.surface.boundary",
            "there is no correction at borders where 'in_cube' of [integrator.photons] merges photons across them",
            "leave out 'boundary', or 'in_cube'");
}

void check_final_gathering(const RenderSettings& s) {
  if (s.surface_indirect != IndirectLight::final_gather || s.end_irradiance != EndIrradiance::precomputed) return;
  refuse_if(s.surface.boundary == BoundaryRule::corrected, "integrator.indirect.irradiance",
            "irradiance is computed beforehand without a correction at borders",
            "write \"estimate\", or make 'boundary' of [integrator.surface] \"none\"");
  refuse_if(kernel_order(s.surface.kernel) > 2, "integrator.surface.kernel",
            "irradiance computed beforehand must not be negative, as that by a kernel of order 4 may be",
            "use another kernel, or make 'irradiance' \"estimate\"");
}

/// Radii of pixels' own are those of gathers by radius, straight from the map of single photons.
void check_radii_of_pixels(const RenderSettings& s) {
  if (s.radii != RadiusSchedule::per_pixel) return;
  const std::string pixels = "where 'radii' of [integrator] are \"per-pixel\" ";
  refuse_if(
      s.until.first > 0, "integrator.radii",
      pixels + fmt::format("they follow from all passes before, so that no piece begins with pass {}", s.until.first),
      "write other radii, or render all passes in one run");
  refuse_if(s.surface.mode != GatherMode::radius, "integrator.surface.type", pixels + "surfaces gather by radius",
            "write \"radius\", or other radii");
  refuse_if(kernel_order(s.surface.kernel) > 2, "integrator.surface.kernel",
            pixels + "the rule of radii is for kernels whose bias goes with their square",
            "use another kernel, or write other radii");
  refuse_if(s.surface_indirect == IndirectLight::final_gather, "integrator.indirect.type",
            pixels + "there is no final gathering", "take indirect light from \"photons\", or write other radii");
  refuse_if(s.surface.boundary == BoundaryRule::corrected, "integrator.surface.boundary",
            pixels + "the number of photons found sets the radius, so that none may be left out at borders",
            "write \"none\", or other radii");
}

void check_photon_map(const RenderSettings& s, const SceneFacts& facts) {
  check_photons(s);
  check_blocks(s);
  check_flights(s, facts);
  check_borders(s);
  check_final_gathering(s);
  check_radii_of_pixels(s);
  check_transmittance(s, facts);
}

void check_combined(const RenderSettings& s, const SceneFacts& facts) {
  const TechniqueSet& techniques = s.combined.techniques;
  refuse_if(facts.endless && techniques.has(Technique::long_beams), "integrator.techniques",
            "the medium of the world has no end, and long beams would have none",
            "leave out \"long-beams\", or put the scene into a box of the medium");
  refuse_if(facts.endless_flights && techniques.has(Technique::short_beams), "integrator.techniques",
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
  check_values(settings);
  check_strategy(settings, facts);
  if (settings.integrator == Integrator::photon) check_photon_map(settings, facts);
  if (settings.integrator == Integrator::combined) check_combined(settings, facts);
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

}  // namespace vpm
