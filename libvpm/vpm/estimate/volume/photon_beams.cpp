// L = sum over beams of Phi W(s) sigma_s p T(t) K(distance) / sine of the angle [Jarosz2011].
#include "vpm/estimate/volume/photon_beams.h"

#include <utility>
#include <variant>

#include "vpm/estimate/volume/pass_to_eye.h"
#include "vpm/medium/distance/mixture.h"
#include "vpm/photon/stored_power.h"

namespace vpm {
namespace {

/// What is left of a beam's power at the distance s (m) from its origin, given that the photon has come so far, in a
/// chromatic medium. In a grey one it is all.
Rgb weight_along(const Medium& medium, const Ray& beam, const Rgb& power, float s) {
  const double integral = density_integral(medium, beam, {0.0f, s}).value;
  return analog_weight(medium, channel_shares(power), integral, false);
}

}  // namespace

PhotonBeams::PhotonBeams(const Scene& scene, const PhotonBeamSettings& settings)
    : scene_(scene), settings_(settings), recorder_(scene, settings.once ? any_photon : indirect_photon) {}

void PhotonBeams::build(uint64_t emitted, RenderStatistics& statistics) {
  const auto scale = static_cast<float>(1.0 / static_cast<double>(emitted));
  Rng rng(settings_.seed, rng_stream(RngUse::flight, static_cast<uint64_t>(settings_.pass.number)), 0);
  thin_flights(recorder_.beams, settings_.flights, rng);
  for (size_t m = 0; m < scene_.media.size(); ++m) {
    const float first = first_radius(settings_.gather, scene_, scene_.media[m]);
    const GatherSettings gather = gather_in_pass(settings_.gather, first, 1, settings_.pass);
    const std::vector<PhotonBeam> beams = std::exchange(recorder_.beams[m], {});
    statistics.volume_photons += beams.size();
    statistics.last_volume_radius = std::max(statistics.last_volume_radius, gather.radius);
    by_medium_.push_back({gather, PhotonBeamMap(beams, gather.radius, scale)});
    statistics.photon_map_bytes += by_medium_.back().beams.memory_bytes();
  }
}

KernelEstimate PhotonBeams::along(const EyeSegment& segment, EyeWork& work) const {
  if (!segment.medium()) return {};
  const Map& map = by_medium_[segment.number];
  if (map.beams.size() == 0) return {};
  const SegmentRegion region(segment, map.settings, Spread::lines);
  const Interval near = clip(segment.ray, region.reach(), map.beams.bounds(), map.settings.radius);
  return near.empty() ? KernelEstimate() : gather(segment, region, near, work);
}

KernelEstimate PhotonBeams::gather(const EyeSegment& segment, const SegmentRegion& region, const Interval& near,
                                   EyeWork& work) const {
  const Medium& medium = *segment.medium();
  const Map& map = by_medium_[segment.number];
  const float radius = map.settings.radius, inverse = 1.0f / (radius * radius);
  const Mirrored mirrored = region.mirrored();
  const PlaneDistances distances = region.distances();
  const DensityIntegralsAlong* integrals = medium.homogeneous() ? nullptr : &segment.integrals(work);
  GatherCounters& counters = work.counters.gather;
  count(work.counters.volume_queries);
  count(counters.searches);
  const Vec3 towards_eye = -segment.ray.direction;
  const bool grey = is_grey(medium.sigma_t), at_photon = settings_.form == VolumeForm::density_at_photon;
  static_assert(BeamCrossings::kMost <= PhotonBatch::kMost);
  const auto sum = [&](const auto& phase, auto profile) {
    KernelPair<Rgbd> sum_of_beams;
    const auto visit = [&](const BeamCrossings& found) {
      float passes[PhotonBatch::kMost];
      for (size_t i = 0; i < found.size; ++i) passes[i] = distances.of({found.x[i], found.y[i], found.z[i]});
      Passed passed;
      pass_to_eye(medium, integrals, settings_.form, mirrored, {passes, found.size}, passed);
      for (size_t i = 0; i < found.size; ++i) {
        const Vec3 place(found.x[i], found.y[i], found.z[i]);  // from the ray's origin
        if (!region.within().hold(place)) continue;
        ++counters.used;
        const Vec3 direction(found.dx[i], found.dy[i], found.dz[i]);
        const Rgb power(found.r[i], found.g[i], found.b[i]);
        const KernelPair<float> spread = profile(found.distance2[i] * inverse) * (1.0f / found.sine[i]);
        Rgb light = phase.value(direction, towards_eye) * power * Rgb(passed.r[i], passed.g[i], passed.b[i]);
        const Vec3 crossing = segment.ray.origin + place;
        if (!grey) light *= weight_along(medium, {crossing - found.s[i] * direction, direction}, power, found.s[i]);
        if (at_photon) light *= medium.density(crossing);
        sum_of_beams += {Rgbd(light) * double{spread.value}, Rgbd(light) * double{spread.correction}};
      }
    };
    count(counters.visited, map.beams.visit_crossings(segment.ray, near, visit));
    return normed(sum_of_beams, kernel_norm_1d(map.settings.kernel, radius));
  };
  const Rgb scattering = at_photon ? medium.sigma_s : medium.sigma_s * medium.max_density();
  const KernelEstimate light =
      segment.throughput * scattering *
      std::visit(
          [&](const auto& phase) {
            return with_kernel<1>(map.settings.kernel, [&](auto profile) { return sum(phase, profile); });
          },
          medium.phase);
  if (region.whole() || is_black(light.value)) return light;
  const SeenAlong seen(medium.sigma_t, segment.interval, integrals);
  return over_share(light, region.share(radius, seen, work.rng), counters);
}

}  // namespace vpm
