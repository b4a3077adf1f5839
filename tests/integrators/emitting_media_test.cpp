// Media that emit, by paths and by photons: against closed forms, and against each other.
#include <gtest/gtest.h>

#include "support/emission.h"
#include "support/photons.h"
#include "support/scenes.h"
#include "support/statistics.h"
#include "vpm/integrators/path/path_tracer.h"
#include "vpm/integrators/render_scene.h"
#include "vpm/job/render_job.h"
#include "vpm/photon/emission.h"
#include "vpm/scene/assemble.h"

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
SceneParts furnace(MediumPart medium, const Rgb& radiance) {
  constexpr float kWall = 0.8f;
  SceneParts parts = parts_with(std::move(medium));
  parts.materials.push_back({Lambertian{Rgb(kWall)}});
  const Vec3 x(2.0f, 0.0f, 0.0f), y(0.0f, 2.0f, 0.0f), z(0.0f, 0.0f, 2.0f), low(-1.0f), high(1.0f);
  for (const auto& [corner, u, v] : {std::tuple(low, x, y), std::tuple(low, y, z), std::tuple(low, z, x),
                                     std::tuple(high, -y, -x), std::tuple(high, -z, -y), std::tuple(high, -x, -z)}) {
    ShapePart wall;
    wall.surface = quad_mesh(corner, u, v);
    wall.material = 1;
    wall.media = Interface{kVacuum, 0};  // the medium lies before it
    wall.emission = (1.0f - kWall) * radiance;
    parts.shapes.push_back(wall);
  }
  parts.camera = make_camera(Vec3(0.3f, 0.1f, 0.7f), Vec3(0.0f), Vec3(0.0f, 1.0f, 0.0f), 60.0f, {32, 32});
  parts.camera_medium = 0;
  return parts;
}

TEST(EmittingMedia, InAFurnaceAreOfItsRadiance) {
  const Rgb radiance(3.0f, 1.0f, 0.2f);
  const Scene scene = assemble(furnace(emitting(Rgb(0.9f), Rgb(0.2f, 0.5f, 0.95f), radiance), radiance)).scene;
  for (int channel = 0; channel < 3; ++channel)
    expect_mean(samples(scene, {Vec3(0.3f, 0.1f, 0.7f), glm::normalize(Vec3(-0.4f, 0.2f, -1.0f))}, channel, 50'000),
                radiance[channel], kFalseAlarms);
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
