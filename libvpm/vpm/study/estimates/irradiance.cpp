// Lights above a plane; photons and paths in closed cavities.
#include "vpm/study/estimates/irradiance.h"

#include <algorithm>
#include <optional>

#include "vpm/base/warp.h"
#include "vpm/estimate/surface_estimate.h"
#include "vpm/integrators/path/path_tracer.h"
#include "vpm/path/direct_light.h"
#include "vpm/path/follow.h"
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

namespace {

constexpr int kMostCavityEvents = 10'000'000;

Scene cavity_scene(const Cavity& cavity) {
  Scene scene;
  const Lambertian wall{Rgb(static_cast<float>(cavity.reflectance))};
  if (cavity.box)
    add_shape(scene, box_mesh(Vec3d(-cavity.size), Vec3d(cavity.size)), wall);
  else
    add_shape(scene, SphereShape{Vec3(0.0f), static_cast<float>(cavity.size)}, wall);
  scene.lights.push_back(PointLight{cavity.source, Rgb(1.0f / (4.0f * kPi))});
  scene.geometry.commit();
  finish(scene);
  return scene;
}

}  // namespace

Moments estimate_wall_hits(const Cavity& cavity, uint64_t photons, uint64_t seed) {
  const Scene scene = cavity_scene(cavity);
  const auto strategy = make_distance_strategy({});
  return sample_moments(1, photons, seed, [&](Rng& rng, double* out) {
    const Emission emission = emit(scene.lights[0], scene.bounds, rng);
    WalkCounters counters;
    const auto see = [&](const Event& event, const PathState&, const PathState& at) {
      if (event.kind == EventKind::surface) out[0] += at.throughput.r;
      return true;
    };
    follow({scene, *strategy, counters, kMostCavityEvents}, {emission.ray, kVacuum, emission.power}, rng,
           PhotonVisitor{see});
  })[0];
}

Moments estimate_wall_irradiance(const Cavity& sphere, bool reflected_only, uint64_t photons, uint64_t seed) {
  constexpr int kBatches = 40, kPoints = 400;
  const Scene scene = cavity_scene(sphere);
  const auto strategy = make_distance_strategy({});
  const auto radius = static_cast<float>(kCapRadius * sphere.size);
  const GatherSettings gather{GatherMode::radius, radius, 0, KernelKind::epanechnikov};
  Moments result;
  for (int batch = 0; batch < kBatches; ++batch) {
    ListSettings trace;
    trace.seed = seed;
    trace.pass = static_cast<uint64_t>(batch);
    trace.emitted = photons / kBatches;
    trace.direct_hits = !reflected_only;
    PhotonLists traced = list_photons(scene, *strategy, trace);
    const PhotonMap map = make_photon_map(std::move(traced.surface), gather, traced.ledger.emitted_count);
    Rng rng(seed, rng_stream(RngUse::probe, static_cast<uint64_t>(batch)), 0);
    double sum = 0.0;
    for (int i = 0; i < kPoints; ++i) {
      const Vec3 outward = uniform_sphere(rng.uniform2());
      sum += surface_irradiance(static_cast<float>(sphere.size) * outward, -outward, map).value.r;
    }
    result.add(sum / kPoints);
  }
  return result;
}

double direct_wall_irradiance(const Cavity& sphere, const Vec3& outward) {
  const Scene scene = cavity_scene(sphere);
  Rng rng(0, 0, 0);
  WalkCounters counters;
  const Vec3 point = static_cast<float>(0.999999 * sphere.size) * outward;  // just off the wall
  const auto transmittance = make_transmittance_estimator({});
  const DirectSample sample = sample_direct({scene, *transmittance, rng, counters}, 0, {point, kVacuum, -outward});
  return -sample.irradiance.r * glm::dot(sample.direction, outward);
}

Moments estimate_cavity_radiance(const Cavity& cavity, const Vec3* outward, uint64_t samples, uint64_t seed) {
  const Scene scene = cavity_scene(cavity);
  RenderSettings settings;
  settings.max_events = kMostCavityEvents;
  const PathContext context = make_path_context(scene, settings);
  const Vec3 eye = static_cast<float>(cavity.size) * Vec3(0.1f, 0.2f, -0.3f);
  return sample_moments(1, samples, seed, [&](Rng& rng, double* out) {
    EyeCounters counters;
    const Vec3 direction =
        outward ? glm::normalize(static_cast<float>(cavity.size) * *outward - eye) : uniform_sphere(rng.uniform2());
    out[0] = path_radiance(context, {eye, direction}, kVacuum, rng, counters).r;
  })[0];
}

}  // namespace vpm
