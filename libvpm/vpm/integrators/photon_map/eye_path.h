// The eye's side of photon mapping: the radiance along one camera ray.
#pragma once

#include <span>

#include "vpm/integrators/photon_map/lamp_images.h"
#include "vpm/integrators/photon_map/plan.h"

namespace vpm {

/// What eye paths read. Immutable while rays run.
struct EyeContext {
  const Scene& scene;
  const Estimators& estimators;
  int max_events = 100'000;  // of a path, counted from the camera on each branch; branches that are cut are counted
  const LampImages* lamp_images = nullptr;  // the pixels whose images of lamps have rays of their own; null: none
};

/// Follows a camera ray through boundaries and specular surfaces. Each segment adds what its medium scatters towards
/// the eye, as the estimators of volumes find it. The first non-specular surface adds what the estimator of surfaces
/// finds, and ends the path. At smooth glass the path goes on to both sides, each weighed by its fraction of the light,
/// until the weaker one is worth little; then one side is drawn. Returns radiance, W/(m^2 sr).
KernelEstimate eye_radiance(const EyeContext& context, const Ray& camera_ray, EyeWork& work);
/// The same for up to kEyeRays rays that lie side by side. As long as they go straight on from the camera they are
/// followed together, so that estimators can gather for all of them at once.
void eye_radiance(const EyeContext& context, std::span<EyeRay> rays);

/// The light of lamps that the pixel of `work` shows by way of mirrors and glass, W/(m^2 sr): the mean over so many
/// rays, which lie evenly in the pixel.
Rgb lamps_by_images(const EyeContext& context, EyeWork& work, uint32_t rays);

}  // namespace vpm
