// JSON in the places that the template has for it.
#include "compare/page.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <string_view>

#include "compare/page_template.h"
#include "json.h"
#include "vpm/image/half_pixels.h"
#include "vpm/medium/distance/strategy.h"
#include "vpm/medium/transmittance/estimator.h"

namespace vpm::tools {
namespace {

/// Bytes as text [Josefsson2006, sec. 4].
std::string base64(const std::vector<uint8_t>& bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (size_t i = 0; i < bytes.size(); i += 3) {
    const size_t count = std::min<size_t>(3, bytes.size() - i);
    uint32_t group = 0;
    for (size_t k = 0; k < 3; ++k) group = group << 8 | (k < count ? bytes[i + k] : 0u);
    for (size_t k = 0; k < 4; ++k) text += k <= count ? kDigits[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

/// Halves with their lower byte first.
Json picture_json(const Image& image) {
  const HalfPixels pixels = to_half(image);
  std::vector<uint8_t> bytes;
  bytes.reserve(2 * pixels.bits.size());
  for (const uint16_t half : pixels.bits) {
    bytes.push_back(static_cast<uint8_t>(half & 255));
    bytes.push_back(static_cast<uint8_t>(half >> 8));
  }
  return {{"exponent", pixels.exponent}, {"halves", base64(bytes)}};
}

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

/// JSON that ends no element of HTML: it has '<' in texts only, where an escape stands for it as well.
std::string inside_html(const std::string& json) {
  std::string safe;
  safe.reserve(json.size());
  for (const char c : json) c == '<' ? safe += "\\u003c" : safe += c;
  return safe;
}

/// The page with JSON in the place of a name; what stands before the place is taken off `rest`.
std::string up_to(std::string_view& rest, std::string_view place, const std::string& json) {
  const size_t at = rest.find(place);
  assert(at != std::string_view::npos);
  const std::string_view before = rest.substr(0, at);
  rest.remove_prefix(at + place.size());
  return std::string(before) + inside_html(json);
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
  std::string_view rest = page_template();
  std::string page = up_to(rest, "@results@", results);
  page += up_to(rest, "@about@", about_json());
  page += up_to(rest, "@pictures@", pictures_json(images));
  return page.append(rest);
}

}  // namespace vpm::tools
