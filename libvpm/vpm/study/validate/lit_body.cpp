// The scenes of lit bodies.
#include "vpm/study/validate/lit_body.h"

#include "vpm/medium/make_grid.h"
#include "vpm/scene/build.h"
#include "vpm/study/validate/fields.h"

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

}  // namespace vpm
