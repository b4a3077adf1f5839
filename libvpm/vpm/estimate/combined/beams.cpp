// Flights of photons that cross whole rays from the camera: short beams, as far as their photons come, and long ones,
// as far as they could have come. kBlock crossings at a time, in lanes.
#include <algorithm>

#include "vpm/base/count.h"
#include "vpm/base/exp_negative.h"
#include "vpm/estimate/combined/eye_sub_path.h"
#include "vpm/estimate/combined/shares_of_beams.h"
#include "vpm/medium/distance/mixture.h"
#include "vpm/photon/stored_power.h"

namespace vpm {
namespace {

using LanesRgb = std::array<Lanes, 3>;
using FloatsRgb = std::array<Floats, 3>;

Floats floats_of(const Lanes& lanes) { return std::bit_cast<Floats>(lanes); }
FloatsRgb floats_of(const LanesRgb& lanes) { return {floats_of(lanes[0]), floats_of(lanes[1]), floats_of(lanes[2])}; }
Floats3 floats3_of(const LanesRgb& lanes) { return {floats_of(lanes[0]), floats_of(lanes[1]), floats_of(lanes[2])}; }
Floats mean_of(const FloatsRgb& rgb) { return (rgb[0] + rgb[1] + rgb[2]) * (1.0f / 3.0f); }

template <class V>
void set(LanesRgb& lanes, size_t i, const V& value) {
  for (int c = 0; c < 3; ++c) lanes[c][i] = value[c];
}

/// Crossings, with what they have of their beams and flights. Lanes without a crossing have no power.
struct Crossings {
  LanesRgb travel{}, power{}, before{}, back{}, turn{};
  Lanes adjacent{};  // FlightTerms::adjacent times the squared distance from the last vertex
  Lanes sine{}, distance2{};
  Lanes along_ray{};                        // m from the ray's origin
  Lanes seen_integral{}, flown_integral{};  // of density up to the crossing, along the ray and along the beam, m
  Lanes density{};                          // of the medium, > 0
  uint32_t number = 0;                      // that scatter

