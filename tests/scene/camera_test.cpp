// The camera's rays and the pixel filters.
#include "vpm/scene/camera.h"

#include <gtest/gtest.h>

#include "support/statistics.h"
#include "vpm/base/error.h"
#include "vpm/base/rng.h"

namespace vpm {
namespace {

Vec3 towards(const Vec3& v) { return glm::normalize(v); }

TEST(Camera, CornersSpanTheFieldOfView) {
  // 90 degrees high, twice as wide: the corners lie at (+-2, +-1) one metre ahead.
  const Camera camera = make_camera({1, 2, 3}, {1, 2, -5}, {0, 7, 0}, 90.0f, {200, 100});
  EXPECT_EQ(camera.ray({0, 0}).origin, Vec3(1, 2, 3));
  EXPECT_LT(glm::length(camera.ray({0, 0}).direction - towards({-2, 1, -1})), 1e-6f);
  EXPECT_LT(glm::length(camera.ray({200, 0}).direction - towards({2, 1, -1})), 1e-6f);
  EXPECT_LT(glm::length(camera.ray({0, 100}).direction - towards({-2, -1, -1})), 1e-6f);
  EXPECT_LT(glm::length(camera.ray({200, 100}).direction - towards({2, -1, -1})), 1e-6f);
  EXPECT_LT(glm::length(camera.ray({100, 50}).direction - towards({0, 0, -1})), 1e-6f);
  // A portrait: the field of view is still the vertical one.
  const Camera portrait = make_camera({0, 0, 0}, {3, 0, 0}, {0, 0, 1}, 90.0f, {50, 100});
  EXPECT_LT(glm::length(portrait.ray({0, 0}).direction - towards({1, 0.5f, 1})), 1e-6f);
}

TEST(Camera, AxesAreOrthonormalAndRightHanded) {
  const Camera c = make_camera({1, 2, 3}, {-4, 0.5f, 9}, {0.1f, 1, 0.3f}, 40.0f, {64, 48});
  EXPECT_NEAR(glm::length(c.forward), 1.0f, 1e-6f);
  EXPECT_LT(glm::length(glm::cross(c.right, c.up) + c.forward), 1e-6f);
  EXPECT_LT(glm::length(glm::cross(c.up, c.forward) + c.right), 1e-6f);
  EXPECT_GT(glm::dot(c.up, Vec3(0.1f, 1, 0.3f)), 0.0f);
}

TEST(Camera, RefusesWhatIsNoCamera) {
  const Vec3 o(0), z(0, 0, -1), y(0, 1, 0);
  EXPECT_THROW(make_camera(o, o, y, 40, {8, 8}), InputError);
  EXPECT_THROW(make_camera(o, z, z, 40, {8, 8}), InputError);
  EXPECT_THROW(make_camera(o, z, o, 40, {8, 8}), InputError);
  EXPECT_THROW(make_camera(o, z, y, 0, {8, 8}), InputError);
  EXPECT_THROW(make_camera(o, z, y, 180, {8, 8}), InputError);
  EXPECT_THROW(make_camera(o, z, y, 40, {0, 8}), InputError);
  EXPECT_THROW(make_camera(o, z, y, 40, {8, kLargestFilm + 1}), InputError);
  EXPECT_THROW(make_camera(o, z, y, 40, {8, 8, {FilterKind::box, 0.0f}}), InputError);
  EXPECT_THROW(make_camera(o, {0, 0, kInfinity}, y, 40, {8, 8}), InputError);
}

TEST(Camera, FindsThePlaceOfTheFilmThatADirectionMeets) {
  const Camera camera = make_camera({1, 2, 3}, {-4, 0.5f, 9}, {0.1f, 1, 0.3f}, 70.0f, {64, 48});
  for (const Vec2& film : {Vec2(0.0f), Vec2(64, 48), Vec2(12.3f, 40.1f)}) {
    const std::optional<Vec2> found = camera.film_of(camera.ray(film).direction);
    ASSERT_TRUE(found);
    EXPECT_LT(glm::length(*found - film), 2e-5f);
  }
  EXPECT_FALSE(camera.film_of(-camera.forward));
}

TEST(Camera, FilmPerAngleSumsToTheSolidAngleOfTheFilm) {
  // Of a rectangle of half the sides a and b at the distance 1: 4 atan(a b / sqrt(1 + a^2 + b^2)).
  const Camera camera = make_camera(Vec3(0.0f), {0, 0, -1}, {0, 1, 0}, 90.0f, {300, 200});
  double sum = 0.0;
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 300; ++x) sum += 1.0 / camera.film_per_angle(camera.ray(Vec2(x, y) + 0.5f).direction);
  EXPECT_NEAR(sum, 4.0 * std::atan(1.5 / std::sqrt(1.0 + 1.5 * 1.5 + 1.0)), 1e-4);
}

/// The cumulative distribution of one coordinate at x in [-1, 1], in radii.
double cumulative(FilterKind kind, double x) {
  if (kind == FilterKind::box) return 0.5 * (x + 1.0);
  if (kind == FilterKind::tent) return x < 0.0 ? 0.5 * (1.0 + x) * (1.0 + x) : 1.0 - 0.5 * (1.0 - x) * (1.0 - x);
  return 0.5 * (1.0 + std::erf(3.0 * x / std::sqrt(2.0)) / std::erf(3.0 / std::sqrt(2.0)));
}

TEST(Filter, ItsValueIsTheDerivativeOfItsCumulativeDistribution) {
  constexpr double kStep = 1e-3;
  for (const FilterKind kind : {FilterKind::box, FilterKind::tent, FilterKind::gaussian}) {
    const Filter filter{kind, 1.5f};
    const auto density = [&](double x) {
      return (cumulative(kind, (x + kStep) / 1.5) - cumulative(kind, (x - kStep) / 1.5)) / (2.0 * kStep);
    };
    for (const Vec2& x : {Vec2(0.3f, -0.7f), Vec2(-1.4f, 1.2f), Vec2(0.1f, 0.9f)})
      EXPECT_NEAR(filter_value(filter, x) / (density(x.x) * density(x.y)), 1.0, 1e-4);
    EXPECT_EQ(filter_value(filter, {1.51f, 0.0f}), 0.0);
  }
}

TEST(Filter, InvertsItsCumulativeDistribution) {
  for (const FilterKind kind : {FilterKind::box, FilterKind::tent, FilterKind::gaussian}) {
    const Filter filter{kind, 1.5f};
    for (int i = 0; i < 4096; ++i) {
      const Vec2 u(static_cast<float>(i) / 4096.0f, 1.0f - static_cast<float>(i + 1) / 4096.0f);
      const Vec2 x = sample_filter(filter, u);
      ASSERT_LE(std::abs(x.x), 1.5f);
      ASSERT_NEAR(cumulative(kind, x.x / 1.5), u.x, 3e-7);
      ASSERT_NEAR(cumulative(kind, x.y / 1.5), u.y, 3e-7);
    }
    EXPECT_LE(std::abs(sample_filter(filter, {0x1.fffffep-1f, 0x1.fffffep-1f}).x), 1.5f);
  }
}

// Mean 0, and the known variance per radius squared. False-alarm rate 1e-5 for each of 9.
TEST(Filter, HasItsMoments) {
  const double e = std::erf(3.0 / std::sqrt(2.0));
  const double gaussian = (1.0 - 6.0 * std::exp(-4.5) / (std::sqrt(2.0 * kPiD) * e)) / 9.0;
  const std::pair<FilterKind, double> kinds[] = {
      {FilterKind::box, 1.0 / 3.0}, {FilterKind::tent, 1.0 / 6.0}, {FilterKind::gaussian, gaussian}};
  for (const auto& [kind, variance] : kinds) {
    Rng rng(5, static_cast<uint64_t>(RngUse::test), static_cast<uint64_t>(kind));
    Moments mean, square, product;
    for (int i = 0; i < 200000; ++i) {
      const Vec2 x = sample_filter({kind, 2.0f}, rng.uniform2());
      mean.add(x.x);
      square.add(x.y * x.y);
      product.add(x.x * x.y);
    }
    expect_mean(mean, 0.0, 1e-5, "mean");
    expect_mean(square, 4.0 * variance, 1e-5, "variance");
    expect_mean(product, 0.0, 1e-5, "covariance");
  }
}

}  // namespace
}  // namespace vpm
