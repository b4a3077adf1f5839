// Slabs as scenes: media, wide boundaries, mirrors far away, and the light.
#include "vpm/scene/build.h"
#include "vpm/study/estimates/slab.h"

namespace vpm {
namespace {

/// A boundary across all of the slab; off its centre, so that the diagonal that divides the quad is far from the light.
void add_plane(Scene& scene, double depth, double width, const Interface& media) {
  const Vec3d corner(-1.1 * width, -depth, -1.4 * width);
  add_shape(scene, quad_mesh(corner, Vec3d(0.0, 0.0, 2.5 * width), Vec3d(2.5 * width, 0.0, 0.0)), Boundary{}, &media);
}

/// Mirrors at x = +-width and z = +-width, higher than the slab by as little as leaves no gap.
void add_walls(Scene& scene, double thickness, double width) {
  const double gap = 1e-6 * thickness;
  const Vec3d up(0.0, thickness + 2.0 * gap, 0.0), bottom(0.0, -thickness - gap, 0.0);
  for (const double side : {-1.0, 1.0}) {
    const double far = 1.01 * width;
    add_shape(scene, quad_mesh(bottom + Vec3d(side * width, 0.0, -far), up, Vec3d(0.0, 0.0, 2.0 * far)), Mirror{});
    add_shape(scene, quad_mesh(bottom + Vec3d(-far, 0.0, side * width), up, Vec3d(2.0 * far, 0.0, 0.0)), Mirror{});
  }
}

Light light_on(const Slab& slab, SlabLight light) {
  const auto size = static_cast<float>(slab.layers.thickness());
  if (slab.incidence == Incidence::collimated) {
    if (light == SlabLight::everywhere) return DirectionalLight{};
    return BeamLight{Vec3(0.0f, size, 0.0f), Vec3(0.0f, -1.0f, 0.0f), 0.01f * size, Rgb(1.0f)};
  }
  if (light == SlabLight::everywhere) {
    std::vector<Rgb> sky{Rgb(1.0f / kPi), Rgb(0.0f)};  // above, below
    return EnvironmentMap{std::make_shared<const ImageEnvironment>(1, 2, std::move(sky))};
  }
  return QuadLight{0.5f * size * Vec3(-1.0f, 0.002f, -1.0f), Vec3(size, 0.0f, 0.0f), Vec3(0.0f, 0.0f, size),
                   Rgb(1.0f / (kPi * size * size))};
}

}  // namespace

Slab homogeneous_slab(double optical_thickness, double albedo, double g, Incidence incidence) {
  return {{{0.0, 1.0}, {optical_thickness, optical_thickness}}, albedo, g, incidence};
}

Scene slab_scene(const Slab& slab, SlabLight light, double mirrors) {
  const double thickness = slab.layers.thickness(), width = mirrors * thickness;
  const LayeredMedia layered = layered_media(slab.layers, 2.0 * width);
  Scene scene;
  const auto last = static_cast<MediumId>(layered.media.size()) - 1;
  add_plane(scene, 0.0, width, {0, kVacuum});
  for (MediumId m = 0; m <= last; ++m) {
    Medium medium = layered.media[m];
    medium.sigma_s = static_cast<float>(slab.albedo) * medium.sigma_t;
    if (slab.g != 0.0) medium.phase = HenyeyGreenstein{static_cast<float>(slab.g)};
    scene.media.push_back(std::move(medium));
    add_plane(scene, layered.bottoms[m], width, {m < last ? m + 1 : kVacuum, m});
  }
  add_walls(scene, thickness, width);
  scene.lights.push_back(light_on(slab, light));
  scene.geometry.commit();
  finish(scene);
  return scene;
}

}  // namespace vpm
