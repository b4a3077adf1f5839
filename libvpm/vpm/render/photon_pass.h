// One pass of photon mapping: a pure function of scene, settings and pass number, and where pixels have radii of their
// own of these.
#pragma once

#include <string>
#include <vector>

#include "vpm/render/image_pass.h"
#include "vpm/render/pixel_disc.h"

namespace vpm {

/// What a scene needs: stages that would do nothing are not run.
struct Stages {
  bool volume_map = false;
  bool beams = false;  // it is gathered from along rays
  bool surface_map = false;
  bool volume_shadow_rays = false;
  bool equiangular = false;  // these start at a few distances instead of at every step
  bool surface_shadow_rays = false;
  bool final_gather = false;       // with a caustic map beside the surface map
  bool guided_gather = false;      // its rays guided by one more map
  bool irradiance_points = false;  // its rays end at points whose irradiance is known
  bool pixel_discs = false;        // the eye's gathers from the surface map have radii of the pixels' own
  bool photons() const { return volume_map || surface_map; }
  bool marched_shadow_rays() const { return volume_shadow_rays && !equiangular; }
  bool shadow_rays() const { return volume_shadow_rays || surface_shadow_rays; }
};
/// What of a scene scatters, and so asks for stages.
struct Scattering {
  bool media = false;
  bool surfaces = false;  // rough ones: mirrors and glass need no map
};
/// The stages that such a render runs; none by the path tracer.
Stages plan_stages(const Scattering& scattering, const RenderSettings& settings);
/// The same of a scene.
Stages plan_stages(const Scene& scene, const RenderSettings& settings);

struct TracedPhotons;
/// Traces the photons of pass number `pass`, for the maps of those stages.
TracedPhotons trace_pass(const Scene& scene, const RenderSettings& settings, const Stages& stages, int pass,
                         const std::atomic<bool>& stop, const PassProgress& progress, RenderStatistics& statistics);

struct EyeContext;
/// Traces the photons of pass number `pass` and sorts them into the maps of those stages.
EyeContext make_eye_context(const Scene& scene, const RenderSettings& settings, const Stages& stages, int pass,
                            const std::atomic<bool>& stop, const PassProgress& progress, RenderStatistics& statistics);

/// The squared radius of the pass's kernels over that of the first pass, of the first map that shrinks as the pass
/// number tells: the volume map, the surface map, the caustic map. All of these do so at nearly the same rate. 1 where
/// none does, 0 without photons.
double relative_square(const RenderSettings& settings, const Stages& stages, int pass);
/// The sections of the scene file whose maps are used but do not shrink from pass to pass as its number tells: their
/// kernels' bias cannot be seen.
std::vector<std::string> maps_of_unseen_bias(const RenderSettings& settings, const Stages& stages);

/// Radii that nothing is known of: their shares of the diagonal of the medium's bounds (grids) or of the scene. The
/// second where gathers go by count, and the radius only bounds them.
inline constexpr float kDefaultRadius = 0.01f, kDefaultSearch = 0.1f;
/// The radius of a map in the first pass: the settings', or where that is 0 such a share of the diagonal.
float first_volume_radius(const Scene& scene, const RenderSettings& settings, const Medium& medium);
float first_surface_radius(const Scene& scene, const RenderSettings& settings);
float first_caustic_radius(const Scene& scene, const RenderSettings& settings);

/// Renders pass number `pass`, from 0. Once `stop` is set it returns as soon as it can, with an image of no use.
Pass render_photon_pass(const Scene& scene, const RenderSettings& settings, int pass, const std::atomic<bool>& stop,
                        const PassProgress& progress = {});
/// The same after passes that have left such discs, under Stages::pixel_discs. Without discs none was before.
Pass render_photon_pass_after(const PixelDiscs& discs, const Scene& scene, const RenderSettings& settings, int pass,
                              const std::atomic<bool>& stop, const PassProgress& progress = {});

}  // namespace vpm
