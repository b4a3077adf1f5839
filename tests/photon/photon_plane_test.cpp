// Crossings of planes and rays against their brute-force twin, and what planes are made of.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "support/scenes.h"
#include "vpm/base/warp.h"
#include "vpm/photon/photon_plane.h"

namespace vpm {
namespace {

std::vector<PhotonPlane> any_planes(int count) {
  std::vector<PhotonPlane> planes;
  Rng rng(7, rng_stream(RngUse::test, 21), 0);
  for (int i = 0; i < count; ++i) {
    PhotonPlane plane;
    plane.origin = Vec3(rng.uniform(), rng.uniform(), rng.uniform());
    plane.length = rng.uniform();
    plane.direction = uniform_sphere(rng.uniform2());
    plane.scattered = i % 100 == 0 ? plane.direction : uniform_sphere(rng.uniform2());  // some span no plane
    plane.power = Rgb(1.0f + static_cast<float>(i));
    planes.push_back(plane);
  }
  return planes;
}

/// The distances s, u, t with origin + s a + u b = ray(t), in doubles, and the volume of the directions.
struct Solution {
  double s, u, t, volume;
};
Solution cross(const PhotonPlane& plane, const Ray& ray) {
  const Vec3d a(plane.direction), b(plane.scattered), w(ray.direction), d = Vec3d(ray.origin) - Vec3d(plane.origin);
  const double volume = glm::dot(a, glm::cross(b, w));
  return {glm::dot(d, glm::cross(b, w)) / volume, glm::dot(a, glm::cross(d, w)) / volume,
          -glm::dot(a, glm::cross(b, d)) / volume, std::abs(volume)};
}

TEST(PhotonPlaneList, FindsTheCrossingsOfEveryPlane) {
  const std::vector<PhotonPlane> planes = any_planes(533);
  const PhotonPlaneList list(planes);
  ASSERT_EQ(list.size(), 533u);
  int met = 0;
  for (uint64_t i = 0; i < 100; ++i) {
    Rng rng(8, rng_stream(RngUse::test, 22), i);
    const Ray ray{Vec3(rng.uniform(), rng.uniform(), rng.uniform()), uniform_sphere(rng.uniform2())};
    const Interval interval{0.0f, i % 3 == 0 ? kInfinity : 0.5f + rng.uniform()};
    std::map<size_t, int> found;
    list.visit_crossings(ray, interval, [&](const PlaneCrossing& at) {
      const Solution exact = cross(at.plane, ray);
      const double error = 1e-5 / exact.volume;  // m, of floats
      EXPECT_NEAR(at.along_flight, exact.s, error * (1.0 + exact.s));
      EXPECT_NEAR(at.beyond, exact.u, error * (1.0 + exact.u));
      EXPECT_NEAR(at.t, exact.t, error * (1.0 + exact.t));
      EXPECT_NEAR(at.determinant, exact.volume, 1e-5);
      ++found[static_cast<size_t>(at.plane.power.g) - 1];
    });
    for (size_t p = 0; p < planes.size(); ++p) {
      const Solution exact = cross(planes[p], ray);
      const double inside = std::min({exact.s, double{planes[p].length} - exact.s, exact.u,
                                      exact.t - double{interval.t0}, double{interval.t1} - exact.t});
      met += found[p];
      const double error = 1e-5 / exact.volume * (1.0 + std::abs(exact.s) + std::abs(exact.u) + std::abs(exact.t));
      if (inside > error) {
        EXPECT_EQ(found[p], 1) << p;
      } else if (inside < -error || p % 100 == 0) {
        EXPECT_EQ(found[p], 0) << p;
      }
    }
  }
  EXPECT_GT(met, 1000);
}

// Every flight becomes a plane, in directions of its medium's phase function.
TEST(PhotonPlane, IsAFlightWithADirection) {
  Scene scene = boxed_medium(make_medium(nullptr, Rgb(1.0f)), PointLight{Vec3(0.0f), Rgb(1.0f)});
  scene.media.push_back(scene.media[0]);
  scene.media[1].phase = HenyeyGreenstein{0.9f};
  constexpr int kFlights = 10'000;
  const PhotonBeam flight{Vec3(1.0f, 2.0f, 3.0f), 0.5f, Vec3(1.0f, 0.0f, 0.0f), Rgb(2.0f)};
  Rng rng(1, rng_stream(RngUse::test, 23), 0);
  const std::vector<PhotonPlane> planes = planes_of({{flight}, std::vector(kFlights, flight)}, scene, 0.25f, rng);
  ASSERT_EQ(planes.size(), size_t{kFlights} + 1);
  double cosines = 0.0;
  for (size_t i = 1; i < planes.size(); ++i) cosines += static_cast<double>(planes[i].scattered.x);
  EXPECT_EQ(planes[0].medium, 0);
  EXPECT_EQ(planes[1].medium, 1);
  EXPECT_EQ(planes[1].origin, flight.origin);
  EXPECT_EQ(planes[1].length, 0.5f);
  EXPECT_EQ(planes[1].direction, flight.direction);
  EXPECT_EQ(planes[1].power, Rgb(0.5f));
  // The mean cosine is g; the standard deviation of one is below 0.25: six standard errors are one in 1e6 runs.
  EXPECT_NEAR(cosines / kFlights, 0.9, 6.0 * 0.25 / std::sqrt(double{kFlights}));
}

// Planes find light whose flight began at a collision: the recorder tells which did, and where.
TEST(BeamRecorder, KnowsTheCollisionThatAFlightBeganAt) {
  Scene scene = boxed_medium(make_medium(nullptr, Rgb(1.0f)), PointLight{Vec3(0.0f), Rgb(1.0f)});
  scene.media[0].sigma_s = Rgb(0.1f, 0.2f, 0.6f);
  BeamRecorder with(scene, any_photon, {.turns = true}), without(scene, any_photon, {});
  const PathState state;
  const Event event;
  const Turn turn{Vec3(0.6f, 0.0f, 0.8f), 0, 2.0f}, none;
  const Track track{{{Vec3(0.0f), Vec3(1.0f, 0.0f, 0.0f)}, {0.0f, 0.5f}, 0, Rgb(2.0f)}, 1.0f};
  Rng rng(1, rng_stream(RngUse::test, 24), 0);
  for (BeamRecorder* recorder : {&with, &without})
    for (const Turn* each : {&turn, &none})
      recorder->flew(track, {0, state, event, Vec3(0.0f), 1, 0, false, *each}, rng);
  EXPECT_FLOAT_EQ(with.beams[0][0].scattering_rate, 0.6f);  // the mean of the channels, at twice the density
  EXPECT_NEAR(glm::length(with.beams[0][0].turned_from.unpack() - turn.from), 0.0f, 1e-3f);
  for (const float rate : {with.beams[0][1].scattering_rate, without.beams[0][0].scattering_rate})
    EXPECT_EQ(rate, 0.0f);
}

}  // namespace
}  // namespace vpm
