// What the metadata and layers of files say.
#include "compared_picture.h"

#include <fmt/format.h>

#include <charconv>
#include <cstdio>

#include "vpm/base/error.h"
#include "vpm/image/metrics.h"
#include "vpm/image/statistics_of.h"
#include "vpm/job/picture.h"

namespace vpm::tools {
namespace {

std::optional<uint64_t> passes_of(const std::string& text) {
  uint64_t passes = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), passes);
  const bool whole = error == std::errc() && stop == text.data() + text.size() && passes > 0;
  return whole ? std::optional(passes) : std::nullopt;
}

PictureOrigin origin_of(const std::map<std::string, std::string>& metadata) {
  const auto said = [&](const char* name) {
    const auto found = metadata.find(name);
    return found == metadata.end() ? std::string() : found->second;
  };
  return {said("vpm.sceneHash"), said("vpm.settings"), said("vpm.seed"), passes_of(said("vpm.passes"))};
}

/// The variances of a file that has its picture without a name, as vpm writes it; nothing where they are not to be
/// used.
std::optional<Image> variance_of(const std::string& path, const ExrPicture& picture) {
  std::optional<Image> variance = layer_of(picture.file, "variance");
  if (!variance) return std::nullopt;
  const auto leave_out = [&](const std::string& why) {
    fmt::print(stderr, "warning: {}: its layers of statistics are not used: {}\n", path, why);
    return std::nullopt;
  };
  if (const std::string why = why_statistics_do_not_fit(picture, *variance); !why.empty()) return leave_out(why);
  if (const size_t broken = non_finite_pixels(*variance); broken > 0)
    return leave_out(fmt::format("{} of the variances are not finite", broken));
  if (!picture.file.metadata.contains(kStatisticsOf))
    fmt::print(stderr,
               "note: {}: it does not say for which pixels its variances were made; they are taken for its own\n",
               path);
  return variance;
}

std::optional<Rgbd> variance_of_means(const ExrChannels& file) {
  const auto means = file.metadata.find(kVarianceOfMeans);
  Rgbd found;
  const bool given = means != file.metadata.end() &&
                     std::sscanf(means->second.c_str(), "%lf %lf %lf", &found.r, &found.g, &found.b) == 3;
  return given ? std::optional(found) : std::nullopt;
}

}  // namespace

ComparedPicture read_compared(const std::string& path, const std::string& layer) {
  ExrPicture read = read_exr_picture(path, layer, layer.empty() ? ExrPlanes::statistics : ExrPlanes::colour);
  for (const std::string& note : read.notes) fmt::print(stderr, "note: {}: {}\n", path, note);
  ComparedPicture compared{{{}, {}, {}}, origin_of(read.file.metadata), read.file.held};
  if (layer.empty()) compared.picture.variance = variance_of(path, read);
  if (compared.picture.variance) compared.picture.variance_of_channel_means = variance_of_means(read.file);
  compared.picture.image = std::move(read.image);
  return compared;
}

void check_same_size(const Image& image, const std::string& path, const Image& reference, const std::string& to) {
  if (image.width == reference.width && image.height == reference.height) return;
  throw InputError(fmt::format(
      "{} has {} x {} pixels and {} has {} x {}: render one of them at the size of the other, with --size {}x{}; of "
      "two "
      "pictures, --resample brings one to the size of the other",
      path, image.width, image.height, to, reference.width, reference.height, reference.width, reference.height));
}

Errors errors_of(const Image& image, const std::string& path, const Image& reference, const std::string& to) {
  check_same_size(image, path, reference, to);
  return {mse(image, reference), relative_mse(image, reference), relative_mse_of_pbrt(image, reference)};
}

void warn_of_non_finite(const Image& image, const std::string& path) {
  if (const size_t broken = non_finite_pixels(image))
    fmt::print(stderr, "warning: {}: {} of its pixels are not finite, so that errors are not\n", path, broken);
}

Json noise_json(const NoisyImage& picture, double noise) { return picture.variance ? number(noise) : Json(); }

}  // namespace vpm::tools
