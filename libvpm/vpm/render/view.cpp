// Straight on to the first surface, and through specular ones from there.
#include "vpm/render/view.h"

#include <cmath>

#include "vpm/base/overloads.h"
#include "vpm/path/both_sides.h"
#include "vpm/path/stretches.h"
#include "vpm/surface/fresnel.h"
#include "vpm/surface/shading.h"

namespace vpm {
namespace {

/// The visitor of a ray's stretches.
struct Passing {
  const Scene& scene;
  const Ray& ray;
  const MediumId& number;
  Passage& passage;

  bool pass(const Stretch& stretch) {
    if (number == kVacuum) return true;
    const Medium& medium = scene.media[number];
    const double integral = density_integral(medium, ray, {0.0f, stretch.length}).value;
    const Rgb albedo = medium.albedo();
    for (int c = 0; c < 3; ++c) {
      if (medium.sigma_t[c] == 0.0f) continue;  // also of an endless stretch
      const double optical = double{medium.sigma_t[c]} * integral;
      const double lost = passage.transmittance[c] * -std::expm1(-optical);
      passage.lost[c] += lost;
      passage.scattered[c] += double{albedo[c]} * lost;
      passage.transmittance[c] *= std::exp(-optical);
    }
    return true;
  }
};

/// Of a material that is not specular, whatever the direction; nothing of those that are.
std::optional<Rgb> reflectance_at_all(const Material& material) {
  using Reflectance = std::optional<Rgb>;
  return std::visit(Overloads{[](const Lambertian& m) { return Reflectance(m.reflectance); },
                              [](const Phong& m) { return Reflectance(m.diffuse + m.glossy); },
                              [](const RoughConductor& m) { return Reflectance(fresnel_conductor(1.0f, m.eta, m.k)); },
                              [](const RoughDielectric&) { return Reflectance(Rgb(1.0f)); },
                              [](const auto&) { return Reflectance(); }},
                    material);
}

/// Where a path from the camera is, which only specular surfaces have turned.
struct Sight {
  Ray ray;
  MediumId medium = kVacuum;
  float part = 1.0f;  // of the light of the camera's ray, as glass has divided it
  int specular = 0;   // surfaces so far
};

Rgbd albedo_after(const Scene& scene, const Passage& passage, const Sight& at);

/// Of what lies behind a specular surface, in the direction that `scatter` turns to.
Rgbd albedo_beyond(const Scene& scene, const Hit& hit, const Scatter& scatter, float fraction, const Sight& at) {
  if (is_black(scatter.weight)) return Rgbd(0.0);
  PathState state{at.ray, at.medium};
  leave_along(scene, hit, scatter, state);
  Sight next{state.ray, state.medium, at.part * fraction, at.specular + 1};
  const Passage passage = pass_media(scene, next.ray, next.medium);
  return Rgbd(scatter.weight) * albedo_after(scene, passage, next);
}

Rgbd albedo_at(const Scene& scene, const Hit& hit, const Sight& at) {
  const Material material = material_at(scene, hit);
  if (const std::optional<Rgb> reflectance = reflectance_at_all(material)) return Rgbd(*reflectance);
  if (at.specular == kMostSpecular) return Rgbd(1.0);
  const Vec3& travel = at.ray.direction;
  if (const std::optional<BothSides> sides = both_sides(material, hit, travel, at.part)) {
    const double back = sides->reflected, beyond = 1.0 - back;
    return back * albedo_beyond(scene, hit, sides->back, sides->reflected, at) +
           beyond * albedo_beyond(scene, hit, sides->beyond, 1.0f - sides->reflected, at);
  }
  constexpr float kStrongerSide = 0.5f;  // reflects where more than that is reflected
  return albedo_beyond(scene, hit, sample_scatter(material, hit, travel, kStrongerSide, Vec2(0.0f)), 1.0f, at);
}

Rgbd albedo_after(const Scene& scene, const Passage& passage, const Sight& at) {
  if (!passage.surface) return passage.scattered;
  return passage.scattered + passage.transmittance * albedo_at(scene, *passage.surface, at);
}

}  // namespace

Passage pass_media(const Scene& scene, Ray& ray, MediumId& medium) {
  Passage passage;
  WalkCounters uncounted;  // the report counts what estimates of light do
  passage.surface = each_stretch(scene, ray, medium, kInfinity, uncounted, Passing{scene, ray, medium, passage});
  return passage;
}

View view_along(const Scene& scene, const Ray& camera_ray) {
  Sight at{camera_ray, medium_of_ray(scene, scene.camera_medium, camera_ray)};
  View view;
  view.passage = pass_media(scene, at.ray, at.medium);
  if (const std::optional<Hit>& surface = view.passage.surface) {
    view.distance = glm::distance(Vec3d(camera_ray.origin), Vec3d(surface->position));
    const bool before = glm::dot(surface->normal, camera_ray.direction) < 0.0f;
    view.normal = before ? surface->shading_normal : -surface->shading_normal;
  }
  view.albedo = albedo_after(scene, view.passage, at);
  return view;
}

}  // namespace vpm
