// Single scattering seen along rays: by marches towards a point light, by eye paths, by photons.
#include "vpm/study/estimates/airlight.h"

#include <algorithm>
#include <vector>

#include "vpm/base/warp.h"
#include "vpm/integrators/photon_map/eye_path.h"
#include "vpm/integrators/photon_map/volume/marched.h"
#include "vpm/path/direct_light.h"
#include "vpm/scene/build.h"
#include "vpm/study/sample_moments.h"

namespace vpm {
namespace {

constexpr float kOpticalStep = 0.5f;  // of a march
constexpr int kPairs = 8;             // of distances

/// An endless medium and a light in it.
Scene endless_scene(double sigma_t, double albedo, double g, const Light& light) {
  Scene scene;
  Medium medium;
  medium.sigma_t = Rgb(static_cast<float>(sigma_t));
  medium.sigma_s = static_cast<float>(albedo) * medium.sigma_t;
  if (g != 0.0) medium.phase = HenyeyGreenstein{static_cast<float>(g)};
  scene.media.push_back(medium);
  scene.world_medium = 0;
  scene.camera_medium = 0;
  scene.lights.push_back(light);
  scene.geometry.commit();
  finish(scene);
  return scene;
}

/// Coordinates along the ray are measured from the point next to the light, where they need their digits.
Scene airlight_scene(const Airlight& a) {
  return endless_scene(a.sigma_t, a.albedo, a.g,
                       PointLight{Vec3(0.0f, static_cast<float>(a.distance), 0.0f), Rgb(1.0f)});
}

const Vec3 kForward(0.0f, 0.0f, 1.0f);
Ray from(double z) { return {Vec3(0.0f, 0.0f, static_cast<float>(z)), kForward}; }

/// Ends of the stretches, measured from the point next to the light: each at most twice as far away as the one before,
/// from half the light's distance on.
std::vector<double> stretches(const Airlight& a) {
  const double lo = a.t0 - a.t_light, hi = a.t1 - a.t_light;
  std::vector<double> ends{lo};
  const double farthest = 1e3 * std::max(a.distance, std::abs(lo)) + 100.0 / a.sigma_t;
  for (double z = std::min(std::abs(lo), farthest); z > 0.25 * a.distance; z *= 0.5) ends.push_back(-z);
  ends.push_back(0.0);
  for (double z = 0.5 * a.distance; z < farthest; z *= 2.0) ends.push_back(z);
  std::sort(ends.begin(), ends.end());
  std::erase_if(ends, [&](double z) { return z < lo || z >= hi; });
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  ends.push_back(hi);
  return ends;
}

/// The natural logarithm of the transmittance along a ray, from pieces that floats can hold.
double log_transmittance(const Scene& scene, const TransmittanceEstimator& estimator, const Ray& ray, double length,
                         Rng& rng) {
  const double pieces = std::max(1.0, std::ceil(length * scene.media[0].sigma_t.r / 32.0));
  if (pieces > 1e5) return -HUGE_VAL;
  double sum = 0.0;
  for (double i = 0.0; i < pieces; ++i) {
    const Interval piece{static_cast<float>(length * i / pieces), static_cast<float>(length * (i + 1.0) / pieces)};
    sum += std::log(estimator.estimate(scene.media[0], ray, piece, rng).value.r);
  }
  return sum;
}

/// The logarithm of the light's irradiance at a point, W/m^2, and the direction towards it.
double log_irradiance(const Scene& scene, const TransmittanceEstimator& estimator, const Vec3& point, Rng& rng,
                      Vec3& direction) {
  constexpr double kDeep = 60.0;  // optical thickness beyond which floats lose digits
  const double distance = glm::distance(Vec3d(light_place(scene.lights[0])->point), Vec3d(point));
  WalkCounters counters;
  const ShadowRays rays{scene, estimator, rng, counters};
  if (distance * scene.media[0].sigma_t.r < kDeep) {
    const DirectSample light = sample_direct(rays, 0, {point, 0});
    direction = light.direction;
    return std::log(light.irradiance.r);
  }
  const DirectSample light = sample_direct(rays, 0, {point, kVacuum});
  direction = light.direction;
  return std::log(light.irradiance.r) + log_transmittance(scene, estimator, {point, direction}, distance, rng);
}

}  // namespace

Moments estimate_airlight(const Airlight& a, double log10_scale, uint64_t samples, uint64_t seed) {
  const Scene scene = airlight_scene(a);
  const auto estimator = make_transmittance_estimator({});
  const Medium& medium = scene.media[0];
  const std::vector<double> ends = stretches(a);
  const double shift = log10_scale * std::log(10.0);
  return sample_moments(1, samples, seed, [&](Rng& rng, double* out) {
    Marcher marcher;
    for (size_t i = 0; i + 1 < ends.size(); ++i) {
      // A ray of its own for each stretch: distances along it are short, as behind a boundary.
      const double before = log_transmittance(scene, *estimator, from(-a.t_light), ends[i] + a.t_light, rng);
      const Interval stretch{0.0f, static_cast<float>(ends[i + 1] - ends[i])};
      marcher.march(medium, from(ends[i]), stretch, {kInfinity, kOpticalStep}, rng,
                    [&](const Vec3& point, const Rgb& weight) {
                      Vec3 towards(0.0f);
                      const double irradiance = log_irradiance(scene, *estimator, point, rng, towards);
                      const double phase = phase_value(medium.phase, glm::dot(towards, kForward));
                      if (weight.r > 0.0f && std::isfinite(irradiance))
                        out[0] += medium.sigma_s.r * phase * std::exp(before + std::log(weight.r) + irradiance - shift);
                    });
    }
  })[0];
}

Moments estimate_airlight_by_eye_path(const Airlight& a, DirectLight direct, uint64_t samples, uint64_t seed) {
  const Scene scene = airlight_scene(a);
  const std::shared_ptr<const TransmittanceEstimator> transmittance = make_transmittance_estimator({});
  Estimators estimators;
  if (direct == DirectLight::equiangular) {
    estimators.volume.push_back(std::make_unique<SingleEquiangular>(scene, transmittance, kPairs));
  } else {
    const ScatteredOnce lights(scene, transmittance);
    estimators.volume.push_back(std::make_unique<MarchedLight>(std::nullopt, lights, kOpticalStep));
  }
  const EyeContext context{scene, estimators};
  return sample_moments(1, samples, seed, [&](Rng& rng, double* out) {
    EyeCounters counters;
    EyeScratch scratch;
    EyeWork work{rng, counters, scratch};
    out[0] = eye_radiance(context, from(-a.t_light), work).value.r;
  })[0];
}

namespace {

constexpr int kRaysOfPass = 100;

/// The mean of what is seen along the rays that `draw` draws.
template <class Draw>
RadianceByPhotons mean_along_rays(const Scene& scene, PhotonRays by, const Draw& draw) {
  by.max_events = 1;
  return estimate_along_rays(scene, by, [&](const auto& see, Rng& rng) {
    double sum = 0.0;
    for (int i = 0; i < kRaysOfPass; ++i) sum += see(draw(rng));
    return std::vector<double>{sum / kRaysOfPass};
  })[0];
}

}  // namespace

RadianceByPhotons estimate_airlight_by_photons(const Airlight& a, const PhotonRays& by) {
  const Vec3d light(0.0, a.distance, 0.0);
  return mean_along_rays(airlight_scene(a), by, [&](Rng& rng) {
    Vec3 aside, unused;
    const Vec3 forward = uniform_sphere(rng.uniform2());
    make_frame(forward, aside, unused);
    const Vec3d origin = light - a.distance * Vec3d(aside) - a.t_light * Vec3d(forward);
    return Ray{Vec3(origin), forward};
  });
}

RadianceByPhotons estimate_beam_airlight_by_photons(const BeamAirlight& a, const PhotonRays& by) {
  const Vec3 axis(0.0f, -1.0f, 0.0f);
  const double power = kPiD * a.beam_radius * a.beam_radius;
  const BeamLight light{-static_cast<float>(a.flown) * axis, axis, static_cast<float>(a.beam_radius),
                        Rgb(static_cast<float>(power))};
  return mean_along_rays(endless_scene(a.sigma_t, a.albedo, a.g, light), by, [&](Rng& rng) {
    const float turn = 2.0f * kPi * rng.uniform();
    const auto cosine = static_cast<float>(a.cosine), sine = static_cast<float>(std::sqrt(1.0 - a.cosine * a.cosine));
    const Vec3 forward = cosine * axis + sine * Vec3(std::cos(turn), 0.0f, std::sin(turn));
    return Ray{-static_cast<float>(a.seen) * forward, forward};
  });
}

}  // namespace vpm
