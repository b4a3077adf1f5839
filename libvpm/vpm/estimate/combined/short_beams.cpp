// Flights of photons that cross whole rays from the camera.
#include <algorithm>

#include "vpm/base/count.h"
#include "vpm/estimate/combined/eye_sub_path.h"
#include "vpm/estimate/eye_segment.h"
#include "vpm/medium/distance/mixture.h"

namespace vpm {

void EyeSubPath::merge_beams(const Along& along, const Interval& interval) {
  const PhotonBeamMap& map = c_.light.beams(along.medium);
  if (map.size() == 0) return;
  const auto kernel = kernel_of<1>(c_.kernels.volume_kernel, c_.kernels.beams);
  count(work_.counters.volume_queries);
  count(work_.counters.gather.searches);
  const Interval near = clip(along.ray, interval, map.bounds(), c_.kernels.beams);
  if (near.empty()) return;
  const uint32_t visited = map.visit_crossings(along.ray, near, [&](const BeamCrossings& found) {
    for (size_t i = 0; i < found.size; ++i) merge_beam(along, found, i, kernel(found.distance2[i]));
  });
  count(work_.counters.gather.visited, visited);
}

void EyeSubPath::merge_beam(const Along& along, const BeamCrossings& found, size_t i, const KernelPair<float>& kernel) {
  const Medium& medium = c_.scene.media[along.medium];
  const Vec3 direction(found.dx[i], found.dy[i], found.dz[i]);
  const Vec3 place = along.ray.origin + Vec3(found.x[i], found.y[i], found.z[i]);
  const float density = medium.density(place);
  if (density == 0.0f) return;
  const Ray flight{place - found.s[i] * direction, direction};
  const DensityIntegral integral = density_integral(medium, flight, {0.0f, std::max(0.0f, found.s[i])});
  count(work_.counters.walk.lookups, integral.lookups + 1);
  const LightBeam& beam = c_.light.starts(along.medium)[found.beam[i]];
  const Rgb power(found.r[i], found.g[i], found.b[i]);
  const Rgb left = analog_weight(medium, channel_shares(power), integral.value, false);
  const Leg to_light = leg_to(beam.start, place, beam.before * transmittance(medium, integral.value));
  const Leg to_eye = leg_to(at_.from, place, along.to(found.t[i]));
  if (is_black(to_light.transmittance) || is_black(to_eye.transmittance)) return;
  const Junction there = junction_in(c_.counts, medium, density);
  const float phase = phase_density(medium, direction, -along.ray.direction);
  const MergeTerms merges =
      merges_in_medium(c_.counts, there, passing_over_colliding(there.sigma_t, to_light), to_eye, found.sine[i], true);
  const BehindMerge light = behind_merge(c_.counts, arrive(c_.counts, beam.start, to_light, there, place));
  const BehindMerge eye = behind_merge(c_.counts, arrive(c_.counts, at_.from, to_eye, there, place));
  const double all = all_at_merge(c_.counts, merges, light, phase, eye, phase);
  const Rgb value =
      at_.state.throughput * to_eye.transmittance * medium.sigma_s * power * left * (density * phase / found.sine[i]);
  add_merged(Technique::short_beams, value, kernel, merges.beams / all);
}

}  // namespace vpm
