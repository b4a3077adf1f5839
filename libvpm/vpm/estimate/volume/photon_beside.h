// Photons beside many rays at once.
#pragma once

#include "vpm/estimate/volume/beam_balance.h"
#include "vpm/estimate/volume/bundle_gather.h"
#include "vpm/photon/segment_map.h"

namespace vpm {

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
