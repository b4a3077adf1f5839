// Flights of photons that cross whole rays from the camera: short beams, as far as their photons come, and long ones,
// as far as they could have come. kBlock crossings at a time, in lanes: of many beams with one ray, or of one beam with
// many rays.
#include <algorithm>

#include "vpm/base/count.h"
#include "vpm/base/exp_negative.h"
#include "vpm/estimate/combined/beam_merges.h"
#include "vpm/estimate/combined/shares_of_beams.h"
#include "vpm/estimate/kernel_sum.h"
#include "vpm/photon/ray_lanes.h"
#include "vpm/photon/stored_power.h"

namespace vpm {
namespace {

/// Rays in lanes, as far as merges need them.
struct LitRays {
  FloatsRgb passed{};  // RaySegment's
  Floats before{};
  Floats splats{};  // RaySegment::adjacent over unit_of_beams()
  Floats3 along;    // directions, unit

  void set(const TechniqueCounts& counts, size_t lane, const RaySegment& segment) {
    for (int c = 0; c < 3; ++c) passed[c][lane] = segment.passed[c];
    before[lane] = segment.before;
    splats[lane] = static_cast<float>(std::min(segment.adjacent / unit_of_beams(counts), 1e30));
    along.set(lane, segment.ray.direction);
  }
};

/// Crossings of rays and beams, a lane for each. Lanes without one have no power.
struct Crossings {
  FloatsRgb power{}, before{}, back{};  // of the beam, and FlightTerms'
  Floats3 turn;
  Floats adjacent{};                         // FlightTerms::adjacent times the squared distance from the last vertex
  Floats scattered{};                        // the phase function towards the eye, 1/sr
  Floats sine = all_lanes(1.0f);             // of the angle between the two
  Floats q{};                                // their squared distance over that of the radius
  Floats along_ray{};                        // m from the ray's origin
  Floats seen_integral{}, flown_integral{};  // of density up to the crossing, along the ray and along the beam, m
  Floats density = all_lanes(1.0f);          // of the medium, > 0
};

/// What crossings add up to, without the kernel's norm: with shares, and without.
struct CrossingSums {
  FloatsRgb value{}, correction{}, unweighted{};
};

/// exp(-sigma_t integral), channel by channel, times `before`.
FloatsRgb attenuated(const FloatsRgb& before, const Rgb& sigma_t, const Floats& integral) {
  FloatsRgb passed;
  Floats left{};
  for (int c = 0; c < 3; ++c) {
    if (c == 0 || sigma_t[c] != sigma_t[c - 1]) left = exp_negative(-sigma_t[c] * integral);  // most media are grey
    passed[c] = before[c] * left;
  }
  return passed;
}

/// What is left of short beams' powers, as analog_weight() has it.
FloatsRgb left_of_short(const FloatsRgb& power, const Rgb& sigma_t, const Floats& integral) {
  const float least = std::min(sigma_t.r, std::min(sigma_t.g, sigma_t.b));
  FloatsRgb left;
  Floats sum{}, weighted{};
  for (int c = 0; c < 3; ++c) {
    left[c] = exp_negative((least - sigma_t[c]) * integral);
    sum += abs(power[c]);
    weighted += abs(power[c]) * left[c];
  }
  const Floats factor = weighted > 0.0f ? sum / weighted : Floats{};
  for (Floats& channel : left) channel *= factor;
  return left;
}

/// What beams of one kind bring to rays in one medium.
template <bool kSquares, class PhaseFunction, class Profile>
class BeamLight {
 public:
  BeamLight(const CombinedContext& context, Technique technique, const Medium& medium, const PhaseFunction& phase,
            Profile profile)
      : shares_(context.counts, technique),
        phase_(phase),
        profile_(profile),
        sigma_t_(medium.sigma_t),
        floor_(medium.grid ? floor_in(medium, context.counts.density_floor) : 0.0f),
        per_largest_(relative_density(medium, 1.0f)),
        is_long_(technique == Technique::long_beams),
        grey_(is_grey(medium.sigma_t)) {}

  const PhaseFunction& phase() const { return phase_; }

  void add(const LitRays& rays, const Crossings& at, CrossingSums& sums) const {
    const FloatsRgb whole = all_lanes(Rgb(1.0f));
    const FloatsRgb on_beam = attenuated(whole, sigma_t_, at.flown_integral);
    const FloatsRgb on_ray = attenuated(rays.passed, sigma_t_, at.seen_integral);
    const Floats share = shares_.of(crossed(rays, at, on_beam, on_ray));
    const FloatsRgb left = is_long_ ? on_beam : grey_ ? whole : left_of_short(at.power, sigma_t_, at.flown_integral);
    const Floats found = at.density * at.scattered / at.sine;
    Floats value, correction;
    for (size_t i = 0; i < kBlock; ++i) {
      const KernelPair<float> spread = profile_(at.q[i]);
      value[i] = spread.value;
      correction[i] = spread.correction;
    }
    for (int c = 0; c < 3; ++c) {
      const Floats light = at.power[c] * left[c] * on_ray[c] * found;
      sums.unweighted[c] += light * value;
      sums.value[c] += light * value * share;
      sums.correction[c] += light * correction * share;
    }
  }

