// Sums over layers.
#include "vpm/job/found_by_techniques.h"

#include "vpm/image/metrics.h"
#include "vpm/integrators/combined/technique_layers.h"
#include "vpm/integrators/render_scene.h"

namespace vpm {
namespace {

/// Those in use whose layers are kept.
std::vector<TechniqueInfo> techniques_with_layers(const RenderSettings& settings, const RenderResult& result) {
  std::vector<TechniqueInfo> with;
  if (layer_names(settings).empty() || result.layers.empty()) return with;
  for (const TechniqueInfo& info : kTechniques)
    if (settings.combined.techniques.has(info.technique)) with.push_back(info);
  return with;
}

/// Over the number of pixels.
double light_in(const Film& layer) { return sum_channels(channel_means(layer.mean())); }

}  // namespace

std::vector<FoundByTechnique> found_by_techniques(const RenderSettings& settings, const RenderResult& result) {
  const std::vector<TechniqueInfo> techniques = techniques_with_layers(settings, result);
  if (techniques.empty()) return {};
  const Image picture = result.film.mean();
  double all = 0.0;
  for (const TechniqueInfo& info : techniques) all += light_in(result.layers[weighted_layer(info.technique)]);
  const auto over_all = [&](const Film& layer) { return all == 0.0 ? 0.0 : light_in(layer) / all; };
  std::vector<FoundByTechnique> found;
  for (const TechniqueInfo& info : techniques) {
    const Film& weighted = result.layers[weighted_layer(info.technique)];
    found.push_back({.name = std::string(info.name),
                     .share_of_light = over_all(weighted),
                     .found_alone = over_all(result.layers[unweighted_layer(info.technique)])});
    if (weighted.passes() > 1) found.back().variance = relative_variance(weighted.variance_of_mean(), picture);
  }
  return found;
}

std::vector<Image> parts_of_techniques(const RenderSettings& settings, const RenderResult& result) {
  std::vector<Image> parts;
  for (const TechniqueInfo& info : techniques_with_layers(settings, result))
    parts.push_back(result.layers[weighted_layer(info.technique)].mean());
  return parts;
}

}  // namespace vpm
