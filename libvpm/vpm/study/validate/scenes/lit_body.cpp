// The scenes of lit bodies.
#include "vpm/study/validate/scenes/lit_body.h"

#include "vpm/medium/grid/make_grid.h"
#include "vpm/scene/build.h"
#include "vpm/study/validate/scenes/fields.h"

namespace vpm {

namespace {

template <class Surface>
Scene lit_scene(const Medium& medium, const Surface& surface, const Material& skin = Boundary{}) {
  Scene scene;
  scene.media.push_back(medium);
  const Interface media{0, kVacuum};
  add_shape(scene, surface, skin, &media);
  scene.lights.push_back(ConstantEnvironment{Rgb(1.0f)});
  scene.geometry.commit();
  finish(scene);
  return scene;
}

}  // namespace

LitBody lit_sphere(std::string name, const Medium& medium) {
  return {std::move(name), lit_scene(medium, SphereShape{Vec3(0.3f, -0.2f, 0.5f), 1.0f}), 4.0 / 3.0 * kPiD, 4.0 * kPiD};
}

LitBody lit_glass(std::string name, const Medium& medium, float ior) {
  LitBody body = lit_sphere(std::move(name), medium);
  body.scene = lit_scene(medium, SphereShape{Vec3(0.3f, -0.2f, 0.5f), 1.0f}, Dielectric{ior});
  body.radiance = double{ior} * ior;
  return body;
}

LitBody lit_box(std::string name, const Medium& medium) {
  return {std::move(name), lit_scene(medium, field_box()), field_box_volume(), field_box_area(),
          mean_density_in_box(medium)};
}

Rgb tested_extinction(const StrategyInfo& info, const DensityGrid& grid) {
  if (info.bounded_weight) return Rgb(1.5f);
  const float mild = static_cast<float>(grid.mean_density()) / grid.max_density();
  return Rgb(info.positive ? mild : 0.25f * mild);
}

Medium white_medium(std::shared_ptr<const DensityGrid> grid, const Rgb& sigma_t, const Phase& phase) {
  Medium medium = make_medium(std::move(grid), sigma_t, 1.0f);
  medium.phase = phase;
  return medium;
}

Scene furnished_box(const Medium& medium) {
  Scene scene;
  scene.media.push_back(medium);
  const Interface media{0, kVacuum};
  add_shape(scene, field_box(), Boundary{}, &media);
  add_shape(scene, SphereShape{field_point({-3.0, -2.0, 0.5}), 0.3f}, Lambertian{Rgb(1.0f)});
  add_shape(scene, SphereShape{field_point({3.0, -2.0, 1.0}), 0.3f}, Mirror{Rgb(1.0f)});
  add_shape(scene, SphereShape{field_point({0.0, 4.0, -1.0}), 0.25f}, Dielectric{1.5f});
  scene.lights.push_back(ConstantEnvironment{Rgb(1.0f)});
  scene.geometry.commit();
  finish(scene);
  return scene;
}

Scene box_around_balls(const Medium& medium) {
  Scene scene;
  scene.media.push_back(medium);
  const Interface media{0, kVacuum}, bubble{kVacuum, 0};
  add_shape(scene, field_box(), Boundary{}, &media);
  add_shape(scene, SphereShape{field_point({-3.0, 0.0, 0.5}), 0.5f}, Lambertian{Rgb(1.0f)});
  add_shape(scene, SphereShape{field_point({3.0, -1.0, 0.0}), 0.4f}, Dielectric{1.5f}, &bubble);
  scene.lights.push_back(ConstantEnvironment{Rgb(1.0f)});
  scene.geometry.commit();
  finish(scene);
  return scene;
}

Scene glowing_room(const Medium& medium) {
  const Vec3 half(1.5f, 1.0f, 0.75f);
  const Interface media{kVacuum, 0};
  Scene scene;
  scene.media.push_back(medium);
  for (int axis = 0; axis < 3; ++axis)
    for (const bool upper : {false, true}) {
      Vec3 corner = -half, u(0.0f), v(0.0f);
      u[(axis + 1) % 3] = 2.0f * half[(axis + 1) % 3];
      v[(axis + 2) % 3] = 2.0f * half[(axis + 2) % 3];
      if (upper) {
        corner[axis] = half[axis];
        std::swap(u, v);
      }
      add_shape(scene, quad_mesh(corner, u, v), Lambertian{Rgb(0.5f)}, &media, static_cast<int>(scene.lights.size()));
      scene.lights.push_back(QuadLight{corner, u, v, Rgb(0.5f)});
    }
  add_shape(scene, SphereShape{Vec3(-0.6f, 0.1f, 0.0f), 0.3f}, Lambertian{Rgb(1.0f)});
  scene.geometry.commit();
  finish(scene);
  return scene;
}

Scene glowing_mesh(const Medium& medium) {
  TriangleMesh mesh = box_mesh(Vec3d(-1.5, -1.0, -0.75), Vec3d(1.5, 1.0, 0.75));
  for (glm::uvec3& t : mesh.triangles) std::swap(t.y, t.z);  // the walls face inwards
  const TriangleMesh box = box_mesh(Vec3d(-0.2, -0.6, -0.3), Vec3d(0.2, 0.1, 0.2));
  for (const glm::uvec3& t : box.triangles) mesh.triangles.push_back(t + static_cast<uint32_t>(mesh.positions.size()));
  mesh.positions.insert(mesh.positions.end(), box.positions.begin(), box.positions.end());
  const Interface media{kVacuum, 0};
  Scene scene;
  scene.media.push_back(medium);
  scene.lights.push_back(MeshLight{std::make_shared<EmittingMesh>(mesh), Rgb(1.0f)});
  add_shape(scene, mesh, Lambertian{Rgb(0.0f)}, &media, 0);
  add_shape(scene, SphereShape{Vec3(-0.8f, 0.1f, 0.0f), 0.3f}, Lambertian{Rgb(1.0f)});
  scene.geometry.commit();
  finish(scene);
  return scene;
}

}  // namespace vpm
