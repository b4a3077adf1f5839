// Scenes of one medium, made of parts.
#include "vpm/study/estimates/glowing.h"

#include "vpm/integrators/path/path_tracer.h"
#include "vpm/scene/assemble.h"
#include "vpm/study/sample_moments.h"

namespace vpm {
namespace {

constexpr uint32_t kBoundary = 0, kDiffuse = 1;  // numbers of materials

SceneParts parts_with(const Medium& medium, float reflectance) {
  SceneParts parts;
  parts.media.push_back({medium});
  parts.materials.push_back({Boundary{}});
  parts.materials.push_back({Lambertian{Rgb(reflectance)}});
  parts.camera = make_camera(Vec3(0.0f, 1.0f, 9.0f), Vec3(0.0f), Vec3(0.0f, 1.0f, 0.0f), 45.0f, {});
  return parts;
}

ShapePart filled(Surface surface) {
  ShapePart shape;
  shape.surface = std::move(surface);
  shape.material = kBoundary;
  shape.media = Interface{0, kVacuum};
  return shape;
}

void add_floor(SceneParts& parts) {
  ShapePart floor;
  floor.surface = quad_mesh(Vec3(-30.0f, 0.0f, 30.0f), Vec3(60.0f, 0.0f, 0.0f), Vec3(0.0f, 0.0f, -60.0f));
  floor.material = kDiffuse;
  parts.shapes.push_back(floor);
}

}  // namespace

Scene glowing_slab(const Medium& medium, double thickness, const Rgb& around) {
  SceneParts parts = parts_with(medium, 0.5f);
  const double wide = 1e4 * thickness;
  parts.shapes.push_back(filled(box_mesh(Vec3d(-wide, -wide, 0.0), Vec3d(wide, wide, thickness))));
  if (!is_black(around)) parts.lights.push_back({"around", ConstantEnvironment{around}});
  return assemble(std::move(parts)).scene;
}

Scene glowing_ball(const Medium& medium, const SphereShape& ball, float reflectance) {
  SceneParts parts = parts_with(medium, reflectance);
  parts.shapes.push_back(filled(ball));
  if (reflectance > 0.0f) add_floor(parts);
  return assemble(std::move(parts)).scene;
}

Scene glowing_grid(const Medium& medium, float reflectance) {
  SceneParts parts = parts_with(medium, reflectance);
  add_floor(parts);
  return assemble(std::move(parts)).scene;
}

Scene furnace(const Medium& medium, float reflectance, const Rgb& emitted) {
  SceneParts parts = parts_with(medium, reflectance);
  const Vec3 x(2.0f, 0.0f, 0.0f), y(0.0f, 2.0f, 0.0f), z(0.0f, 0.0f, 2.0f), low(-1.0f), high(1.0f);
  for (const auto& [corner, u, v] : {std::tuple(low, x, y), std::tuple(low, y, z), std::tuple(low, z, x),
                                     std::tuple(high, -y, -x), std::tuple(high, -z, -y), std::tuple(high, -x, -z)}) {
    ShapePart wall;
    wall.surface = quad_mesh(corner, u, v);
    wall.material = kDiffuse;
    wall.media = Interface{kVacuum, 0};  // the medium lies before it
    wall.emission = emitted;
    parts.shapes.push_back(wall);
  }
  parts.camera = make_camera(Vec3(0.3f, 0.1f, 0.7f), Vec3(0.0f), Vec3(0.0f, 1.0f, 0.0f), 60.0f, {16, 16});
  parts.camera_medium = 0;
  return assemble(std::move(parts)).scene;
}

std::vector<Moments> seen_by_paths(const Scene& scene, MediumId start, const std::vector<Ray>& rays, uint64_t samples,
                                   uint64_t seed) {
  const PathContext context = make_path_context(scene, {});
  return sample_moments(3 * rays.size(), samples, seed, [&](Rng& rng, double* out) {
    EyeCounters counters;
    for (const Ray& ray : rays) {
      const Rgb seen = path_radiance(context, ray, start, rng, counters);
      for (int c = 0; c < 3; ++c) *out++ = seen[c];
    }
  });
}

}  // namespace vpm
