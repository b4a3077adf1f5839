// Small scenes for pilots to choose settings for.
#pragma once

#include "support/scenes.h"
#include "vpm/job/render_job.h"

namespace vpm {

/// A floor below a cloud whose densities differ from brick to brick, seen from the side.
inline Scene cloud_over_floor(bool grid) {
  Scene scene;
  std::shared_ptr<const DensityGrid> noise;
  if (grid) noise = make_grid(centered_frame(16, 2.0 / 32.0), lattice_noise);
  scene.media.push_back(make_medium(noise, Rgb(2.0f), 0.9f));
  const Interface media{0, kVacuum};
  add_shape(scene, box_mesh(Vec3d(-0.9), Vec3d(0.9)), Boundary{}, &media);
  add_shape(scene, quad_mesh(Vec3d(-3.0, -1.5, 3.0), Vec3d(6.0, 0.0, 0.0), Vec3d(0.0, 0.0, -6.0)),
            Lambertian{Rgb(0.5f)});
  scene.lights.push_back(PointLight{Vec3(0.0f, 3.0f, 0.0f), Rgb(10.0f)});
  scene.camera = make_camera(Vec3(0.0f, 0.5f, 5.0f), Vec3(0.0f, -0.5f, 0.0f), Vec3(0.0f, 1.0f, 0.0f), 45.0f, {64, 48});
  scene.geometry.commit();
  finish(scene);
  return scene;
}

/// A box of 2 m of a medium, and a parallel light through all of its height.
inline Scene lit_evenly(float sigma_t) {
  Scene scene;
  scene.media.push_back(make_medium(nullptr, Rgb(sigma_t), 1.0f));
  const Interface media{0, kVacuum};
  add_shape(scene, box_mesh(Vec3d(-1.0), Vec3d(1.0)), Boundary{}, &media);
  scene.lights.push_back(BeamLight{Vec3(0.0f, 2.0f, 0.0f), Vec3(0.0f, -1.0f, 0.0f), 0.9f, Rgb(1.0f)});
  scene.camera = make_camera(Vec3(0.0f, 0.0f, 3.0f), Vec3(0.0f), Vec3(0.0f, 1.0f, 0.0f), 10.0f, {64, 64});
  scene.geometry.commit();
  finish(scene);
  return scene;
}

/// A floor that is lit through a ball of glass, which shadow rays do not pass: paths are black.
inline Scene lamp_in_glass() {
  Scene scene;
  add_shape(scene, quad_mesh(Vec3d(-1.0, 0.0, 1.0), Vec3d(2.0, 0.0, 0.0), Vec3d(0.0, 0.0, -2.0)),
            Lambertian{Rgb(0.5f)});
  add_shape(scene, SphereShape{Vec3(0.0f, 1.0f, 0.0f), 0.5f}, Dielectric{1.5f});
  scene.lights.push_back(PointLight{Vec3(0.0f, 1.0f, 0.0f), Rgb(1.0f)});
  scene.camera = make_camera(Vec3(0.0f, 0.4f, 3.0f), Vec3(0.0f), Vec3(0.0f, 1.0f, 0.0f), 40.0f, {64, 64});
  scene.geometry.commit();
  finish(scene);
  return scene;
}

/// A closed room full of fog with a lamp, as in scenes/fog_room.toml, seen from within.
inline AssembledScene foggy_room(float sigma_t, const Light& light = PointLight{Vec3(0.0f, 0.9f, 0.0f), Rgb(1.0f)}) {
  AssembledScene parts;
  Scene& scene = parts.scene;
  scene.media.push_back(make_medium(nullptr, Rgb(sigma_t), 0.9f));
  const Interface media{0, kVacuum};
  add_shape(scene, box_mesh(Vec3d(-1.0), Vec3d(1.0)), Lambertian{Rgb(0.5f)}, &media);
  scene.lights.push_back(light);
  scene.camera = make_camera(Vec3(0.0f, 0.0f, 0.95f), Vec3(0.0f), Vec3(0.0f, 1.0f, 0.0f), 75.0f, {128, 128});
  scene.camera_medium = 0;
  scene.geometry.commit();
  finish(scene);
  return parts;
}

}  // namespace vpm
