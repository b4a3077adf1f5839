// What photon tracing asks of other settings; and all components that ask anything.
#include "vpm/integrators/photon_map/check.h"

#include "vpm/integrators/photon_map/integrator.h"
#include "vpm/integrators/photon_map/plan.h"
#include "vpm/integrators/photon_map/surface/final_gather.h"
#include "vpm/integrators/photon_map/surface/pixel_radii.h"
#include "vpm/integrators/photon_map/volume/estimator_info.h"

namespace vpm {
namespace {

void check_photons(const RenderSettings& s) {
  refuse_if(s.photons.emitted == 0 && s.photons.stored == 0, "integrator.photons.emitted",
            "no photon would be emitted: 'emitted' and 'stored' are both 0", "make one of them positive");
}

void check_blocks(const RenderSettings& s) {
  refuse_in_blocks(s, s.photons.emitted == 0 || s.photons.stored > 0, "integrator.photons.stored",
                   "the number of photons of a pass is that of 'emitted'", "write 'emitted' instead");
  refuse_in_blocks(s, s.photons.in_cube > 0, "integrator.photons.in_cube",
                   "photons of different blocks cannot be merged", "leave out 'in_cube'");
}

void check_transmittance(const RenderSettings& s, const SceneFacts& facts) {
  const std::string& name = s.transmittance.estimator;
  refuse_if(name != TransmittanceSettings{}.estimator && !casts_shadow_rays(facts, s), "integrator.transmittance.type",
            "nothing asks '" + name + "': shadow rays do, and none are cast",
            "write type = \"shadow-rays\" in [integrator.single_scattering] or [integrator.direct] of what scatters, "
            "or leave out [integrator.transmittance]");
}

}  // namespace

void refuse_in_blocks(const RenderSettings& s, bool contradiction, const char* key, const std::string& why,
                      const std::string& right) {
  refuse_if(s.photons.block > 0 && contradiction, key, "where 'block' of [integrator.photons] is above 0 " + why,
            right + ", or leave out 'block'");
}

void refuse_count_in_blocks(const RenderSettings& s, const AskedGather& gather, const char* key, const char* right) {
  refuse_in_blocks(s, gather.goes_by_count(), key, "no radius can go by a count of photons of all blocks", right);
}

void refuse_correction_in_cubes(const RenderSettings& s, const AskedGather& gather, const char* key) {
  refuse_if(s.photons.in_cube > 0 && gather.boundary == BoundaryRule::corrected, key,
            "there is no correction at borders where 'in_cube' of [integrator.photons] merges photons across them",
            "leave out 'boundary', or 'in_cube'");
}

void check_photon_maps(const RenderSettings& s, const SceneFacts& facts) {
  check_photons(s);
  check_blocks(s);
  if (s.volume.info().check) s.volume.info().check(s, facts);
  check_surface_map(s);
  check_final_gather(s);
  check_pixel_radii(s);
  check_transmittance(s, facts);
}

}  // namespace vpm
