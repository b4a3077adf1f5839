// L = sum over beams of Phi W(s) sigma_s p T(t) K(distance) / sine of the angle [Jarosz2011].
#include "vpm/estimate/volume/photon_beams.h"

#include <utility>
#include <variant>

#include "vpm/medium/distance/mixture.h"
#include "vpm/photon/thinning.h"

namespace vpm {
namespace {

/// The settings of the collisions that are gathered with the beams.
VolumeMapSettings with_beams(const PhotonBeamSettings& settings) {
  VolumeMapSettings maps = settings.maps;
  maps.turned &= !settings.planes;
  return maps;
}

}  // namespace

Rgb weight_along(const Medium& medium, const Ray& beam, const Rgb& power, float s) {
  if (is_grey(medium.sigma_t)) return Rgb(1.0f);
  const double integral = density_integral(medium, beam, {0.0f, s}).value;
  return analog_weight(medium, channel_shares(power), integral, false);
}

PhotonBeams::PhotonBeams(const Scene& scene, const PhotonBeamSettings& settings)
    : scene_(scene),
      settings_(settings),
      flights_(scene, settings.maps.filter(), {settings.long_beams, settings.planes}),
      collisions_(scene, with_beams(settings), 2) {}

std::vector<MapInfo> PhotonBeams::maps() const {
  MapInfo map = collisions_.maps().front();
  map.dimension = 1;
  map.flights = &flights_.beams;
  return {map};
}

Recorders PhotonBeams::recorders() {
  Recorders both{&flights_};
  for (PhotonRecorder* recorder : collisions_.recorders()) both.push_back(recorder);
  return both;
}

void PhotonBeams::build_beside(float kept_planes, uint64_t emitted, RenderStatistics& statistics) {
  const AskedGather& gather = settings_.maps.gather;
  const PassOfMaps& pass = settings_.maps.pass;
  collisions_.build(emitted, statistics,
                    [&](std::vector<Photon>& photons, const GatherSettings& of_pass, float shrunk, uint64_t of,
                        RenderStatistics& s) { return make_beam_map(photons, of_pass, shrunk, of, pass, s); });
  statistics.last_volume_radius = 0.0f;  // that of beams is told
  const auto scale = static_cast<float>(1.0 / static_cast<double>(emitted));
  Rng rng(settings_.seed, rng_stream(RngUse::flight, static_cast<uint64_t>(pass.number)), 0);
  for (const std::vector<PhotonBeam>& flights : flights_.beams) statistics.flights += flights.size();
  const float kept = thin(flights_.beams, settings_.flights, rng);
  for (size_t m = 0; m < scene_.media.size(); ++m) {
    const GatherSettings of_pass = gather_in_pass(gather, first_radius(gather, scene_, scene_.media[m]), 1, pass);
    const std::vector<PhotonBeam> beams = std::exchange(flights_.beams[m], {});
    statistics.beams += beams.size();
    statistics.last_volume_radius = std::max(statistics.last_volume_radius, of_pass.radius);
    const BeamBalance balance{kept * kernel_size_1d(of_pass.kernel, of_pass.radius),
                              kernel_size_2d(of_pass.kernel, collisions_[m].settings.radius), kept_planes};
    by_medium_.push_back({of_pass, balance, PhotonBeamMap(beams, of_pass.radius, scale), {}});
    Map& map = by_medium_.back();
    if (settings_.planes)
      for (const PhotonBeam& beam : beams) map.begins.push_back({beam.turned_from.unpack(), beam.scattering_rate});
    statistics.photon_map_bytes += map.beams.memory_bytes() + map.begins.capacity() * sizeof(Begin);
  }
}

KernelEstimate PhotonBeams::along(const EyeSegment& segment, EyeWork& work) const {
  if (!segment.medium()) return {};
  const Map& map = by_medium_[segment.number];
  KernelEstimate light = beams_along(segment, map, work);
  light += photons_beside(segment, collisions_[segment.number], settings_.maps.form, &map.balance, work);
  return light;
}

KernelEstimate PhotonBeams::beams_along(const EyeSegment& segment, const Map& map, EyeWork& work) const {
  if (map.beams.size() == 0) return {};
  const SegmentRegion region(segment, map.settings, Spread::lines);
  const Interval near = clip(segment.ray, region.reach(), map.beams.bounds(), map.settings.radius);
  return near.empty() ? KernelEstimate() : gather(segment, region, near, map, work);
}

/// Beams beyond the region have no share. Returns how many have one.
size_t PhotonBeams::pass_beams(const EyeSegment& segment, const SegmentRegion& region, const Map& map,
                               const PassToEye& pass, const BeamCrossings& found, Passed& passed, float* share) const {
  const Medium& medium = *segment.medium();
  const PlaneDistances distances = region.distances();
  float along[BeamCrossings::kMost], sigma_t[BeamCrossings::kMost];
  for (size_t i = 0; i < found.size; ++i) along[i] = distances.of({found.x[i], found.y[i], found.z[i]});
  pass({along, found.size}, passed, sigma_t);
  for (size_t i = 0; i < found.size; ++i) share[i] = map.balance.of_beams_over_sine(found.sine[i], sigma_t[i]);
  if (!map.begins.empty()) share_with_planes(segment.ray.direction, map, found, share);
  const auto multiply = [&](auto&& factor) {
    for (size_t i = 0; i < found.size; ++i) {
      const Vec3 direction(found.dx[i], found.dy[i], found.dz[i]);
      const Vec3 crossing = segment.ray.origin + Vec3(found.x[i], found.y[i], found.z[i]);
      const Rgb by = factor(i, crossing, direction);
      passed.r[i] *= by.r;
      passed.g[i] *= by.g;
      passed.b[i] *= by.b;
    }
  };
  if (settings_.long_beams || !is_grey(medium.sigma_t))
    multiply([&](size_t i, const Vec3& crossing, const Vec3& direction) {
      const Ray beam{crossing - found.s[i] * direction, direction};
      if (settings_.long_beams) return transmittance(medium, density_integral(medium, beam, {0.0f, found.s[i]}).value);
      return weight_along(medium, beam, {found.r[i], found.g[i], found.b[i]}, found.s[i]);
    });
  if (settings_.maps.form == VolumeForm::density_at_photon)
    multiply([&](size_t, const Vec3& crossing, const Vec3&) { return Rgb(medium.density(crossing)); });
  if (region.within().hold_all(found.x, found.y, found.z, found.size)) return found.size;
  size_t within = 0;
  for (size_t i = 0; i < found.size; ++i) {
    const bool holds = region.within().hold({found.x[i], found.y[i], found.z[i]});
    share[i] *= holds ? 1.0f : 0.0f;
    within += holds ? 1 : 0;
  }
  return within;
}

/// The shares of beams whose flights began at collisions.
void PhotonBeams::share_with_planes(const Vec3& ray, const Map& map, const BeamCrossings& found, float* share) const {
  for (size_t i = 0; i < found.size; ++i) {
    const Begin& begin = map.begins[found.beam[i]];
    if (begin.sigma_s == 0.0f) continue;
    const float determinant =
        std::abs(glm::dot(begin.from, glm::cross(Vec3(found.dx[i], found.dy[i], found.dz[i]), ray)));
    share[i] = map.balance.of_beams_beside_planes_over_sine(found.sine[i], begin.sigma_s, determinant);
  }
}

KernelEstimate PhotonBeams::gather(const EyeSegment& segment, const SegmentRegion& region, const Interval& near,
                                   const Map& map, EyeWork& work) const {
  const Medium& medium = *segment.medium();
  const float radius = map.settings.radius, inverse = 1.0f / (radius * radius);
  const bool at_photon = settings_.maps.form == VolumeForm::density_at_photon;
  const PassToEye pass(medium, medium.homogeneous() ? nullptr : &segment.integrals(work), settings_.maps.form,
                       region.mirrored());
  GatherCounters& counters = work.counters.gather;
  count(work.counters.volume_queries);
  count(counters.searches);
  const Vec3 towards_eye = -segment.ray.direction;
  static_assert(BeamCrossings::kMost <= PhotonBatch::kMost);
  const auto sum = [&](const auto& phase, auto profile) {
    KernelPair<Rgbd> sum_of_beams;
    const auto visit = [&](const BeamCrossings& found) {
      Passed passed;
      float share[BeamCrossings::kMost];  // over the sine
      counters.used += pass_beams(segment, region, map, pass, found, passed, share);
      LaneSums values, corrections;
      const auto add = [&](size_t lane, size_t i) {
        const Vec3 direction(found.dx[i], found.dy[i], found.dz[i]);
        const Rgb light = Rgb(found.r[i] * passed.r[i], found.g[i] * passed.g[i], found.b[i] * passed.b[i]) *
                          (phase.value(direction, towards_eye) * share[i]);
        const KernelPair<float> spread = profile(found.distance2[i] * inverse);
        values.add(lane, light * spread.value);
        corrections.add(lane, light * spread.correction);
      };
      const size_t whole_blocks = found.size / kBlock * kBlock;
      for (size_t block = 0; block < whole_blocks; block += kBlock)
        for (size_t lane = 0; lane < kBlock; ++lane) add(lane, block + lane);
      for (size_t i = whole_blocks; i < found.size; ++i) add(i - whole_blocks, i);
      sum_of_beams += {values.total(), corrections.total()};
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
  const SeenAlong seen(medium.sigma_t, segment.interval, pass.integrals());
  return over_share(light, region.share(radius, seen, work.rng), counters);
}

}  // namespace vpm
