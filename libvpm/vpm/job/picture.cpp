// Layers and metadata of pictures.
#include "vpm/job/picture.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>

#include "vpm/base/version.h"
#include "vpm/film/view_layers.h"
#include "vpm/image/exr.h"
#include "vpm/image/statistics_of.h"
#include "vpm/integrators/combined/technique_layers.h"
#include "vpm/integrators/describe.h"
#include "vpm/integrators/render_scene.h"

namespace vpm {
namespace {

/// Where a picture is from.
using Metadata = std::vector<std::pair<std::string, std::string>>;

Metadata provenance(const RenderJob& job, const Film& film) {
  return {{"vpm.version", std::string(version())},
          {"vpm.scene", std::filesystem::path(job.source).filename().string()},
          {"vpm.sceneHash", job.hash},
          {"vpm.overrides", fmt::format("{}", fmt::join(job.overrides, " "))},
          {"vpm.settings", settings_line(job.settings)},
          {"vpm.seed", std::to_string(job.settings.seed)},
          {"vpm.passes", std::to_string(film.passes())}};
}

Image grey_image(const UvLayout& layout, const std::vector<float>& values) {
  Image image(layout.resolution, layout.resolution);
  std::transform(values.begin(), values.end(), image.pixels.begin(), [](float value) { return Rgb(value); });
  return image;
}

/// The meaning of layers of what the camera sees.
constexpr const char* kViewQuantities =
    "; depth: m to the first surface, 1e10 where there is none; normal: of that surface; albedo: of what scatters "
    "light first; transmittance: of the media before the first surface; single-scattering-albedo: of these media; "
    "emission: of these media, attenuated; "
    "samples: their number";

}  // namespace

std::vector<NamedLayer> picture_layers(const RenderSettings& settings, const RenderResult& result) {
  std::vector<NamedLayer> layers;
  if (result.film.passes() == 0) return layers;
  const std::vector<std::string> names = layer_names(settings);
  const std::span<const Film> films(result.layers);
  for (size_t i = 0; i < names.size(); ++i) {
    layers.push_back({names[i], "RGB", films[i].mean()});
    if (films[i].passes() > 1) layers.push_back({names[i] + ".variance", "RGB", films[i].variance_of_mean()});
  }
  for (NamedLayer& layer : named_view_layers(settings, result.film, films.subspan(names.size())))
    layers.push_back(std::move(layer));
  return layers;
}

void write_picture(const std::filesystem::path& path, const RenderJob& job, const RenderResult& result) {
  Metadata metadata = provenance(job, result.film);
  metadata.emplace_back(
      "vpm.quantity",
      std::string(
          "radiance, W/(m^2 sr); variance.*: variance of the mean of passes; bias.*: its kernels' bias as "
          "its photons show it, were it to go as the squared radius; vpm.varianceOfMeans: variance of the mean over "
          "pixels; combined.NAME.weighted: what a technique finds, times its share; combined.NAME.unweighted: "
          "without") +
          (job.settings.layers.empty() ? "" : kViewQuantities));
  const std::optional<FilmErrors> errors = errors_of(result);
  if (errors) {
    const Rgbd& means = errors->variance_of_channel_means;
    metadata.emplace_back(kVarianceOfMeans, fmt::format("{:.9g} {:.9g} {:.9g}", means.r, means.g, means.b));
    metadata.emplace_back(kStatisticsOf, key_of_statistics(result.film.mean(), errors->variance));
  }
  std::vector<ExrLayer> layers;
  if (errors) layers.push_back({"variance", &errors->variance});
  if (errors && result.film.shows_bias()) layers.push_back({"bias", &errors->bias});
  const std::vector<NamedLayer> more = picture_layers(job.settings, result);
  for (const NamedLayer& layer : more) layers.push_back({layer.name, &layer.image, layer.letters});
  const Camera& camera = job.scene.camera;
  write_exr(path, result.film.mean(), layers, metadata, ExrWindow{camera.rendered(), camera.width, camera.height});
}

Image light_map_of(const UvLayout& layout, const RenderResult& result) {
  return dilated(result.film.mean(), layout, kDilation);
}

void write_light_map(const std::filesystem::path& path, const RenderJob& job, const std::string& mesh,
                     const UvLayout& layout, const RenderResult& result) {
  const Image coverage = grey_image(layout, layout.coverage);
  const std::optional<FilmErrors> errors = errors_of(result);
  std::vector<ExrLayer> layers{{"coverage", &coverage}};
  if (errors) layers.push_back({"variance", &errors->variance});
  const Image map = light_map_of(layout, result);
  Metadata metadata = provenance(job, result.film);
  metadata.emplace_back("vpm.mesh", mesh);
  if (errors) metadata.emplace_back(kStatisticsOf, key_of_statistics(map, errors->variance));
  metadata.emplace_back("vpm.quantity",
                        "irradiance on the side of the outward normal, W/m^2; variance.*: variance of the mean of "
                        "passes; coverage.*: share of the texel that the mesh covers");
  metadata.emplace_back(
      "vpm.uncovered",
      fmt::format("texels of coverage 0, {} of {}: black, but within {} texels of covered ones the mean of their "
                  "neighbours; their variance is given as 0",
                  layout.texels() - layout.covered_texels(), layout.texels(), kDilation));
  write_exr(path, map, layers, metadata);
}

}  // namespace vpm
