// Where photons count for a segment of an eye ray: past its ends, within planes at borders, and what share of a tube is
// there.
#include "vpm/estimate/segment_region.h"

#include <gtest/gtest.h>

#include "support/scenes.h"
#include "vpm/photon/kernel.h"

namespace vpm {
namespace {

constexpr float kRadius = 0.3f;  // m, of kernels
const GatherSettings kDiscs{.radius = kRadius, .boundary = BoundaryRule::ends};

/// A body of a medium that hardly absorbs, in a vacuum.
template <class Body>
Scene body_of_fog(const Body& body) {
  Scene scene;
  scene.media.push_back(make_medium(nullptr, Rgb(1e-4f)));
  const Interface media{0, kVacuum};
  add_shape(scene, body, Boundary{}, &media);
  return scene;
}

void finish_lit(Scene& scene) {
  scene.lights.push_back(ConstantEnvironment{Rgb(1.0f)});
  scene.geometry.commit();
  finish(scene);
}

/// The segment of a ray that enters a body and leaves it again.
EyeSegment segment_through(const Scene& scene, const Ray& ray) {
  const Hit in = scene.geometry.intersect(ray).value();
  const Ray inside{leave_surface(in, ray.direction), ray.direction};
  const Hit out = scene.geometry.intersect(inside).value();
  return {scene, {inside, {0.0f, out.t}, 0}, {-in.normal, -out.normal}};
}

// Through a slab all lines parallel to the ray are alike: nothing is to be corrected, and light of a place passes as
// much of the slab as lies above it along its own line.
TEST(SegmentRegion, ASlabIsWholeAndSeenAlikeAlongParallelLines) {
  Scene scene = body_of_fog(box_mesh(Vec3d(-50, 0, -50), Vec3d(50, 1, 50)));
  finish_lit(scene);
  for (const float slope : {0.0f, 0.7f, 2.0f}) {
    const Vec3 down = glm::normalize(Vec3(slope, -1.0f, 0.3f * slope));
    const EyeSegment segment = segment_through(scene, {Vec3(0.0f, 3.0f, 0.0f), down});
    const SegmentRegion region(segment, kDiscs, Spread::discs);
    EXPECT_TRUE(region.whole()) << slope;
    const float tangent = slope * std::sqrt(1.09f);
    EXPECT_NEAR(region.reach().t0, -kRadius * tangent, 1e-4f);
    EXPECT_NEAR(region.reach().t1, segment.interval.t1 + kRadius * tangent, 1e-4f);
    for (const Vec3& place : {Vec3(0.2f, 0.9f, 0.1f), Vec3(-0.2f, 0.5f, 0.3f)}) {
      const Vec3 offset = place - segment.ray.origin;
      EXPECT_NEAR(region.distances().of(offset), (1.0f - place.y) / -down.y, 1e-4f);
      EXPECT_TRUE(region.within().hold(offset));
    }
    EXPECT_FALSE(region.within().hold(Vec3(0.0f, 1.01f, 0.0f) - segment.ray.origin));
    EXPECT_FALSE(region.within().hold(Vec3(0.0f, -0.01f, 0.0f) - segment.ray.origin));
  }
}

TEST(SegmentRegion, WithoutARuleItIsTheTubeBetweenTheEnds) {
  Scene scene = body_of_fog(SphereShape{Vec3(0.0f), 1.0f});
  finish_lit(scene);
  const EyeSegment segment = segment_through(scene, {Vec3(0.8f, 0.0f, 3.0f), Vec3(0.0f, 0.0f, -1.0f)});
  GatherSettings none = kDiscs;
  none.boundary = BoundaryRule::none;
  const SegmentRegion region(segment, none, Spread::discs);
  EXPECT_TRUE(region.whole());
  EXPECT_EQ(region.reach().t0, segment.interval.t0);
  EXPECT_EQ(region.reach().t1, segment.interval.t1);
  EXPECT_TRUE(region.within().hold(Vec3(0.9f, 0.0f, 0.9f) - segment.ray.origin));
  EXPECT_FLOAT_EQ(region.distances().of(Vec3(0.3f, 0.2f, -0.7f)), 0.7f);
}

/// The mean over a disc of that radius, by the kernel, of the length of chords of the unit sphere beside one at the
/// distance `b` from its center. They count as far as the reach of the region goes.
double mean_chord(double b, double reach, double radius) {
  const int rings = 200, turns = 200;
  double sum = 0.0, weights = 0.0;
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < turns; ++j) {
      const double q = (i + 0.5) / rings, distance = radius * std::sqrt(q), turn = 2.0 * kPiD * (j + 0.5) / turns;
      const double x = b + distance * std::cos(turn), y = distance * std::sin(turn), square = x * x + y * y;
      const double half = square < 1.0 ? std::sqrt(1.0 - square) : 0.0;
      sum += (1.0 - q) * 2.0 * std::min(half, reach);
      weights += 1.0 - q;
    }
  return sum / weights;
}

TEST(SegmentRegion, SharesInASphereAreThoseOfItsChords) {
  Scene scene = body_of_fog(SphereShape{Vec3(0.0f), 1.0f});
  finish_lit(scene);
  for (const float b : {0.0f, 0.3f, 0.6f, 0.8f, 0.95f, 0.99f}) {
    const EyeSegment segment = segment_through(scene, {Vec3(b, 0.0f, 3.0f), Vec3(0.0f, 0.0f, -1.0f)});
    const SegmentRegion region(segment, kDiscs, Spread::discs);
    EXPECT_FALSE(region.whole());
    const float length = segment.interval.t1;
    const SeenAlong seen(scene.media[0].sigma_t, segment.interval, nullptr);
    const double reach = 0.5 * length - region.reach().t0, exact = mean_chord(b, reach, kRadius) / length;
    constexpr double kStep = 0.075 * kRadius;
    const double slope = (mean_chord(b, reach, kRadius) - mean_chord(b, reach, kRadius - 2.0 * kStep)) / length;
    constexpr int kShares = 2000;
    double correction = 0.0;
    for (int i = 0; i < kShares; ++i) {
      const KernelEstimate share = region.share(kRadius, seen, Rng(1, 0, static_cast<uint64_t>(i)));
      EXPECT_NEAR(share.value.g, exact, 0.08 * exact) << b;  // by 16 lines
      correction += share.correction.g / kShares;
    }
    EXPECT_NEAR(correction, -slope * kRadius / (4.0 * kStep), 0.08) << b;
  }
}

// The floor beside a ray that does not meet it: photons beneath it do not count, and half of the tube or less is there.
TEST(SegmentRegion, AFloorBesideTheRayIsAPlane) {
  Scene scene;
  scene.media.push_back(make_medium(nullptr, Rgb(1e-4f)));
  scene.world_medium = 0;
  add_shape(scene, quad_mesh(Vec3(-5, 0, 5), Vec3(10, 0, 0), Vec3(0, 0, -10)), Lambertian{Rgb(0.5f)});
  finish_lit(scene);
  const Ray ray{Vec3(-2.0f, 1e-3f, 0.0f), Vec3(1.0f, 0.0f, 0.0f)};
  const EyeSegment segment(scene, {ray, {0.0f, 4.0f}, 0}, {Vec3(0.0f), Vec3(-1.0f, 0.0f, 0.0f)});
  const SegmentRegion region(segment, kDiscs, Spread::discs);
  EXPECT_FALSE(region.whole());
  EXPECT_TRUE(region.within().hold(Vec3(1.0f, 0.1f, 0.0f)));
  EXPECT_FALSE(region.within().hold(Vec3(1.0f, -0.1f, 0.0f)));
  Rng rng(1, 0, 0);
  const SeenAlong seen(scene.media[0].sigma_t, segment.interval, nullptr);
  EXPECT_NEAR(region.share(kRadius, seen, rng).value.g, 0.5f, 0.02f);
}

/// The part of a cylinder about a ray that a ball takes away, weighted by the kernel; `closest` is the ray's distance
/// from the ball's center.
double taken_by_ball(double closest, double ball, double radius, double length) {
  const int rings = 200, turns = 200;
  double sum = 0.0, weights = 0.0;
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < turns; ++j) {
      const double q = (i + 0.5) / rings, distance = radius * std::sqrt(q), turn = 2.0 * kPiD * (j + 0.5) / turns;
      const double x = closest + distance * std::cos(turn), y = distance * std::sin(turn);
      const double square = x * x + y * y, chord = square < ball * ball ? 2.0 * std::sqrt(ball * ball - square) : 0.0;
      sum += (1.0 - q) * chord;
      weights += 1.0 - q;
    }
  return sum / weights / length;
}

