// vpm error: how far a picture is from a reference, for people or as JSON.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>

#include "commands.h"
#include "compared_picture.h"
#include "vpm/base/error.h"
#include "vpm/image/exr.h"
#include "vpm/image/image.h"
#include "vpm/image/metrics.h"

namespace vpm::tools {
namespace {

namespace fs = std::filesystem;

Json rgb(const Rgbd& c) { return Json::array({number(c.r), number(c.g), number(c.b)}); }

/// Do they draw the same random numbers for the same things, so that part of their noise is the same?
bool share_noise(const PictureOrigin& one, const PictureOrigin& other) {
  return !one.seed.empty() && one.seed == other.seed && one.integrator() == other.integrator();
}

Image difference_of(const Image& image, const Image& reference) {
  Image difference(image.width, image.height);
  for (size_t i = 0; i < image.pixels.size(); ++i) difference.pixels[i] = image.pixels[i] - reference.pixels[i];
  return difference;
}

/// The path of the difference, which must be writable, end in .exr and be none of the pictures.
void check_output(const ErrorOptions& options) {
  if (options.output.empty()) return;
  if (fs::path(options.output).extension() != ".exr")
    throw InputError(fmt::format("{}: the difference is an EXR file, its name must end in .exr", options.output));
  for (const std::string& path : options.images)
    if (std::error_code none; fs::equivalent(options.output, path, none))
      throw InputError(fmt::format("cannot write '{}': it is one of the pictures; name another file", options.output));
}

/// Two pictures of one size, and how far they are apart.
struct Pair {
  NoisyImage picture, reference;
  bool same_seed;                 // do they share noise?
  std::optional<PixelRect> crop;  // of their film, where they are compared there alone
  glm::ivec2 film{0};             // its size then, pixels
  Errors errors;
  NoisyDifference difference;
};

Json report_of_pair(const ErrorOptions& options, const Pair& pair) {
  const Image &image = pair.picture.image, &reference = pair.reference.image;
  const Errors& errors = pair.errors;
  const NoisyDifference& difference = pair.difference;
  const Rgbd of_image = channel_means(image), of_reference = channel_means(reference);
  Json worst = Json::array();
  const PixelRect crop = pair.crop.value_or(PixelRect{});
  for (const PixelError& pixel : worst_pixels(image, reference, static_cast<size_t>(options.worst)))
    worst.push_back({{"x", crop.x0 + pixel.x},
                     {"y", crop.y0 + pixel.y},
                     {"image", rgb(image.at(pixel.x, pixel.y))},
                     {"reference", rgb(reference.at(pixel.x, pixel.y))},
                     {"relative_square", number(pixel.error)}});
  return {{"image", options.images[0]},
          {"reference", options.images[1]},
          {"layer", options.layer.empty() ? Json() : Json(options.layer)},
          {"reference_layer", options.reference_layer.empty() ? Json() : Json(options.reference_layer)},
          {"width", image.width},
          {"height", image.height},
          {"crop", pair.crop ? Json{{"x0", crop.x0}, {"y0", crop.y0}, {"x1", crop.x1}, {"y1", crop.y1}} : Json()},
          {"same_seed", pair.same_seed},
          {"mse", {{"value", number(errors.mse)}, {"is", kMse}}},
          {"relative_mse",
           {{"value", number(errors.relative_mse)},
            {"is", kRelativeMse},
            {"less_noise", number(difference.less_noise)},
            {"standard_error", number(difference.standard_error)},
            {"noise", noise_json(pair.picture, difference.noise)},
            {"noise_of_reference", noise_json(pair.reference, difference.noise_of_reference)}}},
          {"relative_mse_of_pbrt", {{"value", number(errors.relative_mse_of_pbrt)}, {"is", kRelativeMseOfPbrt}}},
          {"means",
           {{"image", rgb(of_image)},
            {"reference", rgb(of_reference)},
            {"difference", rgb(difference.of_channel_means)},
            {"standard_error_of_difference", rgb(difference.standard_errors)},
            {"standard_error_knows_correlation", difference.means_know_correlation}}},
          {"non_finite_pixels", {{"image", non_finite_pixels(image)}, {"reference", non_finite_pixels(reference)}}},
          {"worst_pixels", std::move(worst)}};
}

/// What of the relative MSE is noise, as far as the pictures have variances.
void print_noise(const Pair& pair) {
  const NoisyDifference& d = pair.difference;
  if (!pair.picture.variance && !pair.reference.variance) {
    fmt::print("{:<14} neither picture has its variance (layers variance.*)\n", "");
    return;
  }
  fmt::print("{:<14} {:.4g} +- {:.2g} less noise, of which {}, and {}\n", "", d.less_noise, d.standard_error,
             pair.picture.variance ? fmt::format("I has {:.2g}", d.noise) : "I has none",
             pair.reference.variance ? fmt::format("R {:.2g}", d.noise_of_reference) : "R has none");
  if (pair.same_seed)
    fmt::print(
        "{:<14} both are of the same seed: what noise they share does not show; render one with another --seed\n", "");
  else if (pair.picture.variance && d.noise_of_reference > d.noise)
    fmt::print("{:<14} the reference is noisier than the picture: render it longer\n", "");
}

void print_pair(const ErrorOptions& options, const Pair& pair) {
  const Image &image = pair.picture.image, &reference = pair.reference.image;
  const Errors& errors = pair.errors;
  const NoisyDifference& difference = pair.difference;
  const PixelRect crop = pair.crop.value_or(PixelRect{});
  const auto of_layer = [](const std::string& layer) { return layer.empty() ? "" : ", layer " + layer; };
  fmt::print("{} (I{}) against {} (R{}), {} x {} pixels{}\n", options.images[0], of_layer(options.layer),
             options.images[1], of_layer(options.reference_layer), image.width, image.height,
             pair.crop ? fmt::format(", ({}, {}) to ({}, {}) of the film, which both have", crop.x0, crop.y0,
                                     crop.x1 - 1, crop.y1 - 1)
                       : "");
  fmt::print("{:<14} {:<12.6g} {}\n", "MSE", errors.mse, kMse);
  fmt::print("{:<14} {:<12.6g} {}\n", "relMSE", errors.relative_mse, kRelativeMse);
  print_noise(pair);
  fmt::print("{:<14} {:<12.6g} {}\n", "pbrt's MRSE", errors.relative_mse_of_pbrt, kRelativeMseOfPbrt);
  const Rgbd of_image = channel_means(image), of_reference = channel_means(reference);
  const auto print_means = [](const char* name, const Rgbd& c) {
    fmt::print("{:<14} {:<12.6g} {:<12.6g} {:<12.6g}\n", name, c.r, c.g, c.b);
  };
  fmt::print("{:<14} {:<12} {:<12} {:<12}\n", "means", "red", "green", "blue");
  print_means("  I", of_image);
  print_means("  R", of_reference);
  print_means("  I - R", difference.of_channel_means);
  if (pair.picture.variance || pair.reference.variance) {
    print_means("  +-", difference.standard_errors);
    if (!difference.means_know_correlation) fmt::print("{:<14} were pixels independent of each other\n", "");
  }
  if (options.worst > 0)
    fmt::print("worst pixels (column and row from the top left): I, R, (I - R)^2 / (R^2 + 0.01 mean(R)^2)\n");
  for (const PixelError& pixel : worst_pixels(image, reference, static_cast<size_t>(options.worst))) {
    const Rgb i = image.at(pixel.x, pixel.y), r = reference.at(pixel.x, pixel.y);
    fmt::print("  {:>5} {:>5}  ({:.4g}, {:.4g}, {:.4g})  ({:.4g}, {:.4g}, {:.4g})  {:.3g}\n", crop.x0 + pixel.x,
               crop.y0 + pixel.y, i.r, i.g, i.b, r.r, r.g, r.b, pixel.error);
  }
}

/// Brings a picture to the size of the reference. Throws InputError where their shapes differ by more than rounding of
/// a width or a height makes.
void resample(const ErrorOptions& options, NoisyImage& picture, const Image& reference) {
  const int64_t width = picture.image.width, height = picture.image.height;
  const int64_t apart = std::abs(width * reference.height - height * reference.width);
  if (2 * apart > std::max(width, height) + std::max(reference.width, reference.height))
    throw InputError(
        fmt::format("{} has {} x {} pixels and {} has {} x {}: they are of different shapes, and --resample does "
                    "not stretch pictures",
                    options.images[0], width, height, options.images[1], reference.width, reference.height));
  picture = resampled(picture, reference.width, reference.height);
}

/// What the means of all pixels of a file vary says nothing of those of a part of them.
NoisyImage cropped(const NoisyImage& picture, const PixelRect& held, const PixelRect& rect) {
  NoisyImage part{cropped(picture.image, rect), {}, {}};
  if (picture.variance) part.variance = cropped(*picture.variance, rect);
  if (held == rect) part.variance_of_channel_means = picture.variance_of_channel_means;
  return part;
}

/// The pixels that both files have, where pictures are crops of one film.
PixelRect pixels_of_both(const ErrorOptions& options, const PixelRect& picture, const PixelRect& reference,
                         const glm::ivec2& film) {
  const PixelRect both = common_pixels(picture, reference);
  if (!lies_in(both, film.x, film.y))
    throw InputError(
        fmt::format("{} and {} have no pixel in common: they are crops", options.images[0], options.images[1]));
  return both;
}

/// Cuts both to the pixels that both have, of films of one size.
void crop(const ErrorOptions& options, const PixelRect& picture, const PixelRect& reference, Pair& pair) {
  if (options.resample) throw InputError("--resample is for whole pictures, and one of these is a crop");
  check_same_size(pair.picture.image, options.images[0], pair.reference.image, options.images[1]);
  pair.film = {pair.reference.image.width, pair.reference.image.height};
  pair.crop = pixels_of_both(options, picture, reference, pair.film);
  pair.picture = cropped(pair.picture, picture, *pair.crop);
  pair.reference = cropped(pair.reference, reference, *pair.crop);
}

int compare_pair(const ErrorOptions& options) {
  check_output(options);
  const ComparedPicture one = read_compared(options.images[0], options.layer);
  const ComparedPicture other = read_compared(options.images[1], options.reference_layer);
  Pair pair{one.picture, other.picture, share_noise(one.origin, other.origin), {}, {}, {}, {}};
  if (one.is_crop() || other.is_crop()) crop(options, one.held, other.held, pair);
  if (options.resample) resample(options, pair.picture, pair.reference.image);
  const Image& reference = pair.reference.image;
  const Image& image = pair.picture.image;
  pair.errors = errors_of(image, options.images[0], reference, options.images[1]);
  pair.difference = noisy_difference(pair.picture, pair.reference);
  if (!options.output.empty()) {
    std::optional<ExrWindow> part;
    if (pair.crop) part = ExrWindow{*pair.crop, pair.film.x, pair.film.y};
    write_exr(options.output, difference_of(image, reference), {},
              {{"vpm.quantity", "difference, image - reference"},
               {"vpm.image", fs::path(options.images[0]).filename().string()},
               {"vpm.reference", fs::path(options.images[1]).filename().string()}},
              part);
  }
  warn_of_non_finite(image, options.images[0]);
  warn_of_non_finite(reference, options.images[1]);
  if (options.json)
    fmt::print("{}\n", report_of_pair(options, pair).dump(2, ' ', false, Json::error_handler_t::replace));
  else
    print_pair(options, pair);
  return 0;
}

}  // namespace

int error_command(const ErrorOptions& options) {
  if (options.series && options.images.size() < 2)
    throw InputError("error: a series is one picture or more and, last, the reference");
  if (!options.series && options.images.size() != 2)
    throw InputError(
        fmt::format("error: two pictures, a picture and its reference, not {}; of several against one "
                    "reference, the last, make a --series",
                    options.images.size()));
  return options.series ? compare_series(options) : compare_pair(options);
}

}  // namespace vpm::tools
