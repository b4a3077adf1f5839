// The formulas of the procedural meshes. Each is a few patches: lattices of vertices i, j that are bent into place.
#include "vpm/surface/procedural_mesh.h"

#include <algorithm>

#include "vpm/base/cancel.h"

namespace vpm {
namespace {

struct Vertex {
  Vec3d position;  // m
  Vec3d normal;    // unit, outward
  Vec2 uv;
};

/// Adds a lattice of `columns` x `rows` cells of two triangles. `vertex_at(i, j)` with 0 <= i <= columns and
/// 0 <= j <= rows; outside is where (along i) x (along j) points.
template <class VertexAt>
void add_patch(TriangleMesh& mesh, int columns, int rows, const VertexAt& vertex_at) {
  const auto first = static_cast<uint32_t>(mesh.positions.size());
  const auto number = [&](int i, int j) { return first + static_cast<uint32_t>(j * (columns + 1) + i); };
  for (int j = 0; j <= rows; ++j) {
    cancellation_point();
    for (int i = 0; i <= columns; ++i) {
      const Vertex vertex = vertex_at(i, j);
      mesh.positions.emplace_back(vertex.position);
      mesh.normals.emplace_back(vertex.normal);
      mesh.uvs.push_back(vertex.uv);
    }
  }
  for (int j = 0; j < rows; ++j) {
    cancellation_point();
    for (int i = 0; i < columns; ++i) {
      mesh.triangles.emplace_back(number(i, j), number(i + 1, j), number(i + 1, j + 1));
      mesh.triangles.emplace_back(number(i, j), number(i + 1, j + 1), number(i, j + 1));
    }
  }
}

// Ring
// ----------------------------------------------------------------------------------------------------

constexpr double kRingOuter = 0.50;   // m, radius
constexpr double kRingInner = 0.47;   // m, radius
constexpr double kRingHeight = 0.25;  // m

/// A point of the ring's profile: distance from the axis and height, m.
struct ProfilePoint {
  double radius, height;
};

/// Turns the stretch from `from` to `to` of a profile round the y axis; the profile's inside lies to its left.
void add_turned(TriangleMesh& mesh, int resolution, const ProfilePoint& from, const ProfilePoint& to) {
  const double along_radius = to.radius - from.radius, along_height = to.height - from.height;
  const double length = std::hypot(along_radius, along_height);
  add_patch(mesh, resolution, 1, [&](int i, int j) {
    const double angle = 2.0 * kPiD * (i % resolution) / resolution;
    const Vec3d outward(std::sin(angle), 0.0, std::cos(angle)), up(0.0, 1.0, 0.0);
    const ProfilePoint& at = j == 0 ? from : to;
    return Vertex{at.radius * outward + at.height * up, (along_height * outward - along_radius * up) / length,
                  Vec2(static_cast<float>(i) / static_cast<float>(resolution), static_cast<float>(j))};
  });
}

/// Turns a closed profile, which begins and ends at the same point.
TriangleMesh turned(std::span<const ProfilePoint> profile, int resolution) {
  TriangleMesh mesh;
  for (size_t i = 1; i < profile.size(); ++i) add_turned(mesh, resolution, profile[i - 1], profile[i]);
  return mesh;
}

TriangleMesh ring(int resolution) {
  const ProfilePoint profile[] = {
      {kRingOuter, 0.0}, {kRingOuter, kRingHeight}, {kRingInner, kRingHeight}, {kRingInner, 0.0}, {kRingOuter, 0.0}};
  return turned(profile, resolution);
}

// Pole
// ----------------------------------------------------------------------------------------------------

constexpr ProfilePoint kPole[] = {{0.09, 0.0}, {0.09, 0.9}, {0.055, 1.0}, {0.04, 4.7},
                                  {0.03, 4.7}, {0.03, 0.0}, {0.09, 0.0}};

TriangleMesh pole(int resolution) { return turned(kPole, resolution); }

// Waves
// ----------------------------------------------------------------------------------------------------

constexpr double kWavesSide = 4.0;    // m
constexpr double kWavesDepth = 1.55;  // m below the mean level

/// A wave whose crests run askew: so many periods along the sides x and z, so that opposite sides match.
struct Wave {
  int periods_x, periods_z;
  double amplitude;  // m
  double phase;      // radians
};
constexpr Wave kWaves[] = {{3, 1, 0.017, 0.3},  {-1, 4, 0.013, 1.9}, {5, -2, 0.0095, 4.1},
                           {2, 6, 0.0075, 2.7}, {-7, 3, 0.005, 5.6}, {6, 7, 0.003, 0.9}};

/// Height of the water above its mean level and the slope of it, at shares x, z of the sides.
struct Level {
  double height = 0.0;  // m
  double slope_x = 0.0, slope_z = 0.0;
};
Level water_level(double x, double z) {
  Level level;
  for (const Wave& wave : kWaves) {
    const double angle = 2.0 * kPiD * (wave.periods_x * x + wave.periods_z * z) + wave.phase;
    const double slope = 2.0 * kPiD / kWavesSide * wave.amplitude * std::cos(angle);
    level.height += wave.amplitude * std::sin(angle);
    level.slope_x += wave.periods_x * slope;
    level.slope_z += wave.periods_z * slope;
  }
  return level;
}

/// A vertex of the top (up) or the floor of the water; its coordinates in a texture are the shares of the sides.
Vertex water_vertex(double x, double z, bool up) {
  const Level level = water_level(x, z);
  const double y = up ? level.height : -kWavesDepth;
  const Vec3d normal = up ? glm::normalize(Vec3d(-level.slope_x, 1.0, -level.slope_z)) : Vec3d(0.0, -1.0, 0.0);
  return {Vec3d((x - 0.5) * kWavesSide, y, (z - 0.5) * kWavesSide), normal, Vec2(x, z)};
}

TriangleMesh waves(int resolution) {
  TriangleMesh mesh;
  const auto share = [resolution](int i) { return static_cast<double>(i) / resolution; };
  const auto add_side = [&](const Vec3d& normal, const auto& x_at, const auto& z_at) {
    add_patch(mesh, resolution, 1, [&](int i, int j) {
      Vertex vertex = water_vertex(x_at(i), z_at(i), j == 1);
      vertex.normal = normal;
      vertex.uv = Vec2(share(i), j);
      return vertex;
    });
  };
  const auto forth = [&](int i) { return share(i); };
  const auto back = [&](int i) { return share(resolution - i); };
  const auto low = [](int) { return 0.0; };
  const auto high = [](int) { return 1.0; };
  add_patch(mesh, resolution, resolution, [&](int i, int j) { return water_vertex(share(j), share(i), true); });
  add_patch(mesh, resolution, resolution, [&](int i, int j) { return water_vertex(share(i), share(j), false); });
  add_side(Vec3d(0.0, 0.0, 1.0), forth, high);
  add_side(Vec3d(0.0, 0.0, -1.0), back, low);
  add_side(Vec3d(1.0, 0.0, 0.0), high, back);
  add_side(Vec3d(-1.0, 0.0, 0.0), low, forth);
  return mesh;
}

constexpr ProceduralMesh kMeshes[] = {
    {"ring", "a band of outer radius 0.5 m, inner radius 0.47 m and height 0.25 m around the y axis, from y = 0 up",
     ring},
    {"pole",
     "the pole of a street lamp, a tube 4.7 m high around the y axis, from y = 0 up: 0.18 m wide up to 0.9 m, "
     "then from 0.11 m to 0.08 m",
     pole},
    {"waves", "water of 4 m x 4 m, its bottom at y = -1.55 m, its mean level at y = 0, with waves of up to 6 cm",
     waves},
};

}  // namespace

std::span<const ProceduralMesh> procedural_meshes() { return kMeshes; }

const ProceduralMesh* find_procedural_mesh(std::string_view name) {
  const auto mesh =
      std::find_if(std::begin(kMeshes), std::end(kMeshes), [name](const ProceduralMesh& m) { return m.name == name; });
  return mesh == std::end(kMeshes) ? nullptr : mesh;
}

}  // namespace vpm