 private:
  CrossedBeams crossed(const LitRays& rays, const Crossings& at, const FloatsRgb& on_beam,
                       const FloatsRgb& on_ray) const {
    FloatsRgb flown, back, colliding, seen;
    for (int c = 0; c < 3; ++c) {
      flown[c] = at.before[c] * on_beam[c];
      back[c] = 3.0f * at.back[c] * flown[c] * at.scattered;
      colliding[c] = sigma_t_[c] * at.density * flown[c];
      seen[c] = sigma_t_[c] * at.density * on_ray[c];
    }
    const Floats to_eye = rays.before + at.along_ray;
    return {.sine = at.sine,
            .determinant = abs(dot(at.turn, rays.along)),
            .passed = mean_channel(flown),
            .colliding = mean_channel(colliding),
            .seen = mean_channel(seen),
            .kept = max(all_lanes(1.0f), floor_ / (at.density * per_largest_)),
            .back = mean_channel(back),
            .adjacent = at.adjacent,
            .splats = rays.splats * to_eye * to_eye};
  }

  SharesOfBeams<kSquares> shares_;
  const PhaseFunction& phase_;
  Profile profile_;
  Rgb sigma_t_;        // of the medium at density 1, 1/m
  float floor_;        // of relative densities, below which photons are kept along flights
  float per_largest_;  // 1 over the largest density
  bool is_long_, grey_;
};

/// Calls use(BeamLight) for the medium's phase function, and the kernel and heuristic of the pass.
template <class Use>
auto with_beam_light(const CombinedContext& context, Technique technique, const Medium& medium, Use&& use) {
  const auto with = [&](const auto& phase, auto profile) {
    using P = std::decay_t<decltype(phase)>;
    using K = decltype(profile);
    if (context.counts.heuristic == Heuristic::power)
      return use(BeamLight<true, P, K>(context, technique, medium, phase, profile));
    return use(BeamLight<false, P, K>(context, technique, medium, phase, profile));
  };
  return std::visit(
      [&](const auto& phase) {
        return with_kernel<1>(context.kernels.volume_kernel, [&](auto profile) { return with(phase, profile); });
      },
      medium.phase);
}

/// What all sums along a segment are times.
Rgb factor_of(const CombinedContext& context, const RaySegment& segment) {
  return segment.throughput * context.scene.media[segment.medium].sigma_s *
         kernel_norm<1>(context.kernels.volume_kernel, context.kernels.beams);
}

// --- Many beams and one ray

/// Beams of one kind, and a ray that they cross.
struct CrossedRay {
  const Medium& medium;
  const LightBeams& beams;
  const DensityIntegralsAlong& integrals;
  Ray ray;
  float radius;  // m
  WalkCounters& counters;
};

/// The medium there. False where there is nothing to scatter.
bool set_medium(const CrossedRay& crossed, const Ray& beam, const Vec3& place, float s, float t, size_t lane,
                Crossings& at) {
  const Medium& medium = crossed.medium;
  at.along_ray[lane] = t;
  if (medium.homogeneous()) {
    at.seen_integral[lane] = t;
    at.flown_integral[lane] = s;
    return true;
  }
  const float density = medium.density(place);
  count(crossed.counters.lookups);
  if (density == 0.0f) return false;
  const DensityIntegral flown = density_integral(medium, beam, {0.0f, s});
  count(crossed.counters.lookups, flown.lookups);
  at.density[lane] = density;
  at.seen_integral[lane] = static_cast<float>(crossed.integrals.at(t).integral);
  at.flown_integral[lane] = static_cast<float>(flown.value);
  return true;
}

void set_flight(const FlightTerms& flight, const Rgb& power, size_t lane, Crossings& at) {
  for (int c = 0; c < 3; ++c) {
    at.power[c][lane] = power[c];
    at.before[c][lane] = flight.before[c];
    at.back[c][lane] = flight.back[c];
  }
  at.turn.set(lane, flight.turn);
}

/// Up to kBlock crossings of those found, from number `first` on. Returns how many scatter.
template <class PhaseFunction>
uint32_t set_crossings(const CrossedRay& crossed, const PhaseFunction& phase, const BeamCrossings& found, size_t first,
                       Crossings& at) {
  uint32_t number = 0;
  for (size_t lane = 0; lane < std::min<size_t>(kBlock, found.size - first); ++lane) {
    const size_t n = first + lane;
    const FlightTerms& flight = crossed.beams.flights[found.beam[n]];
    const Vec3 travel(found.dx[n], found.dy[n], found.dz[n]);
    const Vec3 place = crossed.ray.origin + Vec3(found.x[n], found.y[n], found.z[n]);
    const float s = std::max(0.0f, found.s[n]), flown = flight.offset + s;
    if (!set_medium(crossed, {place - s * travel, travel}, place, s, found.t[n], lane, at)) continue;
    ++number;
    set_flight(flight, Rgb(found.r[n], found.g[n], found.b[n]), lane, at);
    at.adjacent[lane] = adjacent_at(flight, place, travel, flown) * (flight.parallel ? 1.0f : flown * flown);
    at.scattered[lane] = phase.value(travel, -crossed.ray.direction);
    at.sine[lane] = found.sine[n];
    at.q[lane] = std::min(found.distance2[n] / (crossed.radius * crossed.radius), 1.0f);
  }
  return number;
}

Rgb sum_of(const FloatsRgb& lanes) {
  Rgbd sum(0.0);
  for (int c = 0; c < 3; ++c)
    for (size_t i = 0; i < kBlock; ++i) sum[c] += lanes[c][i];
  return Rgb(sum);
}

// --- One beam and many rays

/// The part of a segment that beams may cross, m from its ray's origin.
Interval near_beams(const LightBeams& beams, const RaySegment& segment, float radius) {
  return clip(segment.ray, segment.interval, beams.map.bounds(), radius);
}

using Directions = std::array<Vec3, kEyeRays>;
std::span<const Vec3> directions_of(std::span<const RaySegment> bundle, Directions& directions) {
  for (size_t i = 0; i < bundle.size(); ++i) directions[i] = bundle[i].ray.direction;
  return {directions.data(), bundle.size()};
}

/// The same of all segments of a bundle, m from its apex; empty where beams cross none.
Interval reach_of(const LightBeams& beams, std::span<const RaySegment> bundle, const Vec3& apex, float radius) {
  Interval reach{kInfinity, 0.0f};
  for (const RaySegment& segment : bundle) {
    const Interval near = near_beams(beams, segment, radius);
    if (near.empty()) continue;
    const float before = glm::distance(apex, segment.ray.origin);
    reach = {std::min(reach.t0, before + near.t0), std::max(reach.t1, before + near.t1)};
  }
  return reach;
}

/// The sums of rays, in doubles.
struct RayTotals {
  std::array<Rgbd, kBlock> value{}, correction{}, unweighted{};

