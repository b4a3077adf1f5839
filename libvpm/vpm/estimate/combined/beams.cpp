// Flights of photons that cross whole rays from the camera: short beams, as far as their photons come, and long ones,
// as far as they could have come.
#include <algorithm>

#include "vpm/base/count.h"
#include "vpm/estimate/combined/eye_sub_path.h"
#include "vpm/estimate/eye_segment.h"
#include "vpm/medium/distance/mixture.h"

namespace vpm {

void EyeSubPath::merge_beams(Technique technique, const Along& along, const Interval& interval) {
  const LightBeams& beams = c_.light.beams(technique, along.medium);
  if (beams.map.size() == 0) return;
  const auto kernel = kernel_of<1>(c_.kernels.volume_kernel, c_.kernels.beams);
  count(work_.counters.volume_queries);
  count(work_.counters.gather.searches);
  const Interval near = clip(along.ray, interval, beams.map.bounds(), c_.kernels.beams);
  if (near.empty()) return;
  const uint32_t visited = beams.map.visit_crossings(along.ray, near, [&](const BeamCrossings& found) {
    for (size_t i = 0; i < found.size; ++i)
      merge_beam(technique, beams.starts[found.beam[i]], along, found, i, kernel(found.distance2[i]));
  });
  count(work_.counters.gather.visited, visited);
}

void EyeSubPath::merge_beam(Technique technique, const FlightStart& start, const Along& along,
                            const BeamCrossings& found, size_t i, const KernelPair<float>& kernel) {
  const Medium& medium = c_.scene.media[along.medium];
  const Vec3 direction(found.dx[i], found.dy[i], found.dz[i]);
  const Vec3 place = along.ray.origin + Vec3(found.x[i], found.y[i], found.z[i]);
  const float density = medium.density(place);
  if (density == 0.0f) return;
  const Ray flight{place - found.s[i] * direction, direction};
  const DensityIntegral integral = density_integral(medium, flight, {0.0f, std::max(0.0f, found.s[i])});
  count(work_.counters.walk.lookups, integral.lookups + 1);
  const Rgb passed = transmittance(medium, integral.value);
  const Leg to_light = leg_to(start.from, place, start.before * passed);
  const Leg to_eye = leg_to(at_.from, place, along.to(found.t[i]));
  if (is_black(to_light.transmittance) || is_black(to_eye.transmittance)) return;
  const bool is_long = technique == Technique::long_beams;
  const Rgb power(found.r[i], found.g[i], found.b[i]);
  const Rgb left = is_long ? passed : analog_weight(medium, channel_shares(power), integral.value, false);
  const Junction there = junction_in(c_.counts, medium, density);
  const float phase = phase_density(medium, direction, -along.ray.direction);
  const SubPathSums at_end = arrive(c_.counts, start.from, to_light, there, place);
  const MergeTerms merges = merges_in_medium(c_.counts, there, over_colliding(there.sigma_t, to_light), to_eye,
                                             angles_between(direction, at_end.turn, along.ray.direction), true);
  const BehindMerge light = behind_merge(c_.counts, at_end);
  const BehindMerge eye = behind_merge(c_.counts, arrive(c_.counts, at_.from, to_eye, there, place));
  const double all = all_at_merge(c_.counts, merges, light, phase, eye, phase);
  const Rgb value = asked() * to_eye.transmittance * medium.sigma_s * power * left * (density * phase / found.sine[i]);
  add_merged(technique, value, kernel, (is_long ? merges.long_beams : merges.short_beams) / all);
}

}  // namespace vpm
