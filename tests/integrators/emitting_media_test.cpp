// Media that emit, by paths and by photons: against closed forms, and against each other.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/emission.h"
#include "support/photons.h"
#include "support/scenes.h"
#include "support/statistics.h"
#include "vpm/base/warp.h"
#include "vpm/image/metrics.h"
#include "vpm/integrators/combined/combined_pass.h"
#include "vpm/integrators/path/path_tracer.h"
#include "vpm/integrators/photon_map/photon_pass.h"
#include "vpm/integrators/render_scene.h"
#include "vpm/job/render_job.h"
#include "vpm/path/emission_along.h"
#include "vpm/photon/emission.h"
#include "vpm/scene/assemble.h"
#include "vpm/study/estimates/glowing.h"

namespace vpm {
namespace {

MediumPart emitting(const Rgb& sigma_t, const Rgb& albedo, const Rgb& radiance) {
  MediumPart part;
  part.medium.name = "fire";
  part.medium.phase = Isotropic{};
  part.medium.sigma_t = sigma_t;
  part.medium.sigma_s = sigma_t * albedo;
  part.medium.emission = MediumEmission{.colour = radiance};
  return part;
}

ShapePart boundary(const vpm::Surface& surface, MediumId inside) {
  ShapePart part;
  part.surface = surface;
  part.material = 0;
  part.media = Interface{inside, kVacuum};
  return part;
}

SceneParts parts_with(MediumPart medium) {
  SceneParts parts;
  parts.media.push_back(std::move(medium));
  parts.materials.push_back({Boundary{}});
  parts.camera = make_camera(Vec3(0.0f, 0.5f, 4.0f), Vec3(0.0f), Vec3(0.0f, 1.0f, 0.0f), 45.0f, {32, 32});
  return parts;
}

/// Samples of the radiance along a ray, one channel.
Moments samples(const Scene& scene, const Ray& ray, int channel, int count) {
  const PathContext context = make_path_context(scene, {});
  EyeCounters counters;
  Moments moments;
  for (int i = 0; i < count; ++i) {
    Rng rng(5, rng_stream(RngUse::test, 0), static_cast<uint64_t>(i));
    const MediumId medium = medium_at(scene, ray.origin);
    moments.add(path_radiance(context, ray, medium, rng, counters)[channel]);
  }
  return moments;
}

/// S9f of ../oracles/README.md: an absorbing ball of 0.3 m above a floor of reflectance 0.5.
TEST(EmittingMedia, OfABallLightAFloorByItsIntensity) {
  SceneParts parts = parts_with(emitting(Rgb(4.0f), Rgb(0.0f), Rgb(10.0f)));
  parts.materials.push_back({Lambertian{Rgb(0.5f)}});
  parts.shapes.push_back(boundary(SphereShape{Vec3(0.2f, 0.9f, -0.1f), 0.3f}, 0));
  ShapePart floor;
  floor.surface = quad_mesh(Vec3(-30.0f, 0.0f, 30.0f), Vec3(60.0f, 0.0f, 0.0f), Vec3(0.0f, 0.0f, -60.0f));
  floor.material = 1;
  parts.shapes.push_back(floor);
  const Scene scene = assemble(std::move(parts)).scene;
  struct Point {
    float x, z;
    double radiance;
  };
  for (const Point& p : {Point{0.2f, -0.1f, 0.4221529786234573}, Point{0.7f, -0.1f, 0.28199316915005745},
                         Point{-1.5f, 0.6f, 0.035881976032995685}}) {
    const Ray ray{Vec3(p.x, 0.3f, p.z), Vec3(0.0f, -1.0f, 0.0f)};
    const Moments seen = samples(scene, ray, 1, 20'000);
    expect_mean(seen, p.radiance, kFalseAlarms);
    EXPECT_LT(std::sqrt(seen.variance_of_mean()), 0.01 * p.radiance);
  }
}

/// S9c: through the middle of a ball of optical radius 2 and albedo 0.9.
TEST(EmittingMedia, OfABallScatterTheirOwnLight) {
  SceneParts parts = parts_with(emitting(Rgb(4.0f), Rgb(0.9f), Rgb(2.0f)));
  parts.shapes.push_back(boundary(SphereShape{Vec3(0.0f), 0.5f}, 0));
  const Scene scene = assemble(std::move(parts)).scene;
  expect_mean(samples(scene, {Vec3(0.0f, 0.0f, 3.0f), Vec3(0.0f, 0.0f, -1.0f)}, 0, 100'000), 2.0 * 0.27951287381927375,
              kFalseAlarms);
  expect_mean(samples(scene, {Vec3(0.375f, 0.0f, 3.0f), Vec3(0.0f, 0.0f, -1.0f)}, 0, 100'000),
              2.0 * 0.22370023436726016, kFalseAlarms);
}

/// A closed cavity whose walls and medium are of one radiance is of that radiance everywhere.
const Rgb kFurnace(3.0f, 1.0f, 0.2f);
Scene chromatic_furnace() {
  constexpr float kWall = 0.8f;
  return furnace(emitting(Rgb(0.9f), Rgb(0.2f, 0.5f, 0.95f), kFurnace).medium, kWall, (1.0f - kWall) * kFurnace);
}

TEST(EmittingMedia, InAFurnaceAreOfItsRadiance) {
  const Scene scene = chromatic_furnace();
  for (int channel = 0; channel < 3; ++channel)
    expect_mean(samples(scene, {Vec3(0.3f, 0.1f, 0.7f), glm::normalize(Vec3(-0.4f, 0.2f, -1.0f))}, channel, 50'000),
                kFurnace[channel], kFalseAlarms);
}

/// The means of pictures, one for each pass.
std::array<Moments, 3> means_of_passes(const Scene& scene, const RenderSettings& settings, int passes) {
  std::array<Moments, 3> means;
  for (int pass = 0; pass < passes; ++pass) {
    const Pass made = settings.integrator == Integrator::combined ? render_combined_pass(scene, settings, pass)
                                                                  : render_photon_pass(scene, settings, pass);
    const Rgbd mean = channel_means(made.image);
    for (int c = 0; c < 3; ++c) means[static_cast<size_t>(c)].add(mean[c]);
  }
  return means;
}

RenderSettings combined(std::initializer_list<Technique> techniques, Heuristic heuristic) {
  RenderSettings settings;
  settings.integrator = Integrator::combined;
  for (const TechniqueInfo& info : kTechniques) settings.combined.techniques.set(info.technique, false);
  for (const Technique technique : techniques) settings.combined.techniques.set(technique, true);
  settings.combined.heuristic = heuristic;
  settings.photons.emitted = 500;
  settings.radii = RadiusSchedule::constant;
  settings.volume.radius = settings.surface.radius = 0.02f;
  return settings;
}

/// Without kernels there is no bias: the shares of all techniques that find a path add up to 1, wherever photons start.
TEST(EmittingMedia, CombinedTechniquesFindAllOfAFurnace) {
  const Scene scene = chromatic_furnace();
  for (const Heuristic heuristic : {Heuristic::balance, Heuristic::power}) {
    const RenderSettings settings = combined({Technique::connections, Technique::light_tracing}, heuristic);
    const std::array<Moments, 3> means = means_of_passes(scene, settings, 60);
    for (int c = 0; c < 3; ++c) {
      expect_mean(means[static_cast<size_t>(c)], kFurnace[c], kFalseAlarms);
      EXPECT_LT(std::sqrt(means[static_cast<size_t>(c)].variance_of_mean()), 0.02 * kFurnace[c]);
    }
  }
}

/// With kernels of a hundredth of the cavity: with all, and with those that first flights from the medium miss.
TEST(EmittingMedia, MergesFindAllOfAFurnaceButForTheirKernels) {
  const Scene scene = chromatic_furnace();
  for (const auto& techniques :
       {std::initializer_list<Technique>{Technique::connections, Technique::light_tracing, Technique::surface_merging,
                                         Technique::points_3d, Technique::points_2d, Technique::short_beams},
        {Technique::connections, Technique::short_beams},
        {Technique::surface_merging, Technique::points_2d}}) {
    for (const Heuristic heuristic : {Heuristic::balance, Heuristic::correlation_aware}) {
      const std::array<Moments, 3> means = means_of_passes(scene, combined(techniques, heuristic), 60);
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(means[static_cast<size_t>(c)].mean() / kFurnace[c], 1.0,
                    0.02 + 4.0 * std::sqrt(means[static_cast<size_t>(c)].variance_of_mean()) / kFurnace[c]);
    }
  }
}

/// S9f once more, by photon maps: rays of final gathering must not see the ball as well.
TEST(EmittingMedia, OfABallLightAFloorOnceWithFinalGathering) {
  const Medium fire = emitting(Rgb(4.0f), Rgb(0.0f), Rgb(10.0f)).medium;
  Scene scene = glowing_ball(fire, {Vec3(0.2f, 0.9f, -0.1f), 0.3f}, 0.5f);
  scene.camera = make_camera(Vec3(0.7f, 0.3f, -0.1f), Vec3(0.7f, 0.0f, -0.1f), Vec3(0.0f, 0.0f, 1.0f), 0.5f, {4, 4});
  RenderSettings settings;
  settings.integrator = Integrator::photon;
  settings.photons.emitted = 5000;
  settings.indirect.type = IndirectLight::final_gather;
  expect_mean(means_of_passes(scene, settings, 60)[1], 0.28199316915005745, kFalseAlarms);
}

/// One sample of the fluence at a point: by a direction drawn evenly, by place, and by both with the balance heuristic.
/// Within a spotty grid the first has less noise, outside it the second, and both together not much more than the
/// better.
TEST(EmittingMedia, DirectionsAndPlacesTogetherAreNearTheBetter) {
  SceneParts parts = parts_with({});
  parts.media[0].medium = emitting_grids(0.9f, 0.0f);
  const Scene scene = assemble(std::move(parts)).scene;
  const auto transmittance = make_transmittance_estimator({});
  constexpr double kEven = 0.25 / kPiD;  // 1/sr
  for (const Vec3& point : {Vec3(0.1f, 1.4f, 2.1f), Vec3(-2.1f, 1.4f, 2.1f)}) {
    const MediumId medium = medium_at(scene, point);
    WalkCounters counters;
    Moments even, by_place, both;
    for (uint64_t i = 0; i < 40'000; ++i) {
      Rng rng(8, rng_stream(RngUse::test, 0), i);
      const Ray ray{point, uniform_sphere(rng.uniform2())};
      const double seen = emission_of(0, scene, ray, medium, counters).g / kEven;
      const double place = incident_pdf(scene.lights[0], point, {.direction = ray.direction});
      const DirectSample sample = sample_direct({scene, *transmittance, rng, counters}, 0, {point, medium});
      even.add(seen);
      by_place.add(sample.irradiance.g);
      both.add(seen * kEven / (kEven + place) + sample.irradiance.g * sample.pdf / (kEven + sample.pdf));
    }
    expect_same_means({even, even}, {by_place, both}, kFalseAlarms, "fluence");
    const auto deviation = [](const Moments& m) { return std::sqrt(m.variance()) / m.mean(); };
    const bool inside = medium == 0;
    RecordProperty(inside ? "inside" : "outside", fmt::format("directions {:.2f}, places {:.2f}, both {:.2f}",
                                                              deviation(even), deviation(by_place), deviation(both)));
    EXPECT_EQ(deviation(even) < deviation(by_place), inside);
    EXPECT_LT(deviation(both), 1.5 * std::min(deviation(even), deviation(by_place)));
  }
}

/// Photons start where it is emitted, with the power that is.
TEST(EmittingMedia, PhotonsCarryTheirPower) {
  SceneParts parts = parts_with({});
  parts.media[0].medium = emitting_grids(0.9f, 1.6f);
  parts.media[0].medium.emission->colour = Rgb(1.0f, 0.5f, 0.0f);
  const Scene scene = assemble(std::move(parts)).scene;
  ASSERT_EQ(scene.lights.size(), 1u);
  std::array<Moments, 3> power;
  for (uint64_t i = 0; i < 200'000; ++i) {
    Rng rng(6, rng_stream(RngUse::test, 0), i);
    const PathState photon = emit_photon(scene, draw_emission_point(rng));
    for (int c = 0; c < 3; ++c) power[c].add(photon.throughput[c]);
  }
  expect_mean(power[0], 37.73112090885143, kFalseAlarms);
  expect_mean(power[1], 0.5 * 37.73112090885143, kFalseAlarms);
  EXPECT_EQ(power[2].mean(), 0.0);
}

/// Values of 1.5 are no kelvin: the message says what they reach, and which keys change that.
TEST(EmittingMedia, ThatAreColdAreRefusedWithTheirTemperature) {
  SceneParts parts = parts_with({});
  parts.media[0].medium = emitting_grids(0.9f, 1.6f);
  parts.media[0].medium.emission->blackbody = true;
  try {
    assemble(std::move(parts));
    FAIL() << "it was taken";
  } catch (const PartError& error) {
    EXPECT_NE(error.wrong().find("emits nothing"), std::string::npos) << error.wrong();
    EXPECT_NE(error.right().find("reach 1.5 K"), std::string::npos) << error.right();
  }
}

/// A ball of glass in the fire holds no fire.
TEST(EmittingMedia, DoNotEmitWhereAnotherMediumIs) {
  SceneParts parts = parts_with(emitting(Rgb(1.0f), Rgb(0.0f), Rgb(1.0f)));
  parts.materials.push_back({Dielectric{1.5f}});
  parts.shapes.push_back(boundary(box_mesh(Vec3d(-1.0), Vec3d(1.0)), 0));
  ShapePart ball;
  ball.surface = SphereShape{Vec3(0.0f), 0.9f};
  ball.material = 1;
  ball.media = Interface{kVacuum, 0};
  parts.shapes.push_back(ball);
  const Scene scene = assemble(std::move(parts)).scene;
  Moments power;
  for (uint64_t i = 0; i < 100'000; ++i) {
    Rng rng(6, rng_stream(RngUse::test, 0), i);
    const PathState photon = emit_photon(scene, draw_emission_point(rng));
    if (photon.throughput.g > 0.0f) {
      ASSERT_GT(glm::length(photon.ray.origin), 0.8999f);
    }
    power.add(photon.throughput.g);
  }
  expect_mean(power, 4.0 * kPiD * (8.0 - 4.0 / 3.0 * kPiD * 0.729), kFalseAlarms);
}

}  // namespace
}  // namespace vpm
