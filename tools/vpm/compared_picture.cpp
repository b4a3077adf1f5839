// What the metadata and layers of files tell.
#include "compared_picture.h"

#include <fmt/format.h>

#include <charconv>
#include <cstdio>

#include "vpm/base/error.h"
#include "vpm/image/metrics.h"
#include "vpm/job/picture.h"

namespace vpm::tools {
namespace {

std::optional<uint64_t> passes_of(const std::string& text) {
  uint64_t passes = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), passes);
  const bool whole = error == std::errc() && stop == text.data() + text.size() && passes > 0;
  return whole ? std::optional(passes) : std::nullopt;
}

}  // namespace

PictureOrigin origin_of(const ExrChannels& file) {
  const auto told = [&](const char* name) {
    const auto found = file.metadata.find(name);
    return found == file.metadata.end() ? std::string() : found->second;
  };
  return {told("vpm.sceneHash"), told("vpm.settings"), told("vpm.seed"), passes_of(told("vpm.passes"))};
}

NoisyImage read_picture(const std::string& path, const ExrChannels& file) {
  NoisyImage picture{read_exr(path), {}, {}};
  std::optional<Image> variance = layer_of(file, "variance");
  if (!variance) return picture;
  if (const size_t broken = non_finite_pixels(*variance); broken > 0) {
    fmt::print(stderr, "warning: {}: {} of its variances are not finite, so that none of them is used\n", path, broken);
    return picture;
  }
  picture.variance = std::move(variance);
  const auto means = file.metadata.find(kVarianceOfMeans);
  Rgbd of_means;
  if (means != file.metadata.end() &&
      std::sscanf(means->second.c_str(), "%lf %lf %lf", &of_means.r, &of_means.g, &of_means.b) == 3)
    picture.variance_of_channel_means = of_means;
  return picture;
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

bool is_crop(const ExrChannels& file) { return file.held != PixelRect{0, 0, file.width, file.height}; }

Json noise_json(const NoisyImage& picture, double noise) { return picture.variance ? number(noise) : Json(); }

}  // namespace vpm::tools