  void add(const CrossingSums& sums) {
    for (size_t lane = 0; lane < kBlock; ++lane)
      for (int c = 0; c < 3; ++c) {
        value[lane][c] += sums.value[c][lane];
        correction[lane][c] += sums.correction[c][lane];
        unweighted[lane][c] += sums.unweighted[c][lane];
      }
  }
};

/// Up to kBlock rays of a bundle.
struct RaysAcrossBeams {
  const LightBeams& beams;
  RayLanes lanes;
  LitRays lit;
  Vec3 apex;
  float radius;  // m
};

/// The crossings of piece number `p` with the rays. Returns how many there are.
template <class PhaseFunction>
uint32_t set_crossings(const RaysAcrossBeams& rays, const PhaseFunction& phase, const BundledBeams& found, size_t p,
                       Crossings& at) {
  const CrossingLanes crossing = cross(found, p, rays.lanes, rays.radius);
  if (!any(crossing.met)) return 0;
  const FlightTerms& flight = rays.beams.flights[found.beam[p]];
  const Vec3 travel(found.dx[p], found.dy[p], found.dz[p]);
  uint32_t number = 0;
  for (size_t lane = 0; lane < kBlock; ++lane) number += crossing.met[lane] ? 1 : 0;
  const auto where_met = [&](const Floats& x, float otherwise) { return crossing.met ? x : all_lanes(otherwise); };
  const Floats s = where_met(max(crossing.s, Floats{}), 0.0f), flown = flight.offset + s;
  const Rgb power(found.r[p], found.g[p], found.b[p]);
  for (int c = 0; c < 3; ++c) at.power[c] = where_met(all_lanes(power[c]), 0.0f);
  at.before = all_lanes(flight.before);
  at.back = all_lanes(flight.back);
  at.turn = {all_lanes(flight.turn.x), all_lanes(flight.turn.y), all_lanes(flight.turn.z)};
  at.adjacent = all_lanes(flight.adjacent);
  if (flight.round)
    for (size_t lane = 0; lane < kBlock; ++lane)
      if (crossing.met[lane])
        at.adjacent[lane] =
            adjacent_at(flight, rays.apex + rays.lanes.from[lane] + crossing.places[lane], travel, flown[lane]);
  if (!flight.parallel) at.adjacent *= flown * flown;
  for (size_t lane = 0; lane < kBlock; ++lane) at.scattered[lane] = phase.value(travel, -rays.lit.along[lane]);
  at.sine = where_met(sqrt(crossing.sine2), 1.0f);
  at.q = where_met(min(crossing.distance2 * (1.0f / (rays.radius * rays.radius)), all_lanes(1.0f)), 1.0f);
  at.along_ray = at.seen_integral = where_met(dot(crossing.places, rays.lit.along), 0.0f);
  at.flown_integral = s;
  return number;
}

}  // namespace

Merged merge_beams(const CombinedContext& context, Technique technique, const RaySegment& segment, EyeWork& work) {
  const LightBeams& beams = context.light.beams(technique, segment.medium);
  if (beams.map.size() == 0) return {};
  const float radius = context.kernels.beams;
  count(work.counters.volume_queries);
  count(work.counters.gather.searches);
  const Interval near = near_beams(beams, segment, radius);
  if (near.empty()) return {};
  const Medium& medium = context.scene.media[segment.medium];
  const CrossedRay crossed{medium, beams, work.scratch.integrals, segment.ray, radius, work.counters.walk};
  LitRays lit;
  for (size_t lane = 0; lane < kBlock; ++lane) lit.set(context.counts, lane, segment);
  CrossingSums sums;
  const auto merge = [&](const auto& light) {
    return beams.map.visit_crossings(segment.ray, near, [&](const BeamCrossings& found) {
      for (size_t first = 0; first < found.size; first += kBlock) {
        Crossings at;
        count(work.counters.gather.used, set_crossings(crossed, light.phase(), found, first, at));
        light.add(lit, at, sums);
      }
    });
  };
  count(work.counters.gather.visited, with_beam_light(context, technique, medium, merge));
  const Rgb factor = factor_of(context, segment);
  return {{sum_of(sums.value) * factor, sum_of(sums.correction) * factor}, sum_of(sums.unweighted) * factor};
}

void merge_beams(const CombinedContext& context, Technique technique, const Vec3& apex,
                 std::span<const RaySegment> bundle, EyeWork& work, std::span<Merged> merged) {
  constexpr float kMostRadii = 32.0f;  // of bundles: wide ones look at beams that few of their rays cross
  const LightBeams& beams = context.light.beams(technique, bundle.front().medium);
  if (beams.map.size() == 0) return;
  const Medium& medium = context.scene.media[bundle.front().medium];
  const float radius = context.kernels.beams;
  Directions directions;
  const std::span<const Vec3> all = directions_of(bundle, directions);
  const Interval reach = reach_of(beams, bundle, apex, radius);
  if (reach.empty()) return;
  if (!is_narrow(all, reach, 1.0f / mean_channel(medium.sigma_t), kMostRadii * radius)) {
    for (size_t i = 0; i < bundle.size(); ++i) merged[i] = merge_beams(context, technique, bundle[i], work);
    return;
  }
  GatherCounters& counters = work.counters.gather;
  count(work.counters.volume_queries, bundle.size());
  count(counters.searches, bundle.size());
  count(counters.visited, beams.map.select(RayBundle(apex, all, reach.t1 + radius), work.scratch.beams));
  for (size_t first = 0; first < bundle.size(); first += kBlock) {
    const std::span<const RaySegment> block = bundle.subspan(first, std::min<size_t>(kBlock, bundle.size() - first));
    RaysAcrossBeams rays{beams, {}, {}, apex, radius};
    for (size_t i = 0; i < block.size(); ++i) {
      rays.lanes.set(i, block[i].ray, near_beams(beams, block[i], radius), apex);
      rays.lit.set(context.counts, i, block[i]);
    }
    const Interval near = reach_of(beams, block, apex, radius);
    if (near.empty()) continue;
    RayTotals totals;
    const auto merge = [&](const auto& light) {
      const auto visit = [&](const BundledBeams& found) {
        CrossingSums sums;
        for (size_t p = 0; p < found.size; ++p) {
          Crossings at;
          const uint32_t number = set_crossings(rays, light.phase(), found, p, at);
          if (number == 0) continue;
          count(counters.used, number);
          light.add(rays.lit, at, sums);
        }
        totals.add(sums);
        count(counters.visited, found.size * block.size());
      };
      const RayBundle narrower(apex, directions_of(block, directions), near.t1 + radius);
      return work.scratch.beams.visit_near_bundle(narrower, visit);
    };
    count(counters.visited, with_beam_light(context, technique, medium, merge));
    for (size_t i = 0; i < block.size(); ++i) {
      const Rgb factor = factor_of(context, block[i]);
      merged[first + i] = {{Rgb(totals.value[i]) * factor, Rgb(totals.correction[i]) * factor},
                           Rgb(totals.unweighted[i]) * factor};
    }
  }
}

}  // namespace vpm
