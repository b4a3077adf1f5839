// What each technique of the combined estimator finds, as pictures.
#pragma once

#include <string>
#include <vector>

#include "vpm/image/image.h"
#include "vpm/integrators/combined/combined.h"
#include "vpm/integrators/settings.h"

namespace vpm {

/// layer_names() of this integrator.
std::vector<std::string> layers_of_techniques(const RenderSettings& settings);

/// Where a technique's layers stand among them.
constexpr size_t weighted_layer(Technique technique) { return 2 * static_cast<size_t>(technique); }
constexpr size_t unweighted_layer(Technique technique) { return weighted_layer(technique) + 1; }

/// The sums of TechniqueParts of one pass, pixel by pixel. Different pixels may be added to at the same time.
class TechniqueLayers {
 public:
  TechniqueLayers(int width, int height);

  /// Adds one of so many samples.
  void add(size_t pixel, const TechniqueParts& parts, double samples);
  /// In the order of layer_names(), W/(m^2 sr).
  std::vector<Image> images() const;

 private:
  int width_, height_;
  std::vector<Rgbd> sums_;  // of a pixel's layers side by side
};

}  // namespace vpm