  Crossings() {
    sine.fill(1.0f);
    density.fill(1.0f);
  }
};

/// Beams of one kind, and a ray that they cross.
struct CrossedRay {
  const Medium& medium;
  const LightBeams& beams;
  const DensityIntegralsAlong& integrals;
  Ray ray;
  WalkCounters& counters;
};

/// The medium there. False where there is nothing to scatter.
bool set_medium(const CrossedRay& crossed, const Ray& beam, const Vec3& place, float s, size_t i, Crossings& at) {
  const Medium& medium = crossed.medium;
  if (medium.homogeneous()) {
    at.seen_integral[i] = at.along_ray[i];
    at.flown_integral[i] = s;
    return true;
  }
  const float density = medium.density(place);
  count(crossed.counters.lookups);
  if (density == 0.0f) return false;
  const DensityIntegral flown = density_integral(medium, beam, {0.0f, s});
  count(crossed.counters.lookups, flown.lookups);
  at.density[i] = density;
  at.seen_integral[i] = static_cast<float>(crossed.integrals.at(at.along_ray[i]).integral);
  at.flown_integral[i] = static_cast<float>(flown.value);
  return true;
}

/// Up to kBlock crossings of those found, from number `first` on.
Crossings crossings_of(const CrossedRay& crossed, const BeamCrossings& found, size_t first) {
  Crossings at;
  const size_t size = std::min<size_t>(kBlock, found.size - first);
  for (size_t i = 0; i < size; ++i) {
    const size_t n = first + i;
    const FlightTerms& flight = crossed.beams.flights[found.beam[n]];
    const Vec3 travel(found.dx[n], found.dy[n], found.dz[n]);
    const Vec3 place = crossed.ray.origin + Vec3(found.x[n], found.y[n], found.z[n]);
    const float s = std::max(0.0f, found.s[n]), from_vertex = flight.offset + s;
    at.along_ray[i] = found.t[n];
    if (!set_medium(crossed, {place - s * travel, travel}, place, s, i, at)) continue;
    ++at.number;
    set(at.travel, i, travel);
    set(at.power, i, Rgb(found.r[n], found.g[n], found.b[n]));
    set(at.before, i, flight.before);
    set(at.back, i, flight.back);
    set(at.turn, i, flight.turn);
    at.adjacent[i] =
        adjacent_at(flight, place, travel, from_vertex) * (flight.parallel ? 1.0f : from_vertex * from_vertex);
    at.sine[i] = found.sine[n];
    at.distance2[i] = found.distance2[n];
  }
  return at;
}

/// exp(-sigma_t integral), channel by channel, times `before`.
FloatsRgb attenuated(const FloatsRgb& before, const Rgb& sigma_t, const Floats& integral) {
  FloatsRgb passed;
  for (int c = 0; c < 3; ++c) passed[c] = before[c] * exp_negative(-sigma_t[c] * integral);
  return passed;
}

/// What is left of short beams' powers, as analog_weight() has it.
FloatsRgb left_of_short(const FloatsRgb& power, const Rgb& sigma_t, const Floats& integral) {
  const float least = std::min(sigma_t.r, std::min(sigma_t.g, sigma_t.b));
  FloatsRgb left;
  Floats sum{}, weighted{};
  for (int c = 0; c < 3; ++c) {
    const Floats magnitude = max(power[c], Floats{} - power[c]);
    left[c] = exp_negative((least - sigma_t[c]) * integral);
    sum += magnitude;
    weighted += magnitude * left[c];
  }
  const Floats factor = weighted > 0.0f ? sum / weighted : Floats{};
  for (Floats& channel : left) channel *= factor;
  return left;
}

/// What beams add up to: of the kernel and of its correction, with shares, and of the kernel without them.
struct MergedBeams {
  FloatsRgb value{}, correction{}, unweighted{};
  uint32_t number = 0;
};
Rgb sum_of(const FloatsRgb& lanes) {
  Rgbd sum(0.0);
  for (int c = 0; c < 3; ++c)
    for (size_t i = 0; i < kBlock; ++i) sum[c] += lanes[c][i];
  return Rgb(sum);
}

/// What does not change along a ray.
template <class Shares>
struct RayAcrossBeams {
  Shares shares;
  Rgb sigma_t;         // of the medium at density 1, 1/m
  Vec3 travel;         // of the ray, unit
  Rgb passed;          // up to its start
  float before;        // from the departure to there, m
  float radius;        // m
  float floor;         // of relative densities, below which photons are kept along flights
  float per_largest;   // 1 over the largest density
  bool is_long, grey;  // beams; is the medium?
};

template <class Shares, class PhaseFunction, class Profile>
void merge_block(const RayAcrossBeams<Shares>& ray, const PhaseFunction& phase, Profile profile, const Crossings& at,
                 MergedBeams& merged) {
  const Floats density = floats_of(at.density), sine = floats_of(at.sine), flown = floats_of(at.flown_integral);
  const FloatsRgb power = floats_of(at.power), before = floats_of(at.before), back = floats_of(at.back);
  const FloatsRgb none{all_lanes(1.0f), all_lanes(1.0f), all_lanes(1.0f)};
  const FloatsRgb on_beam = attenuated(none, ray.sigma_t, flown);
  const FloatsRgb on_ray = attenuated({all_lanes(ray.passed.r), all_lanes(ray.passed.g), all_lanes(ray.passed.b)},
                                      ray.sigma_t, floats_of(at.seen_integral));
  Lanes scattered, values, corrections;
  for (size_t i = 0; i < kBlock; ++i) {
    const Vec3 travel(at.travel[0][i], at.travel[1][i], at.travel[2][i]);
    scattered[i] = phase.value(travel, -ray.travel);
    const KernelPair<float> spread = profile(std::min(at.distance2[i] / (ray.radius * ray.radius), 1.0f));
    values[i] = spread.value;
    corrections[i] = spread.correction;
  }
  CrossedBeams crossed;
  crossed.sine = sine;
  const Floats determinant = dot(ray.travel, floats3_of(at.turn));
  crossed.determinant = max(determinant, Floats{} - determinant);
  FloatsRgb flown_through, coming_back, colliding, seen;
  for (int c = 0; c < 3; ++c) {
    flown_through[c] = before[c] * on_beam[c];
    coming_back[c] = 3.0f * back[c] * flown_through[c] * floats_of(scattered);
    colliding[c] = ray.sigma_t[c] * density * flown_through[c];
    seen[c] = ray.sigma_t[c] * density * on_ray[c];
  }
  crossed.passed = mean_of(flown_through);
  crossed.colliding = mean_of(colliding);
  crossed.seen = mean_of(seen);
  crossed.back = mean_of(coming_back);
  crossed.kept = max(all_lanes(1.0f), ray.floor / (density * ray.per_largest));
  crossed.adjacent = floats_of(at.adjacent);
  crossed.distance = ray.before + floats_of(at.along_ray);
  const Floats share = ray.shares.of(crossed);
  const FloatsRgb left = ray.is_long ? on_beam : ray.grey ? none : left_of_short(power, ray.sigma_t, flown);
  const Floats found = density * floats_of(scattered) / sine;
  for (int c = 0; c < 3; ++c) {
    const Floats light = power[c] * left[c] * on_ray[c] * found;
    merged.unweighted[c] += light * floats_of(values);
    merged.value[c] += light * floats_of(values) * share;
    merged.correction[c] += light * floats_of(corrections) * share;
  }
}

}  // namespace

void EyeSubPath::merge_beams(Technique technique, const Along& along, const Interval& interval) {
  const LightBeams& beams = c_.light.beams(technique, along.medium);
  if (beams.map.size() == 0) return;
  const float radius = c_.kernels.beams;
  const KernelKind kernel = c_.kernels.volume_kernel;
  count(work_.counters.volume_queries);
  count(work_.counters.gather.searches);
  const Interval near = clip(along.ray, interval, beams.map.bounds(), radius);
  if (near.empty()) return;
  const Medium& medium = c_.scene.media[along.medium];
  const CrossedRay crossed{medium, beams, work_.scratch.integrals, along.ray, work_.counters.walk};
  MergedBeams merged;
  const auto merge_all = [&](auto shares, const auto& phase, auto profile) {
    const RayAcrossBeams<decltype(shares)> ray{shares,
                                               medium.sigma_t,
                                               along.ray.direction,
                                               along.passed,
                                               glm::distance(at_.from.point, along.ray.origin),
                                               radius,
                                               medium.grid ? floor_in(medium, c_.counts.density_floor) : 0.0f,
                                               relative_density(medium, 1.0f),
                                               technique == Technique::long_beams,
                                               is_grey(medium.sigma_t)};
    return beams.map.visit_crossings(along.ray, near, [&](const BeamCrossings& found) {
      for (size_t first = 0; first < found.size; first += kBlock) {
        const Crossings at = crossings_of(crossed, found, first);
        merge_block(ray, phase, profile, at, merged);
        merged.number += at.number;
      }
    });
  };
  const auto merge = [&](const auto& phase, auto profile) {
    return c_.counts.heuristic == Heuristic::power
               ? merge_all(SharesOfBeams<true>(c_.counts, at_.from, technique), phase, profile)
               : merge_all(SharesOfBeams<false>(c_.counts, at_.from, technique), phase, profile);
  };
  const uint32_t visited = std::visit(
      [&](const auto& phase) { return with_kernel<1>(kernel, [&](auto profile) { return merge(phase, profile); }); },
      medium.phase);
  count(work_.counters.gather.visited, visited);
  count(work_.counters.gather.used, merged.number);
  const Rgb each = asked() * medium.sigma_s * kernel_norm<1>(kernel, radius);
  const KernelEstimate all{sum_of(merged.value) * each, sum_of(merged.correction) * each};
  radiance_ += all;
  if (parts_) parts_->add_both(technique, all.value, sum_of(merged.unweighted) * each);
}

}  // namespace vpm
