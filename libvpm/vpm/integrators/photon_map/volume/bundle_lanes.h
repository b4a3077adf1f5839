// Photon beams and photons across many rays at once.
#pragma once

#include <algorithm>
#include <limits>

#include "vpm/integrators/photon_map/volume/beam_balance.h"
#include "vpm/integrators/photon_map/volume/bundle_gather.h"
#include "vpm/medium/distance/mixture.h"
#include "vpm/photon/map/segment_map.h"

namespace vpm {

/// What is left of a beam's power at these distances from its origin, m, channel by channel, in a homogeneous medium:
/// multiply_by_left() of many rays.
inline FloatsRgb left_along(const Rgb& sigma_t, bool long_beams, const Rgb& power, const Floats& s) {
  const Rgb shares = channel_shares(power);
  const float least = long_beams ? 0.0f : std::min(sigma_t.r, std::min(sigma_t.g, sigma_t.b));
  FloatsRgb left;
  Floats mixture{};
  for (int c = 0; c < 3; ++c) {
    left[c] = exp_negative((least - sigma_t[c]) * max(s, 0.0f));
    mixture += shares[c] * left[c];
  }
  if (!long_beams)
    for (Floats& channel : left) channel /= max(mixture, std::numeric_limits<float>::min());
  return left;
}

/// What one piece of a beam adds to the lanes.
template <class P, class Profile>
struct BeamAcross {
  const SegmentLanes& segments;
  const P& phase;
  Profile profile;
  Extinction extinction;
  float radius;
  BeamBalance balance;
  bool long_beams;

  /// `from`: the direction before the collision that the beam begins at, and `sigma_s` there, 1/m, if it is shared with
  /// planes; 0: it is not.
  void add(const BundledBeams& beams, size_t p, const Vec3& from, float sigma_s, LaneEstimates& sums) const {
    const Vec3 direction(beams.dx[p], beams.dy[p], beams.dz[p]);
    const CrossingLanes crossing = cross(beams, p, segments.rays(), radius);
    const LaneMask met = crossing.met & segments.hold(crossing.places);
    if (!any(met)) return;
    const Floats3& along = segments.rays().along;
    const Floats sine = sqrt(crossing.sine2);
    Floats weight = phase.value(direction, segments.rays().towards_eye);
    if (sigma_s > 0.0f) {
      const Floats determinant = dot(glm::cross(from, direction), along);
      weight *= balance.of_beams_beside_planes_over_sine(sine, sigma_s, abs(determinant));
    } else {
      weight *= balance.of_beams_over_sine(sine, mean_channel(extinction.sigma_t));
    }
    weight = select(met, weight, 0.0f);
    sums.used -= met;
    const Rgb power(beams.r[p], beams.g[p], beams.b[p]);
    const Floats distances = segments.distances_to_eye(crossing.places);
    const KernelPair<Floats> kernel = profile(min(crossing.distance2 * (1.0f / (radius * radius)), 1.0f));
    if (long_beams || !extinction.grey())
      add_light(power, left_along(extinction.sigma_t, long_beams, power, crossing.s), extinction, distances, weight,
                kernel, sums);
    else
      add_light(power, extinction, distances, weight, kernel, sums);
  }
};

/// What one photon adds to the lanes. `balance`: beside beams, else nullptr.
template <class P, class Profile>
struct PhotonBeside {
  const SegmentLanes& segments;
  const P& phase;
  Profile profile;
  Extinction extinction;
  float radius;
  const BeamBalance* balance;

  [[gnu::always_inline]] void add(const BundledPhotons& photons, size_t p, LaneEstimates& sums) const {
    const Vec3 place(photons.x[p], photons.y[p], photons.z[p]), travel(photons.dx[p], photons.dy[p], photons.dz[p]);
    const float radius2 = radius * radius;
    const RayLanes& rays = segments.rays();
    const Floats3 offset = place - rays.from;
    const Floats t = dot(offset, rays.along);
    const Floats3 across = offset - t * rays.along;
    const Floats distance2 = dot(across, across);
    const LaneMask inside = (distance2 < radius2) & (t >= rays.t0) & (t < rays.t1) & segments.hold(offset);
    Floats weight = phase.value(travel, rays.towards_eye);
    if (balance) weight *= shares(travel);
    weight = select(inside, weight, 0.0f);
    sums.used -= inside;
    add_light({photons.r[p], photons.g[p], photons.b[p]}, extinction, segments.distances_to_eye(offset), weight,
              profile(min(distance2 * (1.0f / radius2), 1.0f)), sums);
  }

  Floats shares(const Vec3& travel) const {
    const Floats3 normal = cross(travel, segments.rays().along);
    return balance->of_collisions(sqrt(dot(normal, normal)), mean_channel(extinction.sigma_t));
  }
};

}  // namespace vpm
