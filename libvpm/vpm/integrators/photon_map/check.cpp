// What components of photon maps ask of each other and of the scene.
#include <fmt/format.h>

#include "vpm/base/settings/setting_error.h"
#include "vpm/integrators/photon_map/integrator.h"
#include "vpm/integrators/photon_map/plan.h"
#include "vpm/integrators/photon_map/volume/estimator_info.h"

namespace vpm {
namespace {

void check_photons(const RenderSettings& s) {
  refuse_if(s.photons.emitted == 0 && s.photons.stored == 0, "integrator.photons.emitted",
            "no photon would be emitted: 'emitted' and 'stored' are both 0", "make one of them positive");
  refuse_if(s.photons.in_cube > 0 && s.radii == RadiusSchedule::per_pixel, "integrator.photons.in_cube",
            "where 'radii' are \"per-pixel\" photons are counted, so that none may be merged",
            "write 0, or other radii");
}

/// Blocks of photons are each gathered as if they were all: sums over photons add up, and nothing else does.
void check_blocks(const RenderSettings& s) {
  if (s.photons.block == 0) return;
  const std::string blocks = "where 'block' of [integrator.photons] is above 0 ", or_all = ", or leave out 'block'";
  refuse_if(s.photons.emitted == 0 || s.photons.stored > 0, "integrator.photons.stored",
            blocks + "the number of photons of a pass is that of 'emitted'", "write 'emitted' instead" + or_all);
  refuse_if(s.photons.in_cube > 0, "integrator.photons.in_cube",
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
  if (s.indirect.type != IndirectLight::final_gather) return;
  refuse_if(s.caustics.goes_by_count(), "integrator.caustics.type", radii, "write \"radius\"" + or_all);
  refuse_if(s.indirect.rays_by == GatherBy::photons, "integrator.indirect.rays_by",
            blocks + "the photons of one block would guide its rays otherwise than those of another",
            "write \"material\"" + or_all);
  refuse_if(s.indirect.irradiance == EndIrradiance::precomputed, "integrator.indirect.irradiance",
            blocks + "irradiance would be computed at the places of one block's photons, from these alone",
            "write \"estimate\"" + or_all);
  refuse_if(s.caustics.emitted > 0, "integrator.caustics.emitted",
            blocks + "photons that are aimed have none of their own",
            "leave out 'emitted' of [integrator.caustics]" + or_all);
}

void check_transmittance(const RenderSettings& s, const SceneFacts& facts) {
  const std::string& name = s.transmittance.estimator;
  refuse_if(name != TransmittanceSettings{}.estimator && !casts_shadow_rays(facts, s), "integrator.transmittance.type",
            "nothing asks '" + name + "': shadow rays do, and none are cast",
            "write type = \"shadow-rays\" in [integrator.single_scattering] or [integrator.direct] of what scatters, "
            "or leave out [integrator.transmittance]");
}

void check_flights(const RenderSettings& s, const SceneFacts& facts) {
  const VolumeEstimatorInfo& volume = s.volume.info();
  if (!volume.flights) return;
  refuse_if(s.photons.in_cube > 0 && volume.along_rays, "integrator.photons.in_cube",
            "where beams cross rays, the collisions near these weigh by their own directions, and must not be merged",
            "write 0, or another 'type' in [integrator.volume]");
  refuse_if(s.photons.stored > 0 && !volume.collisions, "integrator.photons.stored",
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
  refuse_if((in_media || on_surfaces) && s.photons.in_cube > 0,
            in_media ? "integrator.volume.boundary" : "integrator.surface.boundary",
            "there is no correction at borders where 'in_cube' of [integrator.photons] merges photons across them",
            "leave out 'boundary', or 'in_cube'");
}

void check_final_gathering(const RenderSettings& s) {
  if (s.indirect.type != IndirectLight::final_gather || s.indirect.irradiance != EndIrradiance::precomputed) return;
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
  refuse_if(s.indirect.type == IndirectLight::final_gather, "integrator.indirect.type",
            pixels + "there is no final gathering", "take indirect light from \"photons\", or write other radii");
  refuse_if(s.surface.boundary == BoundaryRule::corrected, "integrator.surface.boundary",
            pixels + "the number of photons found sets the radius, so that none may be left out at borders",
            "write \"none\", or other radii");
}

}  // namespace

void check_photon_maps(const RenderSettings& s, const SceneFacts& facts) {
  check_photons(s);
  check_blocks(s);
  check_flights(s, facts);
  check_borders(s);
  check_final_gathering(s);
  check_radii_of_pixels(s);
  check_transmittance(s, facts);
}

}  // namespace vpm
