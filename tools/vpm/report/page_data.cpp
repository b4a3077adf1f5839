// Pictures are reduced to what a page can hold; descriptions of settings beside their values; options as a shell takes
// them. What else is shown is the report itself.
#include "report/page_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string_view>

#include "page/embedded.h"
#include "vpm/base/error.h"
#include "vpm/image/image.h"
#include "vpm/integrators/combined/technique.h"
#include "vpm/integrators/describe.h"
#include "vpm/job/settings_table.h"

namespace vpm::tools {
namespace {

/// Why a setting was chosen; null where it was not.
Json reason_of(const Json& report, const std::string& key) {
  for (const Json& choice : report.at("chosen"))
    if (choice.at("key") == key) return choice.at("reason");
  return nullptr;
}

/// A word as a shell reads it back.
std::string quoted(const std::string& word) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./,:@%";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string text = "'";
  for (const char c : word) c == '\'' ? text += "'\\''" : text += c;
  return text + "'";
}

/// The scene as it was rendered, without its choices: these are options, too.
std::string options_again(const Json& report) {
  std::string options;
  for (const std::string change : report.at("overrides")) {
    const std::string key = change.substr(0, change.find('='));
    if (reason_of(report, key).is_null()) options += " --set " + quoted(change);
  }
  if (!reason_of(report, "integrator.type").is_null())
    options += " --set integrator.type=auto";  // and no key of the file
  for (const Json& choice : report.at("chosen"))
    options += " --set " +
               quoted(fmt::format("{}={}", choice.at("key").get<std::string>(), choice.at("value").get<std::string>()));
  return options;
}

}  // namespace

Json shown_settings(const RenderReport& report) {
  Json rows = Json::array();
  RenderSettings settings = report.settings;
  for (const Setting& setting : describe(settings)) {
    if (setting.of_passes) continue;
    rows.push_back({{"key", setting.key},
                    {"value", text_of(setting.get())},
                    {"default", default_of(setting)},
                    {"is_default", setting.get() == setting.default_value},
                    {"meaning", setting.meaning},
                    {"values", values_of(setting)},
                    {"reason", reason_of(report.json, setting.key)}});
  }
  return rows;
}

Json commands_again(const Json& report) {
  if (std::filesystem::path(report.at("scene").get<std::string>()).extension() != ".toml") return Json::array();
  const std::string scene = quoted(report.at("scene")), image = report.at("image");
  const std::string options = options_again(report);
  const uint64_t seed = report.at("seed"), passes = report.at("passes");
  const std::string other = std::filesystem::path(image).replace_extension("other.exr").string();
  const auto render = [&](const std::string& to, uint64_t with_seed) {
    return fmt::format("vpm render {} -o {} --seed {} --passes {}{}", scene, quoted(to), with_seed, passes, options);
  };
  return {{{"does", "renders the same picture again, on any number of threads"}, {"command", render(image, seed)}},
          {{"does", "renders it with other random numbers"}, {"command", render(other, seed + 1)}},
          {{"does", "prints how far the two are apart"},
           {"command", fmt::format("vpm error {} {}", quoted(image), quoted(other))}},
          {{"does", "lists what the scene holds and what a render of it runs"},
           {"command", fmt::format("vpm info {}{}", scene, options)}}};
}

namespace {

/// A picture in the page: what it is, of which kPainters of the page has one each, and its name for people.
struct Shown {
  std::string kind, name;
  Image image;
};

/// Every square of pixels as their mean; squares at the right and lower border may be cut.
Image block_means(const Image& image, int block) {
  Image means((image.width + block - 1) / block, (image.height + block - 1) / block);
  for (int y = 0; y < means.height; ++y)
    for (int x = 0; x < means.width; ++x) {
      const int right = std::min(image.width, (x + 1) * block), bottom = std::min(image.height, (y + 1) * block);
      Rgbd sum(0.0);
      for (int v = y * block; v < bottom; ++v)
        for (int u = x * block; u < right; ++u) sum += Rgbd(image.at(u, v));
      means.at(x, y) = Rgb(sum / static_cast<double>((right - x * block) * (bottom - y * block)));
    }
  return means;
}

Image square_root(Image image) {
  for (Rgb& pixel : image.pixels)
    for (int c = 0; c < 3; ++c) pixel[c] = std::sqrt(pixel[c]);
  return image;
}

/// What the file has of radiance, variance, bias, and light of techniques, in the pixels that were rendered.
std::vector<Shown> layers_in(const RenderReport& report) {
  const ExrChannels& file = report.picture;
  const TechniqueSet& techniques = report.settings.combined.techniques;
  const Json& pixels = report.json.at("rendered_pixels");
  const PixelRect rendered{pixels.at("x0"), pixels.at("y0"), pixels.at("x1"), pixels.at("y1")};
  if (!lies_in(rendered, file.width, file.height))
    throw InputError("the pixels that the report calls rendered are none of the picture's");
  std::vector<Shown> all;
  const auto add = [&](const std::string& layer, const std::string& kind, const std::string& name) {
    if (const std::optional<Image> image = layer_of(file, layer))
      all.push_back({kind, name, cropped(*image, rendered)});
  };
  add("", "radiance", "radiance");
  if (all.empty()) throw InputError("the picture has no channels R, G and B");
  add("variance", "error", "standard error");
  add("bias", "bias", "bias");
  for (const TechniqueInfo& info : kTechniques)
    if (techniques.has(info.technique))
      add(fmt::format("combined.{}.weighted", info.name), "radiance", std::string(info.name));
  return all;
}

/// Standard errors are roots of means of variances: those of single pixels, as a reader of the picture meets them.
std::string pictures_json(const RenderReport& report) {
  const std::vector<Shown> layers = layers_in(report);
  const int block = block_for(layers[0].image.width, layers[0].image.height, layers.size());
  Json pictures = Json::array();
  int width = 0, height = 0;
  for (const Shown& layer : layers) {
    Image image = block_means(layer.image, block);
    if (layer.kind == "error") image = square_root(std::move(image));
    width = image.width;
    height = image.height;
    Json picture = picture_json(image);
    picture["kind"] = layer.kind;
    picture["name"] = layer.name;
    pictures.push_back(std::move(picture));
  }
  return Json{{"width", width}, {"height", height}, {"block", block}, {"pictures", std::move(pictures)}}.dump();
}

/// What each technique is, by name.
Json technique_words() {
  Json words = Json::object();
  for (const TechniqueInfo& info : kTechniques) words[std::string(info.name)] = info.summary;
  return words;
}

}  // namespace

int block_for(int width, int height, size_t pictures) {
  const size_t most = std::min(kMostPixels, kMostPixelsInAll / pictures);
  const auto pixels = [&](int block) {
    return static_cast<size_t>((width + block - 1) / block) * static_cast<size_t>((height + block - 1) / block);
  };
  int block = 1;
  while (pixels(block) > most) ++block;
  return block;
}

std::string report_page(const RenderReport& report) {
  std::string_view rest = report_template();
  const Json data{{"report", report.json},
                  {"seed", report.json.at("seed").dump()},  // all its digits
                  {"settings", shown_settings(report)},
                  {"techniques", technique_words()},
                  {"commands", commands_again(report.json)}};
  std::string page = up_to(rest, "@report@", data.dump());
  page += up_to(rest, "@pictures@", pictures_json(report));
  return page.append(rest);
}

}  // namespace vpm::tools
