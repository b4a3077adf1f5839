// Crossings of planes and rays against their brute-force twin, and what is recorded as a plane.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "support/scenes.h"
#include "vpm/base/warp.h"
#include "vpm/photon/photon_plane_list.h"

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
  const std::vector<std::vector<PhotonPlane>> by_medium{any_planes(500), {}, any_planes(33)};
  const PhotonPlaneList list(by_medium, 0.5f);
  ASSERT_EQ(list.size(), 533u);
  int met = 0;
  for (uint64_t i = 0; i < 100; ++i) {
    Rng rng(8, rng_stream(RngUse::test, 22), i);
    const Ray ray{Vec3(rng.uniform(), rng.uniform(), rng.uniform()), uniform_sphere(rng.uniform2())};
    const Interval interval{0.0f, i % 3 == 0 ? kInfinity : 0.5f + rng.uniform()};
    std::map<std::pair<MediumId, int>, int> found;
    list.visit_crossings(ray, interval, [&](const PlaneCrossing& at) {
      const Solution exact = cross(at.plane, ray);
      const double error = 1e-5 / exact.volume;  // m, of floats
      EXPECT_NEAR(at.along_flight, exact.s, error * (1.0 + exact.s));
      EXPECT_NEAR(at.beyond, exact.u, error * (1.0 + exact.u));
      EXPECT_NEAR(at.t, exact.t, error * (1.0 + exact.t));
      EXPECT_NEAR(at.determinant, exact.volume, 1e-5);
      ++found[{at.medium, static_cast<int>(2.0f * at.plane.power.g) - 1}];
    });
    for (MediumId m = 0; m < 3; ++m)
      for (size_t p = 0; p < by_medium[m].size(); ++p) {
        const Solution exact = cross(by_medium[m][p], ray);
        const double inside = std::min({exact.s, double{by_medium[m][p].length} - exact.s, exact.u,
                                        exact.t - double{interval.t0}, double{interval.t1} - exact.t});
        const int times = found[{m, static_cast<int>(p)}];
        met += times;
        const double error = 1e-5 / exact.volume * (1.0 + std::abs(exact.s) + std::abs(exact.u) + std::abs(exact.t));
        if (inside > error) {
          EXPECT_EQ(times, 1) << m << " " << p;
        } else if (inside < -error || p % 100 == 0) {
          EXPECT_EQ(times, 0) << m << " " << p;
        }
      }
  }
  EXPECT_GT(met, 1000);
}

// A flight becomes a plane whatever becomes of the photon; not where nothing scatters.
TEST(PlaneRecorder, RecordsEveryFlightThroughWhatScatters) {
  Scene scene = boxed_medium(make_medium(nullptr, Rgb(1.0f)), PointLight{Vec3(0.0f), Rgb(1.0f)});
  scene.media[0].phase = HenyeyGreenstein{0.9f};
  Medium absorbing = make_medium(nullptr, Rgb(1.0f));
  absorbing.sigma_s = Rgb(0.0f);
  scene.media.push_back(absorbing);
  PlaneRecorder recorder(scene);
  const PathState state;
  const Turn turn;
  const Track along{{Vec3(0.0f), Vec3(1.0f, 0.0f, 0.0f)}, 0, 0.5f, 1.0f, Rgb(2.0f)};
  Rng rng(1, rng_stream(RngUse::test, 23), 0);
  double cosines = 0.0;
  constexpr int kFlights = 4000;
  for (int i = 0; i < kFlights; ++i)
    for (const EventKind kind : {EventKind::collision, EventKind::surface, EventKind::escape}) {
      Event event;
      event.kind = kind;
      recorder.flew(along, {0, state, event, true, true, false, turn}, rng);
      cosines += static_cast<double>(recorder.planes[0].back().scattered.x);
    }
  const Event event;
  Track other = along;
  other.medium = 1;
  recorder.flew(other, {0, state, event, true, true, false, turn}, rng);
  ASSERT_EQ(recorder.planes[0].size(), size_t{3 * kFlights});
  EXPECT_TRUE(recorder.planes[1].empty());
  EXPECT_EQ(recorder.planes[0][0].length, 0.5f);
  EXPECT_EQ(recorder.planes[0][0].power, Rgb(2.0f));
  // The mean cosine is g; the standard deviation of one is below 0.25: six standard errors are one in 1e6 runs.
  EXPECT_NEAR(cosines / (3 * kFlights), 0.9, 6.0 * 0.25 / std::sqrt(3.0 * kFlights));
}

}  // namespace
}  // namespace vpm
