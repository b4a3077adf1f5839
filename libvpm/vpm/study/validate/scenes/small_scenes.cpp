// Scenes built in code, each with a film of a few pixels.
#include "vpm/study/validate/scenes/small_scenes.h"

#include <cmath>

#include "vpm/medium/grid/make_grid.h"

namespace vpm {
namespace {

constexpr int kFilm = 6;  // pixels along an edge

void look(Scene& scene, const Vec3& from, const Vec3& at, float fov) {
  scene.camera = make_camera(from, at, Vec3(0.0f, 1.0f, 0.01f), fov, {kFilm, kFilm});
}

Scene finished(Scene scene) {
  scene.geometry.commit();
  finish(scene);
  scene.camera_medium = medium_at(scene, scene.camera.position);
  return scene;
}

/// A light that faces down, with the shape that carries it.
void add_lamp(Scene& scene, const Vec3& corner, float size, const Rgb& radiance) {
  const QuadLight light{corner, Vec3(size, 0, 0), Vec3(0, 0, size), radiance};
  scene.lights.push_back(light);
  add_shape(scene, quad_mesh(light.corner, light.edge_u, light.edge_v), Lambertian{Rgb(0.0f)}, nullptr,
            static_cast<int>(scene.lights.size()) - 1);
}

void add_floor(Scene& scene, const Rgb& reflectance) {
  add_shape(scene, quad_mesh(Vec3d(-2, 0, 2), Vec3d(4, 0, 0), Vec3d(0, 0, -4)), Lambertian{reflectance});
}

/// A quad that is shaded as if it leaned that way.
TriangleMesh leaning_quad(const Vec3d& corner, const Vec3d& u, const Vec3d& v, const Vec3& lean) {
  TriangleMesh mesh = quad_mesh(corner, u, v);
  mesh.normals.assign(mesh.positions.size(), Vec3(glm::normalize(glm::cross(u, v))) + lean);
  return mesh;
}

void add_medium_box(Scene& scene, const Medium& medium) {
  scene.media.push_back(medium);
  const Interface media{0, kVacuum};
  add_shape(scene, box_mesh(Vec3d(-1.0), Vec3d(1.0)), Boundary{}, &media);
}

/// A frame of n voxels along each edge whose cells fill [-1, 1]^3.
GridFrame unit_frame(int n) {
  GridFrame frame;
  frame.hi = Vec3i(n - 1);
  const double spacing = 2.0 / (n - 1);
  frame.index_to_world = Mat4d(spacing);
  frame.index_to_world[3] = glm::dvec4(-1.0, -1.0, -1.0, 1.0);
  return frame;
}

}  // namespace

Scene foggy_light() {
  Scene scene;
  Medium fog = make_medium(nullptr, Rgb(0.7f, 1.0f, 1.6f), 0.8f);
  fog.sigma_s = fog.sigma_t * Rgb(0.9f, 0.8f, 0.6f);
  fog.phase = HenyeyGreenstein{0.5f};
  scene.media.push_back(fog);
  scene.world_medium = 0;
  // No point light: the square of what shadow rays from about one bring has no mean.
  for (const SphereLight& light : {SphereLight{Vec3(0.0f, 1.0f, 0.0f), 0.4f, Rgb(1.0f, 0.9f, 0.8f)},
                                   SphereLight{Vec3(2.0f, 0.5f, 0.5f), 0.3f, Rgb(1.0f, 0.7f, 1.7f)}}) {
    add_shape(scene, SphereShape{light.center, light.radius}, Lambertian{Rgb(0.0f)}, nullptr,
              static_cast<int>(scene.lights.size()));
    scene.lights.push_back(light);
  }
  look(scene, Vec3(0, -0.2f, 1.5f), Vec3(0.0f, -0.2f, 0.0f), 40.0f);
  return finished(std::move(scene));
}

Scene small_cloud(Viewpoint viewpoint, const Rgb& thickness) {
  constexpr int kAcross = 17;
  Scene scene;
  const auto density = [](int x, int y, int z) {
    const Vec3d p = 2.0 * Vec3d(x, y, z) / double{kAcross - 1} - 1.0;
    const Vec3d hat = 1.0 - p * p;
    return hat.x * hat.y * hat.z * (1.0 + 0.6 * std::sin(4.0 * p.x + 2.0 * p.y) * std::cos(3.0 * p.z));
  };
  // Across the middle the density's integral is close to 4/3 m: this is the optical thickness there.
  Medium medium = make_medium(make_grid(unit_frame(kAcross), density), 0.75f * thickness, 0.9f);
  medium.phase = HenyeyGreenstein{-0.3f};
  add_medium_box(scene, medium);
  const Vec3 light(1.5f, 2.5f, 1.0f);
  scene.lights.push_back(SpotLight{light, glm::normalize(-light), 0.92f, 0.88f, Rgb(20.0f)});
  const float distance = viewpoint == Viewpoint::outside ? 4.0f : viewpoint == Viewpoint::border ? 1.0f : 0.5f;
  look(scene, Vec3(0.1f, 0.05f, distance), Vec3(0.05f, 0.0f, 0.0f), viewpoint == Viewpoint::outside ? 30.0f : 60.0f);
  return finished(std::move(scene));
}

Scene filled_box(bool grid) {
  Scene scene;
  const auto constant = grid ? make_grid(unit_frame(9), [](int, int, int) { return 1.0; }) : nullptr;
  Medium medium = make_medium(constant, Rgb(1.2f, 1.5f, 2.0f), 0.8f);
  medium.phase = Rayleigh{};
  add_medium_box(scene, medium);
  add_lamp(scene, Vec3(-0.5f, 1.8f, -0.5f), 1.0f, Rgb(5.0f, 4.0f, 3.0f));
  look(scene, Vec3(0, 0, 4), Vec3(0.0f), 30.0f);
  return finished(std::move(scene));
}

Scene lit_corner(float ior) {
  Scene scene;
  add_lamp(scene, Vec3(-0.7f, 1.6f, -0.7f), 1.4f, Rgb(4.0f));
  add_floor(scene, Rgb(0.6f, 0.5f, 0.4f));
  scene.lights.push_back(PointLight{Vec3(0.1f, -0.5f, 0.2f), Rgb(0.7f)});
  add_shape(scene, quad_mesh(Vec3d(-1.0, 0, -1), Vec3d(0, 0, 2), Vec3d(0, 1.5, 0)), Lambertian{Rgb(0.8f, 0.3f, 0.3f)});
  if (ior > 0.0f) add_shape(scene, SphereShape{Vec3(0.1f, 0.7f, 0.0f), 0.4f}, Dielectric{ior});
  look(scene, Vec3(0.9f, 0.5f, 0.9f), Vec3(0.1f, 0.0f, 0.0f), 32.0f);
  return finished(std::move(scene));
}

Scene leaning_wall() {
  Scene scene;
  const Vec3 light(1.0f, 1.6f, 0.3f), target(-1.0f, 1.2f, 0.0f);
  scene.lights.push_back(SpotLight{light, glm::normalize(target - light), 0.97f, 0.94f, Rgb(9.0f)});
  add_shape(scene, leaning_quad(Vec3d(-2, 0, 2), Vec3d(4, 0, 0), Vec3d(0, 0, -4), Vec3(-0.7f, 0.0f, 0.0f)),
            Lambertian{Rgb(0.6f)});
  add_shape(scene, leaning_quad(Vec3d(-1, 0, 1.2), Vec3d(0, 0, -2.4), Vec3d(0, 2.4, 0), Vec3(0.0f, -1.0f, 0.0f)),
            Lambertian{Rgb(0.9f)});
  look(scene, Vec3(0.9f, 0.7f, 0.9f), Vec3(-0.3f, 0.0f, 0.4f), 32.0f);
  return finished(std::move(scene));
}

Scene rough_corner() {
  Scene scene;
  add_lamp(scene, Vec3(-0.7f, 1.6f, -0.7f), 1.4f, Rgb(4.0f));
  scene.lights.push_back(PointLight{Vec3(-0.6f, -0.8f, -0.7f), Rgb(1.5f)});
  add_shape(scene, quad_mesh(Vec3d(-2, 0, 2), Vec3d(4, 0, 0), Vec3d(0, 0, -4)), RoughDielectric{1.5f, 0.5f});
  add_shape(scene, quad_mesh(Vec3d(-1.0, 0, -1), Vec3d(0, 0, 2), Vec3d(0, 1.5, 0)),
            RoughConductor{Rgb(0.16f, 0.42f, 1.38f), Rgb(3.6f, 2.5f, 1.9f), 0.5f});
  look(scene, Vec3(0.9f, 0.7f, 0.9f), Vec3(0.1f, 0.0f, 0.0f), 32.0f);
  return finished(std::move(scene));
}

Scene hollow_cube() {
  Scene scene;
  add_shape(scene, box_mesh(Vec3d(-1.0), Vec3d(1.0)), Lambertian{Rgb(0.7f, 0.5f, 0.3f)});
  scene.lights.push_back(PointLight{Vec3(0.0f, 0.1f, 0.2f), Rgb(1.0f)});
  look(scene, Vec3(0.3f, 0.2f, 0.1f), Vec3(1.0f, 0.1f, 0.0f), 50.0f);
  return finished(std::move(scene));
}

Scene foggy_floor() {
  Scene scene;
  Medium fog = make_medium(nullptr, Rgb(0.6f), 0.9f);
  fog.phase = HenyeyGreenstein{0.4f};
  scene.media.push_back(fog);
  scene.world_medium = 0;
  add_lamp(scene, Vec3(-0.5f, 1.6f, -0.5f), 1.0f, Rgb(4.0f));
  add_floor(scene, Rgb(0.7f));
  look(scene, Vec3(0.9f, 0.9f, 0.9f), Vec3(0.1f, 0.0f, 0.0f), 32.0f);
  return finished(std::move(scene));
}

Scene bare_floor() {
  Scene scene;
  scene.lights.push_back(PointLight{Vec3(-0.3f, 0.3f, 0.0f), Rgb(1.0f)});
  add_floor(scene, Rgb(0.5f));
  look(scene, Vec3(0.0f, 3.0f, 0.0f), Vec3(0.0f, 0.0f, 0.1f), 32.0f);
  return finished(std::move(scene));
}

}  // namespace vpm
