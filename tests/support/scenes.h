// Small scenes built in code, for tests.
#pragma once

#include "support/grids.h"
#include "vpm/scene/build.h"

namespace vpm {

/// A medium inside the boundary box [-1, 1]^3, vacuum around it; more can be added before it is finished.
inline Scene unfinished_box(const Medium& medium) {
  Scene scene;
  scene.media.push_back(medium);
  const Interface media{0, kVacuum};
  add_shape(scene, box_mesh(Vec3d(-1.0), Vec3d(1.0)), Boundary{}, &media);
  return scene;
}

/// The same, finished.
inline Scene boxed_medium(const Medium& medium, const std::vector<Light>& lights) {
  Scene scene = unfinished_box(medium);
  scene.lights = lights;
  scene.geometry.commit();
  finish(scene);
  return scene;
}
inline Scene boxed_medium(const Medium& medium, const Light& light) {
  return boxed_medium(medium, std::vector<Light>{light});
}

/// Makes lights that were added to a finished scene known to it.
inline void finish_again(Scene& scene) {
  scene.light_probability.clear();
  scene.light_medium.clear();
  finish(scene);
}

}  // namespace vpm
