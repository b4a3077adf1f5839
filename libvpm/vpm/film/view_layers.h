// What a ray from the camera comes through and to (media, the first surface, and what that scatters), and layers of a
// picture of it: sums over the samples of a pass, and layers made of films of these.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "vpm/film/film.h"
#include "vpm/film/pass_settings.h"
#include "vpm/image/image.h"
#include "vpm/scene/scene.h"

namespace vpm {

/// Media on the way to a surface, or out of the scene. Boundaries are no surfaces.
struct Passage {
  std::optional<Hit> surface;  // that ends it
  Rgbd transmittance{1.0};     // of all media before that
  Rgbd lost{0.0};              // 1 - transmittance, exact also where that rounds to 0
  Rgbd scattered{0.0};         // the part of `lost` that is scattered, not absorbed
  Rgbd emission{0.0};          // what media emit on the way, attenuated, W/(m^2 sr)
};
/// Takes a ray that starts in `medium` straight on to the first surface, by exact density integrals. The ray and
/// `medium` become those of the last segment.
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

/// How many films such layers need.
size_t view_films(const ViewLayerSet& layers);
/// How many channels they fill, variances included.
size_t view_channels(const ViewLayerSet& layers);

/// The sums of the views of one pass, pixel by pixel. Different pixels may be added to at the same time.
class ViewSums {
 public:
  ViewSums(const ViewLayerSet& layers, int width, int height);

  void add(size_t pixel, const View& view);
  /// The means of so many samples of each pixel, one for each of view_films().
  std::vector<Image> means(int samples) const;

 private:
  int width_, height_;
  ViewLayerSet layers_;
  size_t films_;
  std::vector<Rgbd> sums_;  // of a pixel's films side by side
};

/// The layers of a picture with view_films() films besides, of the same passes, one at least. From two passes on, each
/// layer that is a mean of samples is followed by NAME-variance: that of the mean. Depth and single-scattering albedo
/// are ratios of such means: of distances over the share of samples that see a surface, and of what is scattered over
/// what is lost.
std::vector<NamedLayer> named_view_layers(const PassSettings& settings, const Film& picture,
                                          std::span<const Film> films);
/// The depth where no sample sees a surface, m: that of Blender's.
inline constexpr float kNoDepth = 1e10f;

}  // namespace vpm
