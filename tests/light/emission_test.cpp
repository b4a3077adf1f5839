// Emission of photons: exact power, exact density of places and directions, and agreement with sample_towards().
#include <gtest/gtest.h>

#include "light/lights.h"
#include "support/statistics.h"
#include "vpm/base/error.h"
#include "vpm/base/tails.h"
#include "vpm/base/warp.h"
#include "vpm/surface/mesh.h"

namespace vpm {
namespace {

int cell(double x, int cells) { return std::min(cells - 1, static_cast<int>(x * cells)); }
std::vector<double> even(int cells) { return std::vector<double>(cells, 1.0 / cells); }
double azimuth_share(const Vec3& d, const Vec3& axis) {
  Vec3 s, t;
  make_frame(axis, s, t);
  return std::atan2(glm::dot(d, t), glm::dot(d, s)) / (2.0 * kPiD) + 0.5;
}

TEST(Emission, PowerIsTheClosedForm) {
  const Box scene{{-1, -2, 0}, {1, 2, 3}};  // faces of 12, 6 and 8 m^2
  const auto red = [&](const Light& light) { return light_power(light, scene).r; };
  EXPECT_FLOAT_EQ(red(PointLight{{}, Rgb(3)}), 12.0f * kPi);
  // Cones of 60 and 90 degrees: 2 pi I (1 - (1/2 + 0) / 2).
  EXPECT_FLOAT_EQ(red(SpotLight{{}, {0, -1, 0}, 0.5f, 0.0f, Rgb(2)}), 3.0f * kPi);
  EXPECT_FLOAT_EQ(red(SpotLight{{}, {0, -1, 0}, 0.5f, 0.5f, Rgb(2)}), 2.0f * kPi);
  EXPECT_FLOAT_EQ(red(BeamLight{{}, {0, -1, 0}, 0.1f, Rgb(5)}), 5.0f);
  EXPECT_FLOAT_EQ(red(QuadLight{{}, {2, 0, 0}, {1, 3, 0}, Rgb(2)}), 12.0f * kPi);
  EXPECT_FLOAT_EQ(red(SphereLight{{}, 0.5f, Rgb(2)}), 2.0f * kPi * kPi);
  EXPECT_FLOAT_EQ(red(DiscLight{{}, {0, -1, 0}, 0.5f, Rgb(2)}), 0.5f * kPi * kPi);
  const TriangleMesh box = box_mesh(Vec3d(0.0), Vec3d(1, 2, 3));
  EXPECT_FLOAT_EQ(red(MeshLight{std::make_shared<const EmittingMesh>(box), Rgb(2)}), 44.0f * kPi);
  EXPECT_FLOAT_EQ(red(DirectionalLight{{0, -1, 0}, Rgb(2)}), 12.0f);
  EXPECT_FLOAT_EQ(red(DirectionalLight{{0.6f, 0, -0.8f}, Rgb(2)}), 2.0f * (0.6f * 12 + 0.8f * 8));
  EXPECT_FLOAT_EQ(red(ConstantEnvironment{Rgb(2)}), 2.0f * kPi * 52.0f);
  const EnvironmentMap constant{std::make_shared<const ImageEnvironment>(5, 3, std::vector<Rgb>(15, Rgb(2)))};
  EXPECT_FLOAT_EQ(red(constant), 2.0f * kPi * 52.0f);
}

// Of a picture of odd numbers of rows and columns, whose texels lie across the axes: the area that the box shows,
// integrated over the directions by the midpoint rule.
TEST(Emission, PowerOfAMapIsTheIntegralOfTheAreaShown) {
  std::vector<Rgb> texels;
  for (int i = 0; i < 35; ++i) texels.emplace_back(static_cast<float>((7 * i) % 11) + 0.5f, i % 3, 1.0f);
  const EnvironmentMap map{std::make_shared<const ImageEnvironment>(7, 5, texels)};
  const Vec3d e(kScene.extent()), faces(e.y * e.z, e.z * e.x, e.x * e.y);
  Rgbd power(0.0);
  constexpr int kRows = 1000, kColumns = 1400;
  for (int r = 0; r < kRows; ++r) {
    for (int c = 0; c < kColumns; ++c) {
      const double theta = (r + 0.5) * kPiD / kRows, phi = (c + 0.5) * 2.0 * kPiD / kColumns;
      const Vec3d d(std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi));
      const double solid_angle = std::sin(theta) * kPiD / kRows * 2.0 * kPiD / kColumns;
      power += Rgbd(texels[r / 200 * 7 + c / 200]) * glm::dot(glm::abs(d), faces) * solid_angle;
    }
  }
  const Rgb stated = light_power(map, kScene);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(stated[c] / power[c], 1.0, 1e-5) << "channel " << c;
}

// False-alarm rate 1e-5 per channel of the one light whose photons differ.
TEST(Emission, EveryPhotonCarriesThePowerAndThatOfAMapInTheMean) {
  for (const Light& light : test_lights()) {
    Rng rng = test_rng(light.index());
    const Rgb power = light_power(light, kScene);
    Moments carried[3];
    for (int i = 0; i < 20000; ++i) {
      const Emission e = emit(light, kScene, rng);
      ASSERT_NEAR(glm::length(e.ray.direction), 1.0f, 1e-6f);
      ASSERT_TRUE(e.power == power || std::holds_alternative<EnvironmentMap>(light)) << light.index();
      for (int c = 0; c < 3; ++c) carried[c].add(e.power[c]);
    }
    if (!std::holds_alternative<EnvironmentMap>(light)) continue;
    for (int c = 0; c < 3; ++c) expect_mean(carried[c], power[c], 1e-5);
  }
}

// The flux through a small disc, from emitted photons that cross it and from sample_towards() at its points, agree, on
// either side of it. False-alarm rate 1e-5 for each light and side.
TEST(Emission, AgreesWithSampleTowards) {
  const Vec3 centre(0.3f, 0.1f, 0.4f), normal = glm::normalize(Vec3(0.3f, 0.9f, 0.2f));
  constexpr float kRadius = 0.5f;
  for (const Light& light : test_lights()) {
    Rng rng = test_rng(100 + light.index());
    Moments emitted[2], arriving[2];
    for (int i = 0; i < 200000; ++i) {
      const Emission e = emit(light, kScene, rng);
      const float cosine = glm::dot(normal, e.ray.direction);
      const float t = glm::dot(normal, centre - e.ray.origin) / cosine;
      const bool through = t > 0.0f && glm::length(e.ray.at(t) - centre) < kRadius;
      for (const int front : {0, 1}) emitted[front].add(through && (cosine < 0.0f) == (front == 1) ? e.power.r : 0.0);
    }
    Vec3 s, t;
    make_frame(normal, s, t);
    for (int i = 0; i < 50000; ++i) {
      const Vec2 p = kRadius * uniform_disc(rng.uniform2());
      const auto incident = sample_towards(light, centre + p.x * s + p.y * t, rng);
      const double cosine = incident ? glm::dot(normal, incident->direction) : 0.0;
      const double flux = incident ? incident->irradiance.r * std::abs(cosine) * kPiD * kRadius * kRadius : 0.0;
      for (const int front : {0, 1}) arriving[front].add((cosine > 0.0) == (front == 1) ? flux : 0.0);
    }
    for (const int front : {0, 1}) {
      const double difference = emitted[front].mean() - arriving[front].mean();
      const double error = std::sqrt(emitted[front].variance_of_mean() + arriving[front].variance_of_mean());
      EXPECT_LE(std::abs(difference), normal_quantile(1e-5) * error)
          << "kind " << light.index() << ", side " << front << ": " << emitted[front].mean() << " and "
          << arriving[front].mean();
    }
    EXPECT_GT(emitted[0].mean() + emitted[1].mean(), 0.0)
        << "kind " << light.index() << " must light the disc for this to be a test";
  }
}

// False-alarm rate 1e-5 for each of the chi-square tests below.
TEST(Emission, OfASpotFollowsItsFalloff) {
  const SpotLight spot{{1, 2, 3}, glm::normalize(Vec3(1, -2, 0.5f)), 0.8f, 0.3f, Rgb(1)};
  Rng rng = test_rng(200);
  constexpr int kCells = 40;
  std::vector<double> counts(kCells, 0.0), expected, around(16, 0.0);
  // The falloff's integral over the cosine from the outer cone up, x = (cos - outer) / (inner - outer): x^3 - x^4 / 2
  // there.
  const auto integral = [](double cosine) {
    const double x = std::min(1.0, (cosine - 0.3) / 0.5);
    return 0.5 * (x * x * x - 0.5 * x * x * x * x) + std::max(0.0, cosine - 0.8);
  };
  for (int i = 0; i < kCells; ++i) {
    const double step = 0.7 / kCells;
    expected.push_back((integral(0.3 + (i + 1) * step) - integral(0.3 + i * step)) / integral(1.0));
  }
  for (int i = 0; i < 200000; ++i) {
    const Emission e = emit(spot, kScene, rng);
    EXPECT_EQ(e.ray.origin, spot.position);
    const float cosine = glm::dot(e.ray.direction, spot.direction);
    ASSERT_GE(cosine, 0.3f - 1e-6f);
    counts[cell(std::max(0.0f, cosine - 0.3f) / 0.7, kCells)] += 1.0;
    around[cell(azimuth_share(e.ray.direction, spot.direction), 16)] += 1.0;
  }
  expect_distribution(counts, expected, 1e-5, "cosine");
  expect_distribution(around, even(16), 1e-5, "azimuth");
}

TEST(Emission, OfAPointIsUniform) {
  Rng rng = test_rng(201);
  std::vector<double> counts(64, 0.0);
  for (int i = 0; i < 100000; ++i) {
    const Vec3 d = emit(PointLight{}, kScene, rng).ray.direction;
    counts[8 * cell(0.5 * (1.0 + d.z), 8) + cell(azimuth_share(d, {0, 0, 1}), 8)] += 1.0;
  }
  expect_distribution(counts, even(64), 1e-5);
}

TEST(Emission, OfAnObliqueQuadIsUniformOverItAndCosineAboutItsNormal) {
  const QuadLight quad{{1, 2, 3}, {2, 0, 0}, {1, 0, -3}, Rgb(1)};  // normal +y
  Rng rng = test_rng(202);
  std::vector<double> place(64, 0.0), cosine(16, 0.0), around(16, 0.0);
  for (int i = 0; i < 100000; ++i) {
    const Ray ray = emit(quad, kScene, rng).ray;
    ASSERT_GT(ray.origin.y, 2.0f);
    ASSERT_LT(ray.origin.y, 2.00001f);
    const float v = (ray.origin.z - 3.0f) / -3.0f, u = (ray.origin.x - 1.0f - v) / 2.0f;
    place[8 * cell(u, 8) + cell(v, 8)] += 1.0;
    ASSERT_GT(ray.direction.y, 0.0f);
    cosine[cell(ray.direction.y * ray.direction.y, 16)] += 1.0;
    around[cell(azimuth_share(ray.direction, {0, 1, 0}), 16)] += 1.0;
  }
  expect_distribution(place, even(64), 1e-5, "place");
  expect_distribution(cosine, even(16), 1e-5, "cosine");
  expect_distribution(around, even(16), 1e-5, "azimuth");
}

TEST(Emission, OfADiscIsUniformOverItAndCosineAboutItsNormal) {
  const DiscLight disc{{1, 2, 3}, glm::normalize(Vec3(1, -2, 0.5f)), 0.5f, Rgb(1)};
  Rng rng = test_rng(205);
  std::vector<double> place(64, 0.0), cosine(16, 0.0), around(16, 0.0);
  for (int i = 0; i < 100000; ++i) {
    const Ray ray = emit(disc, kScene, rng).ray;
    const Vec3 d = (ray.origin - disc.centre) / disc.radius;
    ASSERT_GT(glm::dot(d, disc.normal), -1e-6f);
    ASSERT_LT(glm::dot(d, disc.normal), 1e-5f);
    place[8 * cell(glm::dot(d, d), 8) + cell(azimuth_share(d, disc.normal), 8)] += 1.0;
    const float c = glm::dot(ray.direction, disc.normal);
    ASSERT_GT(c, -1e-6f);
    cosine[cell(c * c, 16)] += 1.0;
    around[cell(azimuth_share(ray.direction, disc.normal), 16)] += 1.0;
  }
  expect_distribution(place, even(64), 1e-5, "place");
  expect_distribution(cosine, even(16), 1e-5, "cosine");
  expect_distribution(around, even(16), 1e-5, "azimuth");
}

// A box whose faces have unequal areas, one of its triangles without any.
TEST(Emission, OfAMeshIsUniformOverItsAreaAndCosineOutward) {
  TriangleMesh mesh = box_mesh(Vec3d(0.0), Vec3d(1, 2, 3));
  mesh.triangles.insert(mesh.triangles.begin() + 3, glm::uvec3(0, 1, 1));
  const MeshLight light{std::make_shared<const EmittingMesh>(mesh), Rgb(1)};
  Rng rng = test_rng(206);
  std::vector<double> place(6 * 16, 0.0), expected, cosine(16, 0.0);
  for (int face = 0; face < 6; ++face)
    expected.insert(expected.end(), 16, (face / 2 == 0 ? 6.0 : face / 2 == 1 ? 3.0 : 2.0) / 22.0 / 16.0);
  for (int i = 0; i < 100000; ++i) {
    const Ray ray = emit(light, kScene, rng).ray;
    const Vec3 p = ray.origin / Vec3(1, 2, 3), off = glm::max(-p, p - 1.0f);  // > 0 where outside
    const int axis = off.x > off.y ? (off.x > off.z ? 0 : 2) : off.y > off.z ? 1 : 2;
    ASSERT_GT(off[axis], 0.0f);
    ASSERT_LT(off[axis], 1e-5f);
    const bool upper = p[axis] > 0.5f;
    place[(2 * axis + upper) * 16 + 4 * cell(std::max(0.0f, p[(axis + 1) % 3]), 4) +
          cell(std::max(0.0f, p[(axis + 2) % 3]), 4)] += 1.0;
    const float c = upper ? ray.direction[axis] : -ray.direction[axis];
    ASSERT_GT(c, 0.0f);
    cosine[cell(c * c, 16)] += 1.0;
  }
  expect_distribution(place, expected, 1e-5, "place");
  expect_distribution(cosine, even(16), 1e-5, "cosine");
  EXPECT_THROW(EmittingMesh(TriangleMesh{{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, {{0, 1, 2}}}), InputError);
}

TEST(Emission, OfASphereIsUniformOverItAndCosineOutward) {
  const SphereLight sphere{{10, -20, 5}, 0.5f, Rgb(1)};
  Rng rng = test_rng(203);
  std::vector<double> place(64, 0.0), cosine(16, 0.0);
  for (int i = 0; i < 100000; ++i) {
    const Ray ray = emit(sphere, kScene, rng).ray;
    const Vec3 normal = (ray.origin - sphere.centre) / sphere.radius;
    ASSERT_NEAR(glm::length(normal), 1.0f, 3e-5f);
    place[8 * cell(0.5 * (1.0 + normal.z), 8) + cell(azimuth_share(normal, {0, 0, 1}), 8)] += 1.0;
    const float c = glm::dot(normal, ray.direction);
    ASSERT_GT(c, -1e-5f);
    cosine[cell(c * c, 16)] += 1.0;
  }
  expect_distribution(place, even(64), 1e-5, "place");
  expect_distribution(cosine, even(16), 1e-5, "cosine");
}

TEST(Emission, OfABeamFillsItsDisc) {
  const BeamLight beam{{1, 2, 3}, {0, 0, -1}, 0.25f, Rgb(1)};
  Rng rng = test_rng(204);
  std::vector<double> counts(64, 0.0);
  for (int i = 0; i < 100000; ++i) {
    const Ray ray = emit(beam, kScene, rng).ray;
    EXPECT_EQ(ray.direction, beam.direction);
    const Vec3 d = (ray.origin - beam.position) / beam.radius;
    ASSERT_EQ(d.z, 0.0f);
    ASSERT_LT(glm::length(d), 1.000002f);
    counts[8 * cell(glm::dot(d, d), 8) + cell(azimuth_share(d, {0, 0, 1}), 8)] += 1.0;
  }
  expect_distribution(counts, even(64), 1e-5);
}

TEST(Emission, FromInfinityStartsOutsideTheSceneAndEntersIt) {
  for (const Light& light : test_lights()) {
    if (!is_infinite(light)) continue;
    Rng rng = test_rng(300 + light.index());
    for (int i = 0; i < 10000; ++i) {
      const Ray ray = emit(light, kScene, rng).ray;
      int faces = 0;  // that the photon starts on and leaves inwards
      for (int a = 0; a < 3; ++a) {
        ASSERT_TRUE(kScene.lo[a] <= ray.origin[a] && ray.origin[a] <= kScene.hi[a]);
        faces += ray.origin[a] == (ray.direction[a] > 0.0f ? kScene.lo[a] : kScene.hi[a]) ? 1 : 0;
      }
      ASSERT_GE(faces, 1);
    }
  }
}

// Light across a plate without thickness comes through its two sides only, and light along it does not arrive.
TEST(Emission, FromInfinityEntersAPlate) {
  const Box plate{{-1, 2, -1}, {1, 2, 1}};
  Rng rng = test_rng(301);
  for (const Light& light : test_lights()) {
    if (!is_infinite(light)) continue;
    for (int i = 0; i < 1000; ++i) {
      const Ray ray = emit(light, plate, rng).ray;
      ASSERT_EQ(ray.origin.y, 2.0f);
      ASSERT_TRUE(is_finite(ray.origin) && is_finite(ray.direction));
    }
  }
  EXPECT_EQ(light_power(DirectionalLight{{1, 0, 0}, Rgb(2)}, plate), Rgb(0));
  EXPECT_FLOAT_EQ(light_power(ConstantEnvironment{Rgb(2)}, plate).r, 16.0f * kPi);
}

// A million photons of area lights that are shapes of the scene, near the origin and far from it, small and large.
TEST(Emission, NeverMeetsItsOwnEmitter) {
  Rng rng = test_rng(400);
  for (int k = 0; k < 1000; ++k) {
    const float away = std::pow(10.0f, -4.0f + 10.0f * rng.uniform());
    const float size = std::max(std::pow(10.0f, -4.0f + 10.0f * rng.uniform()), 1e-5f * away);
    const Vec3 corner = away * uniform_sphere(rng.uniform2());
    const Vec3 u = size * uniform_sphere(rng.uniform2()), v = size * uniform_sphere(rng.uniform2());
    Geometry quad;
    quad.add(TriangleMesh{{corner, corner + u, corner + u + v, corner + v}, {{0, 1, 2}, {0, 2, 3}}});
    quad.commit();
    Geometry mesh;  // a box, which is met no more from any of its faces
    const TriangleMesh box = box_mesh(Vec3d(corner), Vec3d(corner + size * Vec3(1.0f, 0.5f, 0.7f)));
    const MeshLight mesh_light{std::make_shared<const EmittingMesh>(box), Rgb(1)};
    mesh.add(box);
    mesh.commit();
    Geometry disc;
    const DiscLight disc_light{corner, glm::normalize(glm::cross(u, v)), size, Rgb(1)};
    disc.add(DiscShape{disc_light.centre, disc_light.normal, disc_light.radius});
    disc.commit();
    Geometry sphere;
    sphere.add(SphereShape{corner, size});
    sphere.commit();
    for (int i = 0; i < 500; ++i) {
      const Ray from_quad = emit(QuadLight{corner, u, v, Rgb(1)}, kScene, rng).ray;
      ASSERT_FALSE(quad.intersect(from_quad)) << "quad of " << size << " at " << away;
      ASSERT_FALSE(mesh.intersect(emit(mesh_light, kScene, rng).ray)) << "box of " << size << " at " << away;
      ASSERT_FALSE(disc.intersect(emit(disc_light, kScene, rng).ray)) << "disc of " << size << " at " << away;
      const Ray from_sphere = emit(SphereLight{corner, size, Rgb(1)}, kScene, rng).ray;
      ASSERT_FALSE(sphere.intersect(from_sphere)) << "sphere of " << size << " at " << away;
    }
  }
}

}  // namespace
}  // namespace vpm
