// What the camera sees, as layers of a picture: sums over the samples of a pass, and what films of these tell.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "vpm/image/image.h"
#include "vpm/render/film.h"
#include "vpm/render/settings.h"
#include "vpm/render/view.h"

namespace vpm {

/// How many films such layers need.
size_t view_films(const ViewLayerSet& layers);
/// How many films a render under these settings has besides its picture: those of layer_names(), then view_films().
size_t layer_films(const RenderSettings& settings);
/// How many channels all its layers fill, variances included.
size_t layer_channels(const RenderSettings& settings);

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
std::vector<NamedLayer> named_view_layers(const RenderSettings& settings, const Film& picture,
                                          std::span<const Film> films);
/// The depth where no sample sees a surface, m: that of Blender's.
inline constexpr float kNoDepth = 1e10f;

}  // namespace vpm
