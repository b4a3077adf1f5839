// Media along paths: coinciding boundaries, surfaces on boundaries, lights across boundaries.
#include "vpm/path/walk.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "support/scenes.h"
#include "support/statistics.h"
#include "vpm/path/direct_light.h"

namespace vpm {
namespace {

Mat4d some_rotation() { return glm::rotate(Mat4d(1.0), 0.9, glm::normalize(Vec3d(1.0, 2.0, -0.7))); }

TriangleMesh turned(TriangleMesh mesh, const Mat4d& m) {
  for (Vec3& p : mesh.positions) p = Vec3(m * glm::dvec4(Vec3d(p), 1.0));
  return mesh;
}

/// The optical thickness of a ray, by its direct transmittance.
double optical_thickness(const Scene& scene, const Ray& ray, float distance, MediumId start, WalkCounters& counters) {
  Rng rng(1, 0, 0);
  const auto regular = make_transmittance_estimator({});
  return -std::log(visibility({scene, *regular, rng, counters}, ray, distance, -2, start).r);
}

/// A room full of one medium, with a box of another on its floor: rays come down to the floor from within the box, and
/// go on in it. What is in neither comes to the floor by mistake, and is told.
TEST(Walk, ABoxOnTheFloorOfARoomIsLeftNowhere) {
  constexpr MediumId kFog = 0, kSmoke = 1, kOther = 2;
  Scene scene;
  for (int i = 0; i < 3; ++i) scene.media.push_back(make_medium(nullptr, Rgb(1.0f)));
  const Interface room{kFog, kVacuum}, box{kSmoke, kFog};
  add_shape(scene, box_mesh(Vec3d(-2.0, 0.0, -2.0), Vec3d(2.0, 3.0, 2.0)), Lambertian{Rgb(0.5f)}, &room);
  add_shape(scene, box_mesh(Vec3d(-1.0, 0.0, -1.0), Vec3d(1.0, 1.0, 1.0)), Boundary{}, &box);
  scene.geometry.commit();
  const auto medium_at_floor = [&](const Vec3& from, const Vec3& to, MediumId medium, WalkCounters& counters) {
    const Encounter met = meet(scene, {from, glm::normalize(to - from)}, kInfinity, medium, counters);
    EXPECT_TRUE(met.surface);
    return medium;
  };
  Rng rng(1, 0, 0);
  WalkCounters right, wrong;
  for (int i = 0; i < 1000; ++i) {
    const Vec2 u = rng.uniform2(), v = rng.uniform2();
    const Vec3 within(1.8f * u.x - 0.9f, 0.9f, 1.8f * u.y - 0.9f), beside(1.9f, 2.0f * u.x + 0.1f, u.y);
    const Vec3 under(1.8f * v.x - 0.9f, 0.0f, 1.8f * v.y - 0.9f), beyond(1.1f + 0.8f * v.x, 0.0f, v.y);
    EXPECT_EQ(medium_at_floor(within, under, kSmoke, right), kSmoke);
    EXPECT_EQ(medium_at_floor(beside, beyond, kFog, right), kFog);
    EXPECT_EQ(medium_at_floor(beside, beyond, kOther, wrong), kFog);
  }
  EXPECT_EQ(right.medium_mismatches, 0u);
  EXPECT_EQ(wrong.medium_mismatches, 1000u);
}

TEST(Walk, MediaThatTouchAreBothCrossedInAnyOrderOfShapes) {
  // Four slabs of 1 m across x, touching: sigma_t 0.1, 0.4, none, 0.2. A ray along x sees their sum, turned any way.
  const float sigma[] = {0.1f, 0.4f, 0.2f};
  for (const bool turn : {false, true})
    for (int order = 0; order < 6; ++order) {
      const Mat4d m = turn ? some_rotation() : Mat4d(1.0);
      Scene scene;
      for (const float s : sigma) scene.media.push_back(make_medium(nullptr, Rgb(s)));
      const int permutations[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
      const float begin[] = {0.0f, 1.0f, 3.0f};
      for (const int i : permutations[order]) {
        const Interface media{i, kVacuum};
        add_shape(scene, turned(box_mesh(Vec3(begin[i], -1, -1), Vec3(begin[i] + 1, 1, 1)), m), Boundary{}, &media);
      }
      scene.geometry.commit();
      WalkCounters counters;
      for (int k = 0; k < 50; ++k) {
        const Vec3d from(-1.0, -0.9 + 0.036 * k, 0.9 - 0.031 * k), to(5.0, 0.9 - 0.03 * k, -0.8 + 0.03 * k);
        const Vec3 a(m * glm::dvec4(from, 1.0)), b(m * glm::dvec4(to, 1.0));
        const double stretch = glm::distance(from, to) / 6.0;
        const double forth =
            optical_thickness(scene, {a, glm::normalize(b - a)}, glm::distance(a, b), kVacuum, counters);
        const double back =
            optical_thickness(scene, {b, glm::normalize(a - b)}, glm::distance(a, b), kVacuum, counters);
        EXPECT_NEAR(forth, 0.7 * stretch, 1e-5) << order;
        EXPECT_NEAR(back, 0.7 * stretch, 1e-5) << order;
      }
      EXPECT_EQ(counters.medium_mismatches, 0u);
      for (const double in : {0.05, 0.5, 0.95}) {  // near a face most of the directions that vote meet that one
        for (int i = 0; i < 3; ++i)
          EXPECT_EQ(medium_at(scene, Vec3(m * glm::dvec4(begin[i] + in, 0.2, 0.1, 1.0))), i) << order;
        EXPECT_EQ(medium_at(scene, Vec3(m * glm::dvec4(2.0 + in, 0.2, 0.1, 1.0))), kVacuum) << order;
      }
    }
}

TEST(Walk, ANestedMediumMayShareItsFloorWithTheOuterOne) {
  for (const bool inner_first : {false, true})
    for (const auto& [turn, w] :
         {std::pair(false, 2.0f), std::pair(true, 2.0f), std::pair(true, 15.0f), std::pair(true, 60.0f)}) {
      const Mat4d m = turn ? some_rotation() : Mat4d(1.0);
      Scene scene;
      scene.media.push_back(make_medium(nullptr, Rgb(0.3f)));
      scene.media.push_back(make_medium(nullptr, Rgb(1.1f)));
      const Interface outer{0, kVacuum}, inner{1, 0};
      const TriangleMesh large = turned(box_mesh(Vec3(-w, 0, -w), Vec3(w, 3, w)), m),
                         small = turned(box_mesh(Vec3(-1, 0, -1), Vec3(1, 1, 1)), m);
      if (inner_first) add_shape(scene, small, Boundary{}, &inner);
      add_shape(scene, large, Boundary{}, &outer);
      if (!inner_first) add_shape(scene, small, Boundary{}, &inner);
      scene.geometry.commit();
      WalkCounters counters;
      const double tolerance = w > 2.0f ? 1e-4 : 1e-5;  // rays stand off larger boundaries by more
      for (int k = 0; k < 100; ++k) {
        const double x = 0.9 - 0.017 * k, z = 0.015 * k - 0.8;
        const Vec3 a(m * glm::dvec4(x, -1.0, z, 1.0)), b(m * glm::dvec4(x, 4.0, z, 1.0));
        EXPECT_NEAR(optical_thickness(scene, {a, glm::normalize(b - a)}, 5.0f, kVacuum, counters), 1.1 + 0.6,
                    tolerance);
        EXPECT_NEAR(optical_thickness(scene, {a, glm::normalize(b - a)}, 3.0f, kVacuum, counters), 1.1 + 0.3,
                    tolerance);
        EXPECT_NEAR(optical_thickness(scene, {b, glm::normalize(a - b)}, 5.0f, kVacuum, counters), 1.1 + 0.6,
                    tolerance);
      }
      EXPECT_EQ(counters.medium_mismatches, 0u);
    }
}

/// A faint light beside a bright one is picked as often as it should be, by numbers finer than floats: first or last.
TEST(PickLight, FindsTheFaintest) {
  Scene scene;
  scene.lights = {PointLight{}, PointLight{}, PointLight{}};
  scene.light_probability = {1e-9, 1.0 - 3e-9, 2e-9};
  EXPECT_EQ(pick_light(scene, 0.0).number, 0);
  EXPECT_EQ(pick_light(scene, 0.99e-9).number, 0);
  EXPECT_EQ(pick_light(scene, 1.01e-9).number, 1);
  EXPECT_EQ(pick_light(scene, 1.0 - 2.01e-9).number, 1);
  EXPECT_EQ(pick_light(scene, 1.0 - 1.99e-9).number, 2);
  EXPECT_EQ(pick_light(scene, 1.0 - 0x1p-53).number, 2);
  EXPECT_EQ(pick_light(scene, 0.0).probability, 1e-9f);
}

/// Flights that stop on the way and go on from there are as long as those that do not: collisions along a ray through
/// a box of fog, with stops at random places before, on and behind its faces.
TEST(Walk, FlightsMayStopOnTheWay) {
  const Scene scene = boxed_medium(make_medium(nullptr, Rgb(0.8f)), PointLight{Vec3(3.0f), Rgb(1.0f)});
  const auto strategy = make_distance_strategy({});
  const Vec3 from(-2.0f, 0.3f, -0.2f), along(1.0f, 0.0f, 0.0f);
  std::vector<double> counts(9, 0.0), probabilities(9, std::exp(-0.8 * 2.0));
  WalkCounters counters;
  for (uint64_t i = 0; i < 50'000; ++i) {
    Rng rng(1, 2, i);
    PathState state{{from, along}, kVacuum, Rgb(1.0f)};
    Event event;
    do event = next_event(scene, *strategy, state, rng, counters, 0.1f + 1.5f * rng.uniform());
    while (event.kind == EventKind::limit && state.ray.origin.x < 5.0f);
    if (event.kind == EventKind::collision)
      ++counts[static_cast<size_t>((state.ray.origin.x + 1.0f) * 4.0f)];
    else
      ++counts[8];
  }
  for (int i = 0; i < 8; ++i) probabilities[i] = std::exp(-0.8 * 0.25 * i) - std::exp(-0.8 * 0.25 * (i + 1));
  expect_distribution(counts, probabilities, 1e-6);
  EXPECT_EQ(counters.medium_mismatches, 0u);
}

TEST(Walk, SurfacesInTheFaceOfALargeBoxAreMetFromOutsideAndNeverTwice) {
  // A tile in the lower face of a large turned box: rays down on it stop there, rays that leave it upwards are free.
  for (const float half : {2.0f, 50.0f, 500.0f}) {
    const Mat4d m = some_rotation();
    Scene scene;
    scene.media.push_back(make_medium(nullptr, Rgb(1e-9f)));
    const Interface media{0, kVacuum};
    add_shape(scene, turned(box_mesh(Vec3(-half, 0, -half), Vec3(half, 2 * half, half)), m), Boundary{}, &media);
    add_shape(scene, turned(quad_mesh(Vec3(-1, 0, 1), Vec3(2, 0, 0), Vec3(0, 0, -2)), m), Lambertian{});
    scene.geometry.commit();
    const Vec3 up(m * glm::dvec4(0, 1, 0, 0));
    int slipped = 0, again = 0;
    for (int i = 0; i < 2000; ++i) {
      Rng rng(1, rng_stream(RngUse::test, 0), static_cast<uint64_t>(i));
      const Vec3 on(m * glm::dvec4(1.8 * rng.uniform() - 0.9, 0.0, 1.8 * rng.uniform() - 0.9, 1.0));
      const Vec3 sideways(m * glm::dvec4(rng.uniform() - 0.5, 0.0, rng.uniform() - 0.5, 0.0));
      const Vec3 d = glm::normalize(up + 3.0f * sideways);
      const Encounter down = scene.geometry.encounter({on + 0.5f * d, -d});
      slipped += !down.surface;
      if (!down.surface) continue;
      const Encounter leaving = scene.geometry.encounter({leave_surface(down.hits[0], d), d});
      again += leaving.surface;
    }
    EXPECT_EQ(slipped, 0) << half;
    EXPECT_EQ(again, 0) << half;
  }
}

TEST(Walk, PhotonsOfALampAcrossABoundaryStartInTheirOwnMedium) {
  Scene scene;
  scene.media.push_back(make_medium(nullptr, Rgb(50.0f), 0.0f));
  const Interface media{0, kVacuum};
  add_shape(scene, box_mesh(Vec3(-1, -1, 0), Vec3(1, 1, 1)), Boundary{}, &media);
  scene.lights.push_back(QuadLight{Vec3(-0.3f, 0.0f, -0.5f), Vec3(0, 0, 1.0f), Vec3(0.6f, 0, 0), Rgb(1.0f)});
  scene.lights.push_back(QuadLight{Vec3(-0.3f, 0.0f, -0.5f), Vec3(0, 0, 0.3f), Vec3(0.6f, 0, 0), Rgb(1.0f)});
  scene.lights.push_back(QuadLight{Vec3(-0.3f, 0.0f, 0.2f), Vec3(0, 0, 0.3f), Vec3(0.6f, 0, 0), Rgb(1.0f)});
  scene.geometry.commit();
  finish(scene);
  EXPECT_EQ(scene.light_medium[0], kSeveralMedia);
  EXPECT_EQ(scene.light_medium[1], kVacuum);
  EXPECT_EQ(scene.light_medium[2], 0);
}

}  // namespace
}  // namespace vpm
