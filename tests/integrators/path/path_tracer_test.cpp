// The path tracer against closed forms. What it says of whole scenes is compared with the photon maps by `vpm
// validate`.
#include "vpm/integrators/path/path_tracer.h"

#include <gtest/gtest.h>

#include "support/scenes.h"
#include "support/statistics.h"
#include "vpm/path/path_weight.h"

namespace vpm {
namespace {

/// Samples of the radiance along a ray from outside all shapes, red channel.
Moments samples(const Scene& scene, const Ray& ray, int count) {
  const PathContext context = make_path_context(scene, {});
  EyeCounters counters;
  Moments moments;
  for (int i = 0; i < count; ++i) {
    Rng rng(5, rng_stream(RngUse::test, 0), static_cast<uint64_t>(i));
    moments.add(path_radiance(context, ray, scene.world_medium, rng, counters).r);
  }
  EXPECT_EQ(counters.cut_paths, 0u);
  return moments;
}

// Glass flush on a table is in optical contact with it: light meets the table from within the glass, and none goes
// through. Under an even sky a black table leaves the reflection of the glass, a white one shows as the sky.
TEST(PathTracer, GlassStandsOnATable) {
  for (const bool upside_down : {false, true})
    for (const float reflectance : {0.0f, 1.0f}) {
      Scene scene;
      scene.media.push_back(make_medium(nullptr, Rgb(1e-6f)));
      const Interface media{0, kVacuum};
      const float y = upside_down ? -1.0f : 0.0f;
      add_shape(scene, box_mesh(Vec3(-50, y, -50), Vec3(50, y + 1, 50)), Dielectric{1.5f}, &media);
      add_shape(scene, quad_mesh(Vec3(-60, 0, 60), Vec3(120, 0, 0), Vec3(0, 0, -120)), Lambertian{Rgb(reflectance)});
      scene.lights.push_back(ConstantEnvironment{Rgb(1.0f)});
      scene.geometry.commit();
      finish(scene);
      const float sense = upside_down ? -1.0f : 1.0f;
      for (const float x : {-0.3f, 0.1f, 0.7f}) {
        const Moments seen = samples(scene, {Vec3(x, 3.0f * sense, 0.2f), Vec3(0.0f, -sense, 0.0f)}, 20000);
        if (reflectance == 0.0f) expect_mean(seen, 0.04, kFalseAlarms, "a black table");
        // The glass is 100 m wide: a part of about 1e-3 of the light leaves by its sides, and sees the sky, too.
        if (reflectance == 1.0f) {
          EXPECT_NEAR(seen.mean(), 1.0, 1e-3);
        }
      }
    }
}

/// A floor, and above it a lamp that faces it. `lamp`: a DiscLight or a MeshLight.
template <class Lamp, class Surface>
Scene lit_floor(const Lamp& lamp, const Surface& surface) {
  Scene scene;
  scene.lights.push_back(lamp);
  add_shape(scene, surface, Lambertian{Rgb(0.0f)}, nullptr, 0);
  add_shape(scene, quad_mesh(Vec3(-3, 0, 3), Vec3(6, 0, 0), Vec3(0, 0, -6)), Lambertian{Rgb(0.6f)});
  scene.geometry.commit();
  finish(scene);
  return scene;
}
const Ray kAtFloor{Vec3(0.0f, 0.2f, 2.0f), glm::normalize(Vec3(0.0f, -0.2f, -2.0f))};  // meets it at the origin

/// The irradiance, over pi, under the center of a parallel square of radiance 1, half edge h over its height.
double square_irradiance(double h) {
  const double s = h / std::sqrt(1.0 + h * h);
  return 4.0 / M_PI * s * std::atan(s);
}

// A disc's irradiance is that of a sphere of the same half angle.
TEST(PathTracer, DiscsOfAllSizes) {
  for (const float radius : {0.02f, 1.5f}) {
    const DiscLight lamp{Vec3(0, 1, 0), Vec3(0, -1, 0), radius, Rgb(1.0f)};
    const Moments seen = samples(lit_floor(lamp, DiscShape{lamp.center, lamp.normal, radius}), kAtFloor, 40000);
    expect_mean(seen, 0.6 * radius * radius / (1.0 + radius * radius), kFalseAlarms, "disc");
    EXPECT_LT(seen.variance(), 2.0 * seen.mean() * seen.mean()) << "both ways share";
  }
}

// Two squares over each other as one mesh. The lower one takes away as much of the upper one as it sends itself; turned
// round it only takes away.
TEST(PathTracer, MeshesStandInTheirOwnLight) {
  for (const bool lower_shines : {true, false})
    for (const double h : {0.1, 1.2}) {
      TriangleMesh mesh = quad_mesh(Vec3d(-h, 1, -h), Vec3d(2 * h, 0, 0), Vec3d(0, 0, 2 * h));
      mesh.uvs.clear();
      const double low = 0.25 * h;  // seen as large as half of the upper one
      const TriangleMesh lower = quad_mesh(Vec3d(-low, 0.5, -low), Vec3d(2 * low, 0, 0), Vec3d(0, 0, 2 * low));
      for (glm::uvec3 t : lower.triangles) {
        if (!lower_shines) std::swap(t.y, t.z);
        mesh.triangles.push_back(t + 4u);
      }
      mesh.positions.insert(mesh.positions.end(), lower.positions.begin(), lower.positions.end());
      const MeshLight lamp{std::make_shared<const EmittingMesh>(mesh), Rgb(1.0f)};
      const Moments seen = samples(lit_floor(lamp, mesh), kAtFloor, 40000);
      const double exact = square_irradiance(h) - (lower_shines ? 0.0 : square_irradiance(0.5 * h));
      expect_mean(seen, 0.6 * exact, kFalseAlarms, "mesh");
    }
}

// Without multiple importance sampling, a strongly forward medium before a small bright light is noise. With it the
// variance of one sample stays near the squared mean.
TEST(PathTracer, TheTwoWaysShare) {
  Medium medium = make_medium(nullptr, Rgb(0.5f), 0.9f);
  medium.phase = HenyeyGreenstein{0.97f};
  const SphereLight lamp{Vec3(0, 0, -3), 0.25f, Rgb(10.0f)};
  Scene scene;
  scene.media.push_back(medium);
  const Interface media{0, kVacuum};
  add_shape(scene, box_mesh(Vec3d(-1.0), Vec3d(1.0)), Boundary{}, &media);
  scene.lights.push_back(lamp);
  add_shape(scene, SphereShape{lamp.center, lamp.radius}, Lambertian{Rgb(0.0f)}, nullptr, 0);
  scene.geometry.commit();
  finish(scene);
  const Moments seen = samples(scene, {Vec3(0, 0.35f, 3), Vec3(0, 0, -1)}, 40000);
  EXPECT_LT(seen.variance(), 10.0 * seen.mean() * seen.mean());
}

TEST(PathTracer, SpecularPathsFindLampsByThemselves) {
  // A light seen in a mirror, behind a pane of IOR 1: its radiance times the mirror's reflectance, without noise.
  Scene scene;
  const QuadLight lamp{Vec3(-1, 1, -1), Vec3(2, 0, 0), Vec3(0, 0, 2), Rgb(3.0f)};
  scene.lights.push_back(lamp);
  add_shape(scene, quad_mesh(lamp.corner, lamp.edge_u, lamp.edge_v), Lambertian{Rgb(0.0f)}, nullptr, 0);
  add_shape(scene, quad_mesh(Vec3(-3, 0, 3), Vec3(6, 0, 0), Vec3(0, 0, -6)), Mirror{Rgb(1.0f)});
  add_shape(scene, quad_mesh(Vec3(-3, 0.5f, 3), Vec3(6, 0, 0), Vec3(0, 0, -6)), Dielectric{1.0f});
  scene.geometry.commit();
  finish(scene);
  const Moments seen = samples(scene, {Vec3(0, 0.8f, 0), glm::normalize(Vec3(0.1f, -0.8f, 0))}, 100);
  EXPECT_EQ(seen.mean(), 3.0);
  EXPECT_EQ(seen.variance(), 0.0);
}

/// Every flight collides at once, with a weight that is not a number.
class BrokenStrategy : public DistanceStrategy {
 public:
  Flight sample(const Medium&, const Ray&, const Interval&, const Rgb&, Rng&) const override {
    return {.collided = true, .density = 1.0f, .weight = Rgb(std::numeric_limits<float>::quiet_NaN())};
  }
};

// Rays through a thin ball and past it: paths count once, however often they collide, and those past it do not.
TEST(PathTracer, WeighsPathsThroughMediaOnce) {
  Scene scene;
  scene.media.push_back(make_medium(nullptr, Rgb(5.0f), 1.0f));
  const Interface media{0, kVacuum};
  add_shape(scene, SphereShape{Vec3(0.0f), 1.0f}, Boundary{}, &media);
  scene.lights.push_back(ConstantEnvironment{Rgb(1.0f)});
  scene.geometry.commit();
  finish(scene);
  const PathContext context = make_path_context(scene, {});
  EyeCounters counters;
  for (uint64_t i = 0; i < 200; ++i) {
    Rng rng(5, rng_stream(RngUse::test, 2), i);
    path_radiance(context, {Vec3(i % 2 == 0 ? 0.0f : 2.0f, 0, 5), Vec3(0, 0, -1)}, kVacuum, rng, counters);
  }
  EXPECT_NEAR(counters.weights.sum, 100.0, 1e-4);
  EXPECT_NEAR(counters.weights.effective_sample_size(), 100.0, 1e-4);
  EXPECT_NEAR(counters.weights.largest, 1.0, 1e-5);
}

TEST(PathWeight, IsTheLargestMagnitudeWithItsSign) {
  WeightMoments weights;
  Event in_fog;
  in_fog.through_medium = true;
  PathWeight path, other, outside;
  for (const double weight : {0.5, -4.0, 2.0}) path.meet(weight, in_fog);
  path.meet(1.0, {});
  path.add_to(weights);
  other.meet(3.0, in_fog);
  other.add_to(weights);
  outside.meet(-9.0, {});
  outside.add_to(weights);
  EXPECT_EQ(weights.sum, -1.0);
  EXPECT_EQ(weights.squares, 25.0);
  EXPECT_EQ(weights.largest, 9.0);
  EXPECT_EQ(weights.effective_sample_size(), 1.0 / 25.0);
}

TEST(PathTracer, PathsThatAreNotFiniteAreCountedAndNotBlack) {
  const Scene scene = boxed_medium(make_medium(nullptr, Rgb(1.0f), 1.0f), ConstantEnvironment{Rgb(1.0f)});
  PathContext context = make_path_context(scene, {});
  context.distance = std::make_unique<BrokenStrategy>();
  EyeCounters counters;
  Rng rng(5, rng_stream(RngUse::test, 0), 0);
  mean_of_samples(10, counters, [&](int) {
    return path_radiance(context, {Vec3(0, 0, 5), Vec3(0, 0, -1)}, kVacuum, rng, counters);
  });
  EXPECT_EQ(counters.non_finite, 10u);
}

}  // namespace
}  // namespace vpm
