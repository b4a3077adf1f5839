// JSON in the places that the template has for it.
#include "compare/page.h"

#include <cassert>
#include <string_view>

#include "json.h"
#include "page/embedded.h"
#include "vpm/medium/distance/strategy.h"
#include "vpm/medium/transmittance/estimator.h"

namespace vpm::tools {
namespace {

/// By scene: the reference, the first repetition of each method, the mean of each method, what each technique of each
/// method finds.
std::string pictures_json(const std::vector<PageImages>& scenes) {
  Json all = Json::array();
  for (const PageImages& scene : scenes) {
    Json pictures = Json::array({picture_json(scene.reference)});
    for (const MethodImages& method : scene.methods) pictures.push_back(picture_json(method.first));
    for (const MethodImages& method : scene.methods) pictures.push_back(picture_json(method.mean));
    for (const MethodImages& method : scene.methods)
      for (const Image& part : method.techniques) pictures.push_back(picture_json(part));
    all.push_back(
        {{"width", scene.reference.width}, {"height", scene.reference.height}, {"pictures", std::move(pictures)}});
  }
  return all.dump();
}

/// What each strategy is and how it fails.
std::string about_json() {
  Json distance = Json::array(), transmittance = Json::array();
  for (const StrategyInfo& info : distance_strategies())
    distance.push_back({{"name", info.name},
                        {"summary", info.summary},
                        {"failure", info.failure},
                        {"source", info.source},
                        {"heterogeneous", info.heterogeneous},
                        {"unbiased", info.unbiased},
                        {"bounded_weight", info.bounded_weight}});
  for (const EstimatorInfo& info : transmittance_estimators())
    transmittance.push_back({{"name", info.name},
                             {"summary", info.summary},
                             {"failure", info.failure},
                             {"source", info.source},
                             {"unbiased", info.unbiased}});
  return Json{{"distance", std::move(distance)}, {"transmittance", std::move(transmittance)}}.dump();
}

}  // namespace

MethodImages method_images(const std::vector<Image>& repetitions) {
  assert(!repetitions.empty());
  const Image& first = repetitions.front();
  Image mean(first.width, first.height);
  for (size_t i = 0; i < mean.pixels.size(); ++i) {
    Rgbd sum(0.0);
    for (const Image& image : repetitions) sum += Rgbd(image.pixels[i]);
    mean.pixels[i] = Rgb(sum / static_cast<double>(repetitions.size()));
  }
  return {first, std::move(mean)};
}

std::string results_page(const std::string& results, const std::vector<PageImages>& images) {
  std::string_view rest = compare_template();
  std::string page = up_to(rest, "@results@", results);
  page += up_to(rest, "@about@", about_json());
  page += up_to(rest, "@pictures@", pictures_json(images));
  return page.append(rest);
}

}  // namespace vpm::tools
