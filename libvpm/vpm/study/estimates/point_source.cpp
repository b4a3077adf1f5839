// Photons around a point source.
#include "vpm/study/estimates/point_source.h"

#include <algorithm>

#include "vpm/base/parallel.h"
#include "vpm/base/warp.h"
#include "vpm/estimate/volume_estimate.h"
#include "vpm/path/direct_light.h"
#include "vpm/path/follow.h"
#include "vpm/photon/records.h"
#include "vpm/scene/build.h"
#include "vpm/study/sample_moments.h"

namespace vpm {
namespace {

constexpr int kMostPointSourceEvents = 100'000'000;
constexpr double kSigmaT = 2.0;  // 1/m; not 1, so that it cannot be forgotten
/// A length given as optical thickness, m.
float metres(double optical) { return static_cast<float>(optical / kSigmaT); }

/// The medium everywhere, or up to an optical radius > 0.
Scene point_source_scene(const PointSource& source, double end) {
  Scene scene;
  Medium medium;
  medium.sigma_t = Rgb(static_cast<float>(kSigmaT));
  medium.sigma_s = static_cast<float>(source.albedo) * medium.sigma_t;
  if (source.g != 0.0) medium.phase = HenyeyGreenstein{static_cast<float>(source.g)};
  scene.media.push_back(medium);
  if (end > 0.0) {
    const Interface media{0, kVacuum};
    add_shape(scene, SphereShape{Vec3(0.0f), metres(end)}, Boundary{}, &media);
  } else {
    scene.world_medium = 0;
  }
  scene.lights.push_back(PointLight{Vec3(0.0f), Rgb(1.0f / (4.0f * kPi))});
  scene.geometry.commit();
  finish(scene);
  return scene;
}

/// The mean fluence of a map over points spread evenly over a sphere, for sigma_t = 1/m: a Fibonacci lattice, turned at
/// random.
double mean_over_sphere(const PhotonMap& map, const Medium& medium, float distance, Rng& rng) {
  const float r = map.settings.radius;
  const int points = static_cast<int>(std::ceil(16.0f * distance * distance / (r * r)));
  const float turn = rng.uniform(), shift = rng.uniform();
  double sum = 0.0;
  for (int i = 0; i < points; ++i) {
    const Vec2 u((static_cast<float>(i) + shift) / static_cast<float>(points),
                 static_cast<float>(std::fmod(i * 0.6180339887498949 + turn, 1.0)));
    sum += fluence(medium.sigma_t, distance * uniform_sphere(u), map).r;
  }
  return sum / points / (kSigmaT * kSigmaT);
}

/// The photons that a kernel of radius h can find from the sphere of that radius.
std::vector<Photon> near_sphere(const std::vector<Photon>& photons, float distance, float h) {
  std::vector<Photon> near;
  std::copy_if(photons.begin(), photons.end(), std::back_inserter(near),
               [&](const Photon& p) { return std::abs(glm::length(p.position) - distance) < 1.001f * h; });
  return near;
}

}  // namespace

MissingLight missing_light(const PointSource& source, double largest_radius) {
  constexpr double kMilne = 0.7104460896;  // extrapolated end point in transport mean free paths [Case1953]
  MissingLight missing;
  if (source.albedo <= 0.999) return missing;
  const double transport_path = 1.0 / (1.0 - source.albedo * source.g);
  missing.end = std::max(3.0 * largest_radius, std::max(40.0, 25.0 * transport_path));
  missing.diffusion = transport_path / 3.0;
  missing.attenuation = std::sqrt((1.0 - source.albedo) / missing.diffusion);
  missing.extrapolated = missing.end + kMilne * transport_path;
  // The end point of a sphere differs from a plane's by about the square of a path over the radius.
  missing.relative_error = std::pow(transport_path / missing.extrapolated, 2);
  return missing;
}

double MissingLight::fluence(double radius) const {
  if (end == 0.0) return 0.0;
  const double k = std::max(attenuation, 1e-6 / extrapolated);
  return std::exp(-k * extrapolated) * std::sinh(k * radius) / std::sinh(k * extrapolated) /
         (4.0 * kPiD * diffusion * radius);
}

double MissingLight::collisions_within(double radius) const {
  if (end == 0.0) return 0.0;
  // 4 pi times the integral of r^2 fluence(r), which is nearly constant.
  constexpr int kSteps = 256;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double r = radius * (i + 0.5) / kSteps;
    sum += 4.0 * kPiD * r * r * fluence(r) * radius / kSteps;
  }
  return sum;
}

