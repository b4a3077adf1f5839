// Radiance along rays of one's own choice, by passes of photons.
#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "vpm/base/statistics/moments.h"
#include "vpm/integrators/settings.h"
#include "vpm/scene/scene.h"

namespace vpm {

/// Ways to look at photons along rays, with the names that checks have for them.
struct NamedGather {
  std::string_view type;
  const char* name;
};
inline constexpr NamedGather kAlongRays[] = {
    {"beam", "photons around rays"}, {"photon-beams", "photon beams"}, {"beams-points", "beams around points"}};

/// How photons are gathered, and how many of them there are.
struct PhotonRays {
  std::string_view type = "photon-beams";
  double radius = 0.1;        // m
  uint64_t photons = 10'000;  // of a pass
  int max_events = 100'000;   // of one photon
  int passes = 20;
  uint64_t seed = 1;
};

/// By kernels of that radius, h, and of half of it. `unbiased` is (4 narrow - wide) / 3: a bias of the order of h^2
/// goes. A sample is a pass.
struct RadianceByPhotons {
  Moments wide, narrow, unbiased;
};

/// What the rays of one pass find: see(ray) is the radiance along a ray, W/(m^2 sr). The random numbers are for rays.
using LookAlongRays = std::function<std::vector<double>(const std::function<double(const Ray&)>& see, Rng& rng)>;

/// The means over passes of each number that `look` returns. Radii do not shrink from pass to pass.
std::vector<RadianceByPhotons> estimate_along_rays(const Scene& scene, const PhotonRays& by, const LookAlongRays& look);

}  // namespace vpm
