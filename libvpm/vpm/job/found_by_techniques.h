// What each technique of the combined estimator has in a picture: as numbers, and as pictures.
#pragma once

#include <limits>
#include <string>
#include <tuple>
#include <vector>

#include "vpm/base/counters.h"
#include "vpm/image/image.h"
#include "vpm/integrators/settings.h"
#include "vpm/render/render.h"

namespace vpm {

/// Of one technique. Light is a sum over pixels and channels.
struct FoundByTechnique {
  std::string name;
  double share_of_light = 0.0;  // what it finds, times its shares, over what all techniques find; 0 where that is 0
  double found_alone = 0.0;     // without its shares, over the same; above 1 where it finds paths in several ways
  /// The part of the picture's relative MSE that the variance of share_of_light's layer makes. Techniques share random
  /// numbers, so the parts need not sum to the whole. Not a number below two passes.
  double variance = std::numeric_limits<double>::quiet_NaN();

  /// The numbers, with the names they have in files.
  static constexpr auto counters() {
    using F = FoundByTechnique;
    return std::tuple{Counter{"share_of_light", &F::share_of_light}, Counter{"found_alone", &F::found_alone},
                      Counter{"variance", &F::variance}};
  }
};

/// Of each technique in use; none where layers are not kept, or there is no pass.
std::vector<FoundByTechnique> found_by_techniques(const RenderSettings& settings, const RenderResult& result);

/// What the same techniques find, times their shares, W/(m^2 sr): pictures that sum to that of the render.
std::vector<Image> parts_of_techniques(const RenderSettings& settings, const RenderResult& result);

}  // namespace vpm
