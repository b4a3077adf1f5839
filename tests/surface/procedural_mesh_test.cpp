// Procedural meshes: closed, with normals that fit them, and of the volumes and areas that their formulas have.
#include "vpm/surface/procedural_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>

namespace vpm {
namespace {

TriangleMesh make(std::string_view name, int resolution) { return find_procedural_mesh(name)->make(resolution); }

/// Twice the area of a triangle times its outward normal, m^2.
Vec3d twice_area(const TriangleMesh& mesh, const glm::uvec3& t) {
  const Vec3d a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
  return glm::cross(b - a, c - a);
}

double area(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const glm::uvec3& t : mesh.triangles) sum += 0.5 * glm::length(twice_area(mesh, t));
  return sum;
}

/// By the divergence theorem; negative for a mesh inside out.
double volume(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const glm::uvec3& t : mesh.triangles) sum += glm::dot(Vec3d(mesh.positions[t.x]), twice_area(mesh, t)) / 6.0;
  return sum;
}

/// The largest sine of the angle between a triangle's normal and those of its vertices; infinity for more than 90
/// degrees.
double largest_deviation(const TriangleMesh& mesh) {
  double largest = 0.0;
  for (const glm::uvec3& t : mesh.triangles)
    for (int i = 0; i < 3; ++i) {
      const Vec3d flat = glm::normalize(twice_area(mesh, t)), vertex(mesh.normals[t[i]]);
      if (!(glm::dot(flat, vertex) > 0.0)) return kInfinity;
      largest = std::max(largest, glm::length(glm::cross(flat, vertex)));
    }
  return largest;
}

class EveryProceduralMesh : public ::testing::TestWithParam<ProceduralMesh> {};

TEST_P(EveryProceduralMesh, IsClosed) {
  for (const int resolution : {3, 4, 33}) {
    const TriangleMesh mesh = GetParam().make(resolution);
    using Point = std::array<float, 3>;
    std::map<std::pair<Point, Point>, int> edges;  // from, to
    const auto point = [&mesh](uint32_t vertex) {
      const Vec3& p = mesh.positions[vertex];
      return Point{p.x, p.y, p.z};
    };
    for (const glm::uvec3& t : mesh.triangles)
      for (int i = 0; i < 3; ++i) ++edges[{point(t[i]), point(t[(i + 1) % 3])}];
    for (const auto& [edge, count] : edges) {
      EXPECT_EQ(count, 1);
      EXPECT_EQ(edges.count({edge.second, edge.first}), 1u) << "an edge has a triangle on one side only";
    }
  }
}

TEST_P(EveryProceduralMesh, HasUnitNormalsThatItsTrianglesApproach) {
  const TriangleMesh coarse = GetParam().make(128), fine = GetParam().make(256);
  ASSERT_EQ(fine.normals.size(), fine.positions.size());
  for (const Vec3& normal : fine.normals) EXPECT_NEAR(glm::length(normal), 1.0f, 3e-7f);
  EXPECT_LT(largest_deviation(coarse), 0.12);
  EXPECT_NEAR(largest_deviation(fine) / largest_deviation(coarse), 0.5, 0.02);  // first order, as curvature makes it
}

TEST_P(EveryProceduralMesh, HasTextureCoordinatesInTheUnitSquare) {
  const TriangleMesh mesh = GetParam().make(16);
  ASSERT_EQ(mesh.uvs.size(), mesh.positions.size());
  for (const Vec2& uv : mesh.uvs) EXPECT_TRUE(uv.x >= 0.0f && uv.x <= 1.0f && uv.y >= 0.0f && uv.y <= 1.0f);
}

INSTANTIATE_TEST_SUITE_P(All, EveryProceduralMesh, ::testing::ValuesIn(procedural_meshes()),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(ProceduralMeshes, RingIsTheTubeBetweenTwoRegularPrisms) {
  constexpr double kOuter = 0.5, kInner = 0.47, kHeight = 0.25;  // m
  for (const int n : {3, 12, 256}) {
    const TriangleMesh mesh = make("ring", n);
    const double polygon = 0.5 * n * std::sin(2.0 * kPiD / n);  // area of a regular one in the unit circle
    const double perimeter = 2.0 * n * std::sin(kPiD / n);
    const double base = polygon * (kOuter * kOuter - kInner * kInner);
    EXPECT_NEAR(volume(mesh), base * kHeight, 1e-6 * base * kHeight);
    const double expected = 2.0 * base + perimeter * (kOuter + kInner) * kHeight;
    EXPECT_NEAR(area(mesh), expected, 1e-6 * expected);
  }
}

TEST(ProceduralMeshes, PoleIsAPrismAndTwoTruncatedPyramidsWithoutAPrism) {
  constexpr int kSides = 48;
  const double polygon = 0.5 * kSides * std::sin(2.0 * kPiD / kSides);  // area of a regular one in the unit circle
  const auto pyramid = [](double below, double above, double height) {
    return height / 3.0 * (below * below + below * above + above * above);
  };
  const double outside = pyramid(0.09, 0.09, 0.9) + pyramid(0.09, 0.055, 0.1) + pyramid(0.055, 0.04, 3.7);
  const double expected = polygon * (outside - pyramid(0.03, 0.03, 4.7));
  EXPECT_NEAR(volume(make("pole", kSides)), expected, 1e-5 * expected);
}

TEST(ProceduralMeshes, WavesHoldAsMuchAsStillWater) {
  for (const int n : {16, 100, 256})  // their sines cancel over whole periods, on the lattice too
    EXPECT_NEAR(volume(make("waves", n)), 4.0 * 4.0 * 1.55, 1e-6 * 4.0 * 4.0 * 1.55);
}

/// Area of the upper side of the waves, m^2: its triangles are the first.
double waves_top(const TriangleMesh& mesh, int resolution) {
  double sum = 0.0;
  for (int t = 0; t < 2 * resolution * resolution; ++t) sum += 0.5 * glm::length(twice_area(mesh, mesh.triangles[t]));
  return sum;
}

TEST(ProceduralMeshes, WavesHaveTheAreaThatTheirNormalsTell) {
  // The top's area is the integral of 1/cos over its shadow; the lattice's sum of a periodic function is exact but for
  // high harmonics. The triangles' area falls short of it by second order, which extrapolation takes away.
  constexpr int kCells = 256;
  const TriangleMesh fine = make("waves", kCells), coarse = make("waves", kCells / 2);
  double expected = 0.0;
  for (int j = 0; j < kCells; ++j)
    for (int i = 0; i < kCells; ++i) expected += 16.0 / (kCells * kCells) / fine.normals[j * (kCells + 1) + i].y;
  const double extrapolated = (4.0 * waves_top(fine, kCells) - waves_top(coarse, kCells / 2)) / 3.0;
  EXPECT_GT(expected - 16.0, 0.1);
  EXPECT_NEAR(extrapolated, expected, 2e-5 * (expected - 16.0));
}

TEST(ProceduralMeshes, AreFoundByName) {
  for (const ProceduralMesh& mesh : procedural_meshes()) EXPECT_EQ(find_procedural_mesh(mesh.name)->name, mesh.name);
  EXPECT_EQ(find_procedural_mesh("nothing"), nullptr);
}

}  // namespace
}  // namespace vpm
