// Lights above a plane.
#include "vpm/study/estimates/irradiance.h"

#include <optional>

#include "vpm/estimate/surface_estimate.h"
#include "vpm/path/direct_light.h"
#include "vpm/photon/records.h"
#include "vpm/scene/build.h"
#include "vpm/study/sample_moments.h"

namespace vpm {

namespace {

const Vec3 kUp(0.0f, 0.0f, 1.0f);

}  // namespace

Moments estimate_irradiance(const Light& light, const Vec3& receiver, uint64_t samples, uint64_t seed) {
  Scene scene;
  scene.lights.push_back(light);
  scene.geometry.commit();
  finish(scene);
  const auto transmittance = make_transmittance_estimator({});
  return sample_moments(1, samples, seed, [&](Rng& rng, double* out) {
    WalkCounters counters;
    const DirectSample sample = sample_direct({scene, *transmittance, rng, counters}, 0, {receiver, kVacuum, kUp});
    out[0] = sample.irradiance.r * std::max(0.0f, sample.direction.z);
  })[0];
}

Moments estimate_mean_irradiance(const std::function<Light(Rng&)>& draw, const Vec3& receiver, uint64_t samples,
                                 uint64_t seed) {
  return sample_moments(1, samples, seed, [&](Rng& rng, double* out) {
    const std::optional<Incident> incident = sample_towards(draw(rng), receiver, rng);
    if (incident) out[0] = incident->irradiance.r * std::max(0.0f, incident->direction.z);
  })[0];
}

MappedIrradiance estimate_mapped_irradiance(const Light& light, const Vec3& receiver, double h, bool aimed,
                                            uint64_t photons, uint64_t seed) {
  constexpr int kBatches = 40;
  Scene scene;
  const double half = 2.0 * h;
  const Vec3d corner = Vec3d(receiver) - Vec3d(half, half, 0.0);
  add_shape(scene, quad_mesh(corner, Vec3d(2.0 * half, 0.0, 0.0), Vec3d(0.0, 2.0 * half, 0.0)), Lambertian{});
  scene.lights.push_back(light);
  // It sees the disc of radius h and what is around it.
  const auto above = static_cast<float>(4.0 * h);
  scene.camera = make_camera(receiver + above * kUp, receiver, Vec3(0.0f, 1.0f, 0.0f), 40.0f, {1, 1});
  scene.geometry.commit();
  finish(scene);
  const auto strategy = make_distance_strategy({});
  MappedIrradiance result;
  for (int batch = 0; batch < kBatches; ++batch) {
    ListSettings trace;
    trace.seed = seed;
    trace.pass = static_cast<uint64_t>(batch);
    trace.emitted = photons;
    std::optional<PhotonGuide> guide;
    if (aimed) guide = learn_guide(scene, *strategy, {.importons = 2000}, seed, trace.pass, trace.max_events);
    trace.guide = guide ? &*guide : nullptr;
    const PhotonLists traced = list_photons(scene, *strategy, trace);
    const auto through = [&](double radius) {
      const GatherSettings gather{GatherMode::radius, static_cast<float>(radius), 0, KernelKind::epanechnikov};
      const PhotonMap map = make_photon_map(traced.surface, gather, traced.ledger.emitted_count);
      return double{surface_irradiance(receiver, kUp, map).value.r};
    };
    result.unbiased.add((4.0 * through(0.5 * h) - through(h)) / 3.0);
    for (const Photon& p : traced.surface)
      result.fewest += (glm::distance(p.position, receiver) < 0.5 * h) / static_cast<double>(kBatches);
  }
  return result;
}

}  // namespace vpm