std::vector<Moments> estimate_collisions_within(const PointSource& source, const std::vector<double>& radii,
                                                uint64_t photons, uint64_t seed) {
  const double largest = *std::max_element(radii.begin(), radii.end());
  const Scene scene = point_source_scene(source, missing_light(source, largest).end);
  const auto strategy = make_distance_strategy({});
  return sample_moments(radii.size(), photons, seed, [&](Rng& rng, double* out) {
    const Emission emission = emit(scene.lights[0], scene.bounds, rng);
    WalkCounters counters;
    const auto see = [&](const Event& event, const PathState&, const PathState& at) {
      if (event.kind != EventKind::collision) return true;
      const double r = kSigmaT * glm::length(Vec3d(at.ray.origin));
      for (size_t i = 0; i < radii.size(); ++i)
        if (r < radii[i]) out[i] += at.throughput.r;
      return true;
    };
    follow({scene, *strategy, counters, kMostPointSourceEvents}, {emission.ray, 0, emission.power}, rng,
           PhotonVisitor{see});
  });
}

std::vector<MapFluence> estimate_map_fluence(const PointSource& source, const std::vector<double>& distances,
                                             const std::vector<double>& kernel_radii, bool collided_only,
                                             const MapEffort& effort) {
  const double largest = *std::max_element(distances.begin(), distances.end());
  const Scene scene = point_source_scene(source, missing_light(source, largest).end);
  const auto strategy = make_distance_strategy({});
  std::vector<MapFluence> result(distances.size());
  std::vector<std::array<double, 3>> found(distances.size());  // wide, narrow, photons
  for (int batch = 0; batch < effort.batches; ++batch) {
    ListSettings trace;
    trace.seed = effort.seed;
    trace.pass = static_cast<uint64_t>(batch);
    trace.emitted = effort.photons;
    trace.max_events = kMostPointSourceEvents;
    trace.direct_collisions = !collided_only;
    const PhotonLists photons = list_photons(scene, *strategy, trace);
    parallel_for_chunks(distances.size(), 1, [&](size_t i, size_t, size_t) {
      Rng rng(effort.seed, rng_stream(RngUse::probe, static_cast<uint64_t>(batch)), i);
      for (int half = 0; half < 2; ++half) {
        const float distance = metres(distances[i]), h = metres(kernel_radii[i] * (half ? 0.5 : 1.0));
        std::vector<Photon> near = near_sphere(photons.volume[0], distance, h);
        found[i][2] = static_cast<double>(near.size());
        const GatherSettings gather{GatherMode::radius, h, 0, KernelKind::epanechnikov};
        const PhotonMap map = make_photon_map(std::move(near), gather, photons.ledger.emitted_count);
        found[i][half] = mean_over_sphere(map, scene.media[0], distance, rng);
      }
    });
    for (size_t i = 0; i < distances.size(); ++i) {
      result[i].wide.add(found[i][0]);
      result[i].narrow.add(found[i][1]);
      result[i].unbiased.add((4.0 * found[i][1] - found[i][0]) / 3.0);
      result[i].fewest += found[i][2] / effort.batches;
    }
  }
  return result;
}

double direct_fluence(const PointSource& source, double distance) {
  const Scene scene = point_source_scene(source, 0.0);
  Rng rng(0, 0, 0);
  WalkCounters counters;
  const Vec3 point(0.0f, metres(distance), 0.0f);
  const auto transmittance = make_transmittance_estimator({});
  return sample_direct({scene, *transmittance, rng, counters}, 0, {point, 0}).irradiance.r / (kSigmaT * kSigmaT);
}

}  // namespace vpm
