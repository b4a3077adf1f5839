// What a ray from the camera comes through and to: media, the first surface, and what that scatters.
#pragma once

#include <optional>

#include "vpm/scene/scene.h"

namespace vpm {

/// Media on the way to a surface, or out of the scene. Boundaries are no surfaces.
struct Passage {
  std::optional<Hit> surface;  // that ends it
  Rgbd transmittance{1.0};     // of all media before that
  Rgbd lost{0.0};              // 1 - transmittance, exact also where that rounds to 0
  Rgbd scattered{0.0};         // the part of `lost` that is scattered, not absorbed
};
/// Takes a ray that starts in `medium` straight on to the first surface, by exact density integrals. The ray and
/// `medium` become those of the last stretch.
Passage pass_media(const Scene& scene, Ray& ray, MediumId& medium);

struct View {
  Passage passage;        // from the camera
  double distance = 0.0;  // m, from the camera to the first surface; 0 where there is none
  Vec3 normal{0.0f};      // shading normal of that surface in world space, unit, on the camera's side; 0 likewise
  Rgbd albedo{0.0};       // of what scatters light first, see view_along(), in [0, 1]
};

/// Of a ray of the scene's camera. The albedo is the mean over what can happen first to a path that starts there: at a
/// collision it is the single-scattering albedo; at a surface that is not specular the reflectance (of metal that at
/// normal incidence, of rough glass 1); 0 for what leaves the scene. Mirrors multiply by their reflectance that of what
/// they show; smooth glass mixes both sides by Fresnel's fraction, as long as the weaker one counts (both_sides()).
/// What has met kMostSpecular specular surfaces counts as white. No random numbers: one ray has one view.
View view_along(const Scene& scene, const Ray& camera_ray);
inline constexpr int kMostSpecular = 16;

}  // namespace vpm