// A ball beside the ray takes chords of lines away, not whole lines, though these lie inside it where they pass the
// middle of the segment: an opaque ball, and one of glass with a vacuum inside.
TEST(SegmentRegion, ABallBesideTheRayTakesItsChordsAway) {
  for (const bool glass : {false, true}) {
    Scene scene;
    scene.media.push_back(make_medium(nullptr, Rgb(1e-4f)));
    scene.world_medium = 0;
    constexpr float kBall = 0.5f, kLength = 4.0f, kClosest = 0.55f;  // m
    const Interface vacuum_inside{kVacuum, 0};
    if (glass)
      add_shape(scene, SphereShape{Vec3(0.0f), kBall}, Dielectric{1.5f}, &vacuum_inside);
    else
      add_shape(scene, SphereShape{Vec3(0.0f), kBall}, Lambertian{Rgb(0.5f)});
    finish_lit(scene);
    const Ray ray{Vec3(kClosest, 0.0f, 0.5f * kLength + 0.1f), Vec3(0.0f, 0.0f, -1.0f)};
    const EyeSegment segment(scene, {ray, {0.0f, kLength}, 0}, {});
    const SegmentRegion region(segment, kDiscs, Spread::discs);
    EXPECT_FALSE(region.whole());
    Rng rng(1, 0, 0);
    const SeenAlong seen(scene.media[0].sigma_t, segment.interval, nullptr);
    const double exact = 1.0 - taken_by_ball(kClosest, kBall, kRadius, kLength);
    EXPECT_NEAR(region.share(kRadius, seen, rng).value.g, exact, 0.01) << glass;
  }
}

TEST(Mirrored, IsThePlaceItselfOrItsImageAtAnEnd) {
  const Mirrored mirrored{1.0f, 3.0f};
  EXPECT_FLOAT_EQ(mirrored(1.25f), 1.25f);
  EXPECT_FLOAT_EQ(mirrored(0.5f), 1.5f);
  EXPECT_FLOAT_EQ(mirrored(3.5f), 2.5f);
  EXPECT_FLOAT_EQ((Mirrored{0.0f, kInfinity}(7.0f)), 7.0f);
}

// Past an end as much is seen as before it.
TEST(SeenAlong, GoesOnPastTheEndsAsIfMirrored) {
  const SeenAlong seen(Rgb(2.0f), {1.0f, 3.0f}, nullptr);
  EXPECT_NEAR(seen.whole().g, -std::expm1(-4.0) / 2.0, 1e-9);
  EXPECT_NEAR(seen.to(0.6).g, -seen.to(1.4).g, 1e-9);
  EXPECT_NEAR(seen.to(3.4).g - seen.whole().g, seen.whole().g - seen.to(2.6).g, 1e-9);
}

}  // namespace
}  // namespace vpm
