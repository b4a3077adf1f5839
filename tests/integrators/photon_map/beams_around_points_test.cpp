// Photon beams around points of a march: one beam by hand.
#include "vpm/integrators/photon_map/volume/beams_around_points.h"

#include <gtest/gtest.h>

#include "support/scenes.h"

namespace vpm {
namespace {

constexpr float kDiscRadius = 0.1f;  // m

/// The mean over many marches, and its standard error.
struct MarchedMean {
  Rgbd mean{0.0}, error{0.0};
};

/// Of the light along a ray from the origin in the direction of x.
MarchedMean marched_light(const Scene& scene, const VolumeSettings& settings, const std::vector<PhotonBeam>& beams,
                          const Interval& interval, int marches) {
  BeamsAroundPoints estimator(scene, settings, {}, 0.5f);
  static_cast<BeamRecorder*>(estimator.recorders()[0])->beams[0] = beams;
  RenderStatistics statistics;
  estimator.build(1, statistics);
  EyeCounters counters;
  EyeScratch scratch;
  Rgbd sum(0.0), squares(0.0);
  for (int i = 0; i < marches; ++i) {
    Rng rng(5, rng_stream(RngUse::test, 1), static_cast<uint64_t>(i));
    EyeWork work{rng, counters, scratch};
    const EyeSegment segment(scene, {{Vec3(0.0f), Vec3(1.0f, 0.0f, 0.0f)}, interval, 0}, {});
    const Rgbd light(estimator.along(segment, work).value);
    sum += light;
    squares += light * light;
  }
  const double n = marches;
  const Rgbd mean = sum / n;
  return {mean, glm::sqrt(glm::max(Rgbd(0.0), squares / n - mean * mean) / n)};
}

VolumeSettings settings_of(KernelKind kernel) {
  return VolumeSettings("beams-points", {.radius = kDiscRadius, .kernel = kernel});
}

Scene endless(Medium medium) {
  Scene scene;
  scene.media.push_back(std::move(medium));
  scene.world_medium = 0;
  scene.lights.push_back(ConstantEnvironment{Rgb(1.0f)});
  scene.geometry.commit();
  finish(scene);
  return scene;
}

// A beam across the ray, 4 cm beside it: the march sums discs of all places of the beam within the radius, and so
// a kernel over a line, W/m^2.
TEST(BeamsAroundPoints, OneBeamIsItsFiveFactors) {
  const Rgb sigma_t(0.7f), albedo(0.9f, 0.5f, 0.1f);
  Medium medium = make_medium(nullptr, sigma_t);
  medium.sigma_s = albedo * sigma_t;
  medium.phase = HenyeyGreenstein{0.4f};
  const Scene scene = endless(medium);
  const Vec3 across(0.0f, 0.8f, 0.6f);
  const Vec3 beside(0.0f, -0.6f, 0.8f);
  const PhotonBeam beam{Vec3(1.2f, 0.0f, 0.0f) + 0.04f * beside - 0.5f * across, 0.6f, across, Rgb(3.0f, 2.0f, 1.0f)};
  for (const KernelInfo& info : kKernels) {
    // Its places are all at the same distance along the ray, so that nothing but the kernel changes along the march.
    double line = 0.0;  // the integral of the kernel along the ray, 1/m
    constexpr int kSteps = 4000;
    for (int i = 0; i < kSteps; ++i) {
      const float x = ((static_cast<float>(i) + 0.5f) / kSteps - 0.5f) * 2.0f * kDiscRadius;
      const float q = (x * x + 0.04f * 0.04f) / (kDiscRadius * kDiscRadius);
      if (q < 1.0f)
        line += double{with_kernel<2>(info.kind, [&](auto of) { return of(q).value; })} *
                kernel_norm_2d(info.kind, kDiscRadius) * 2.0 * kDiscRadius / kSteps;
    }
    const float phase = phase_value(HenyeyGreenstein{0.4f}, across, Vec3(-1.0f, 0.0f, 0.0f));
    const Rgb light =
        Rgb(3.0f, 2.0f, 1.0f) * sigma_t * albedo * phase * std::exp(-0.7f * 1.2f) * static_cast<float>(line);
    const MarchedMean found = marched_light(scene, settings_of(info.kind), {beam}, {0.0f, 2.0f}, 20'000);
    for (int c = 0; c < 3; ++c) {  // five standard errors: one false alarm in 1e5 runs of the test
      EXPECT_NEAR(found.mean[c], light[c], 5.0 * found.error[c]) << info.name;
      EXPECT_LT(found.error[c], 0.02f * light[c]) << info.name;
    }
  }
}

TEST(BeamsAroundPoints, ABeamEndsWhereItsPhotonCollides) {
  const Scene scene = endless(make_medium(nullptr, Rgb(0.7f)));
  const Vec3 across(0.0f, 0.0f, 1.0f);
  const auto light = [&](float length) {
    const PhotonBeam beam{Vec3(1.2f, 0.03f, -0.5f), length, across, Rgb(1.0f)};
    return marched_light(scene, settings_of(KernelKind::epanechnikov), {beam}, {0.0f, 2.0f}, 100).mean.g;
  };
  EXPECT_GT(light(0.501f), 0.0);
  EXPECT_EQ(light(0.499f), 0.0);
}

TEST(BeamsAroundPoints, ChromaticBeamsCarryTheWeightsOfTheirMixture) {
  const Rgb sigma_t(0.2f, 1.0f, 3.0f), power(3.0f, 2.0f, 1.0f);
  const Scene scene = endless(make_medium(nullptr, sigma_t));
  const Vec3 across(0.0f, 0.0f, 1.0f);
  const PhotonBeam beam{Vec3(0.5f, 0.0f, -0.5f), 0.6f, across, power};
  const Rgbd found = marched_light(scene, settings_of(KernelKind::epanechnikov), {beam}, {0.0f, 1.0f}, 100).mean;
  const Rgb come = glm::exp(-sigma_t * 0.5f), weight = come / glm::dot(power / 6.0f, come);
  const Rgb light = power * weight * sigma_t * glm::exp(-sigma_t * 0.5f);
  EXPECT_NEAR(found.r / found.g, light.r / light.g, 1e-4f * light.r / light.g);
  EXPECT_NEAR(found.b / found.g, light.b / light.g, 1e-4f * light.b / light.g);
}

// A long beam goes on, and is what the transmittance leaves of it.
TEST(BeamsAroundPoints, LongBeamsAreAttenuated) {
  const Scene scene = endless(make_medium(nullptr, Rgb(0.7f)));
  VolumeSettings settings = settings_of(KernelKind::epanechnikov);
  const PhotonBeam beam{Vec3(0.5f, 0.0f, -0.5f), 2.0f, Vec3(0.0f, 0.0f, 1.0f), Rgb(1.0f)};
  const double whole = marched_light(scene, settings, {beam}, {0.0f, 1.0f}, 100).mean.g;
  settings.length = BeamLength::long_beams;
  EXPECT_NEAR(marched_light(scene, settings, {beam}, {0.0f, 1.0f}, 100).mean.g / whole, std::exp(-0.35), 1e-5);
}

}  // namespace
}  // namespace vpm
