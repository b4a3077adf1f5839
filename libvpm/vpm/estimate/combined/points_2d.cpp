// Photons in media around whole rays from the camera: leaf by leaf, in vector loops.
#include <array>
#include <numeric>

#include "vpm/base/count.h"
#include "vpm/base/exp_negative.h"
#include "vpm/estimate/combined/eye_sub_path.h"
#include "vpm/estimate/combined/shares_along_ray.h"
#include "vpm/photon/stored_power.h"

namespace vpm {
namespace {

// Sums have a number for each place in leaves: a vector loop has no order of its own to add in.
double sum_of(const Lanes& lanes) { return std::accumulate(lanes.begin(), lanes.end(), 0.0); }
using LanesRgb = std::array<Lanes, 3>;
Rgb sum_of(const LanesRgb& lanes) { return Rgb(Rgbd(sum_of(lanes[0]), sum_of(lanes[1]), sum_of(lanes[2]))); }

/// What photons add up to: of the kernel and of its correction, with shares, and of the kernel without them.
struct MergedAlong {
  LanesRgb value{}, correction{}, unweighted{};
  Lanes number{};
};

/// The medium at the places of a leaf's photons. Those that are not near have density 0.
struct Places {
  Lanes distance;  // from the start of the ray, m
  Lanes integral;  // of density up to there, m
  Lanes density;
};
Places places_beside(const Medium& medium, const DensityIntegralsAlong& integrals,
                     const VertexMap<MediumPhotonLeaf>::BesideRay& beside, float radius2) {
  Places places;
  for (size_t i = 0; i < kBlock; ++i) {
    const bool near = beside.distances2[i] < radius2;
    places.density[i] = near ? 1.0f : 0.0f;
    places.integral[i] = places.distance[i] = near ? beside.places[i] : 0.0f;
  }
  if (medium.homogeneous()) return places;
  for (size_t i = 0; i < kBlock; ++i) {
    if (places.density[i] == 0.0f) continue;
    const DensityIntegralsAlong::Place at = integrals.at(beside.places[i]);
    places.density[i] = static_cast<float>(at.density);
    places.integral[i] = static_cast<float>(at.integral);
  }
  return places;
}

/// What does not change along a ray.
template <class Shares>
struct RayMerges {
  const Medium& medium;
  Shares shares;
  Vec3 travel;        // of the ray, unit
  Rgb passed;         // up to its start
  float before;       // from the departure to there, m
  float radius;       // m
  float floor;        // of relative densities, below which photons are kept along flights
  float per_sigma_t;  // 1 over the sum over channels of extinction at density 1, m
  float per_largest;  // 1 over the largest density
};

void add_products(const Lanes& a, const Lanes& b, Lanes& sum) {
  for (size_t i = 0; i < kBlock; ++i) sum[i] += a[i] * b[i];
}

template <class Shares, class PhaseFunction, class Profile>
void merge_leaf(const RayMerges<Shares>& ray, const PhaseFunction& phase, Profile profile, const MediumPhotonLeaf& leaf,
                const VertexMap<MediumPhotonLeaf>::BesideRay& beside, const Places& places, MergedAlong& merged) {
  const float inverse2 = 1.0f / (ray.radius * ray.radius);
  const Rgb sigma_t = ray.medium.sigma_t;
  const Shares shares = ray.shares;
  const Lanes flights = shares.of_flights(leaf);
  LanesRgb light;
  Lanes kernel, shared, corrected, number;  // rows that nothing else may lie over: vector loops ask for that
  for (size_t i = 0; i < kBlock; ++i) {
    const float relative = places.density[i] * ray.per_largest;
    const Rgb passed(ray.passed.r * exp_negative(-sigma_t.r * places.integral[i]),
                     ray.passed.g * exp_negative(-sigma_t.g * places.integral[i]),
                     ray.passed.b * exp_negative(-sigma_t.b * places.integral[i]));
    const float colliding = (sigma_t.r * passed.r + sigma_t.g * passed.g + sigma_t.b * passed.b) * ray.per_sigma_t;
    const bool counts = (relative > 0.0f) & (colliding > 0.0f);
    const float scattered = phase.value(leaf.travel(i), -ray.travel);
    const typename Shares::Place at{ray.before + places.distance[i], counts ? places.density[i] : 1.0f,
                                    std::max(1.0f, ray.floor / (counts ? relative : 1.0f)), colliding};
    const float share = !counts ? 0.0f : shares.of(leaf.adjacent[i], leaf.further[i], flights[i], scattered, at);
    const KernelPair<float> spread = profile(counts ? beside.distances2[i] * inverse2 : 1.0f);
    const float found = counts ? relative * scattered : 0.0f;
    light[0][i] = passed.r * leaf.power_r[i] * found;
    light[1][i] = passed.g * leaf.power_g[i] * found;
    light[2][i] = passed.b * leaf.power_b[i] * found;
    kernel[i] = spread.value;
    shared[i] = spread.value * share;
    corrected[i] = spread.correction * share;
    number[i] = counts ? 1.0f : 0.0f;
  }
  for (size_t c = 0; c < 3; ++c) {
    add_products(light[c], kernel, merged.unweighted[c]);
    add_products(light[c], shared, merged.value[c]);
    add_products(light[c], corrected, merged.correction[c]);
  }
  for (size_t i = 0; i < kBlock; ++i) merged.number[i] += number[i];
}

}  // namespace

void EyeSubPath::merge_points_2d(const Along& along, const Interval& interval) {
  const VertexMap<MediumPhotonLeaf>& map = c_.light.in_medium(along.medium);
  if (c_.counts.points_2d == 0.0 || map.size() == 0) return;
  const Medium& medium = c_.scene.media[along.medium];
  const KernelKind kernel = c_.kernels.volume_kernel;
  const float radius = c_.kernels.points_2d, sigma_t = mean_channel(medium.sigma_t);
  MergedAlong merged;
  const auto merge_all = [&](auto shares, const auto& phase, auto profile) {
    const RayMerges<decltype(shares)> ray{medium,
                                          shares,
                                          along.ray.direction,
                                          along.passed,
                                          glm::distance(at_.from.point, along.ray.origin),
                                          radius,
                                          medium.grid ? floor_in(medium, c_.counts.density_floor) : 0.0f,
                                          1.0f / (3.0f * sigma_t),
                                          relative_density(medium, 1.0f)};
    return map.visit_leaves_near_ray(along.ray, interval, radius, [&](const auto& leaf, const auto& beside) {
      const Places places = places_beside(medium, work_.scratch.integrals, beside, radius * radius);
      merge_leaf(ray, phase, profile, leaf, beside, places, merged);
    });
  };
  const auto merge = [&](const auto& phase, auto profile) {
    return c_.counts.heuristic == Heuristic::power
               ? merge_all(SharesAlongRay<true>(c_.counts, at_.from, sigma_t), phase, profile)
               : merge_all(SharesAlongRay<false>(c_.counts, at_.from, sigma_t), phase, profile);
  };
  count(work_.counters.volume_queries);
  count(work_.counters.gather.searches);
  const uint32_t visited = std::visit(
      [&](const auto& phase) { return with_kernel<2>(kernel, [&](auto profile) { return merge(phase, profile); }); },
      medium.phase);
  count(work_.counters.gather.visited, visited);
  count(work_.counters.gather.used, sum_of(merged.number));
  const Rgb each = asked() * medium.albedo() * (kernel_norm<2>(kernel, radius) / static_cast<float>(c_.light_paths));
  const KernelEstimate all{sum_of(merged.value) * each, sum_of(merged.correction) * each};
  radiance_ += all;
  if (parts_) parts_->add_both(Technique::points_2d, all.value, sum_of(merged.unweighted) * each);
}

}  // namespace vpm
