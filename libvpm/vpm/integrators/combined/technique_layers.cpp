// Sums of parts.
#include "vpm/integrators/combined/technique_layers.h"

#include <fmt/format.h>

namespace vpm {
namespace {

constexpr size_t kLayers = 2 * kTechniques.size();

}  // namespace

std::vector<std::string> layers_of_techniques(const RenderSettings& settings) {
  if (!settings.combined.layers) return {};
  std::vector<std::string> names;
  for (const TechniqueInfo& info : kTechniques)
    for (const char* const part : {"weighted", "unweighted"})
      names.push_back(fmt::format("combined.{}.{}", info.name, part));
  return names;
}

TechniqueLayers::TechniqueLayers(int width, int height)
    : width_(width), height_(height), sums_(kLayers * static_cast<size_t>(width) * static_cast<size_t>(height)) {}

void TechniqueLayers::add(size_t pixel, const TechniqueParts& parts, double samples) {
  for (size_t t = 0; t < kTechniques.size(); ++t) {
    Rgbd* const sums = &sums_[kLayers * pixel + 2 * t];
    sums[0] += Rgbd(parts.weighted[t]) / samples;
    sums[1] += Rgbd(parts.unweighted[t]) / samples;
  }
}

std::vector<Image> TechniqueLayers::images() const {
  std::vector<Image> images(kLayers, Image(width_, height_));
  for (size_t i = 0; i < sums_.size(); ++i) images[i % kLayers].pixels[i / kLayers] = Rgb(sums_[i]);
  return images;
}

}  // namespace vpm
