// What photons have left of their powers along their flights, and where flights are beams.
#include "vpm/integrators/photon_map/volume/beam_maps.h"

#include "vpm/base/counters.h"
#include "vpm/integrators/photon_map/check.h"
#include "vpm/integrators/photon_map/volume/estimators.h"
#include "vpm/medium/distance/mixture.h"
#include "vpm/scene/scene_facts.h"

namespace vpm {
namespace {

double counted_integral(const Medium& medium, const Ray& beam, float s, WalkCounters& counters) {
  const DensityIntegral integral = density_integral(medium, beam, {0.0f, s});
  count(counters.lookups, integral.lookups);
  return integral.value;
}

/// At the distance `s` on a beam.
Rgb left_along(const Medium& medium, bool long_beams, const Ray& beam, const Rgb& power, float s,
               WalkCounters& counters) {
  if (long_beams) return transmittance(medium, counted_integral(medium, beam, s, counters));
  return weight_along(medium, beam, power, s, counters);
}

}  // namespace

Rgb weight_along(const Medium& medium, const Ray& beam, const Rgb& power, float s, WalkCounters& counters) {
  if (is_grey(medium.sigma_t)) return Rgb(1.0f);
  return analog_weight(medium, channel_shares(power), counted_integral(medium, beam, s, counters), false);
}

void multiply_by_left(const Medium& medium, const VolumeSettings& settings, const Vec3& origin, const BeamPlaces& found,
                      Passed& passed, WalkCounters& counters) {
  const bool long_beams = settings.length == BeamLength::long_beams;
  const bool fades = long_beams || !is_grey(medium.sigma_t);
  const bool by_density = settings.form == VolumeForm::density_at_photon;
  if (!fades && !by_density) return;
  for (size_t i = 0; i < found.size; ++i) {
    const Vec3 direction(found.dx[i], found.dy[i], found.dz[i]);
    const Vec3 place = origin + Vec3(found.x[i], found.y[i], found.z[i]);
    Rgb left(1.0f);
    if (fades)
      left = left_along(medium, long_beams, {place - found.s[i] * direction, direction},
                        {found.r[i], found.g[i], found.b[i]}, found.s[i], counters);
    if (by_density) left *= medium.density(place);
    passed.r[i] *= left.r;
    passed.g[i] *= left.g;
    passed.b[i] *= left.b;
  }
  if (by_density) count(counters.lookups, found.size);
}

void check_flights(const RenderSettings& s, const SceneFacts& facts) {
  refuse_in_blocks(s, s.volume.flights > 0, "integrator.volume.flights",
                   "flights cannot be drawn from those of all blocks", "leave out 'flights'");
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

}  // namespace vpm
