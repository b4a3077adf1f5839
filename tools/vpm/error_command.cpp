// vpm error: how far pictures are from a reference, for people or as JSON.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>

#include "commands.h"
#include "json.h"
#include "vpm/base/error.h"
#include "vpm/base/line_fit.h"
#include "vpm/image/crop.h"
#include "vpm/image/exr.h"
#include "vpm/image/metrics.h"
#include "vpm/image/noisy_difference.h"
#include "vpm/job/picture.h"

namespace vpm::tools {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMse = "mean of (I - R)^2";
constexpr const char* kRelativeMse = "mean of (I - R)^2 / (R^2 + 0.01 mean(R)^2), mean(R) over the channel";
constexpr const char* kRelativeMseOfPbrt = "mean of (I - R)^2 / (R + 0.01)^2";

Json rgb(const Rgbd& c) { return Json::array({number(c.r), number(c.g), number(c.b)}); }

struct Errors {
  double mse, relative_mse, relative_mse_of_pbrt;
};

/// What a file tells of where its picture is from; empty where it does not.
struct Origin {
  std::string scene, settings, seed;  // vpm.sceneHash, vpm.settings, vpm.seed
  std::optional<uint64_t> passes;     // vpm.passes

  /// The first of the settings: with which of the integrators it was rendered.
  std::string integrator() const { return settings.substr(0, settings.find(' ')); }
};

std::optional<uint64_t> passes_of(const std::string& text) {
  uint64_t passes = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), passes);
  const bool whole = error == std::errc() && stop == text.data() + text.size() && passes > 0;
  return whole ? std::optional(passes) : std::nullopt;
}

Origin origin_of(const ExrChannels& file) {
  const auto told = [&](const char* name) {
    const auto found = file.metadata.find(name);
    return found == file.metadata.end() ? std::string() : found->second;
  };
  return {told("vpm.sceneHash"), told("vpm.settings"), told("vpm.seed"), passes_of(told("vpm.passes"))};
}

/// Do they draw the same random numbers for the same things, so that part of their noise is the same?
bool share_noise(const Origin& one, const Origin& other) {
  return !one.seed.empty() && one.seed == other.seed && one.integrator() == other.integrator();
}

/// The picture of a file with what it tells of its noise.
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

/// Throws InputError where the sizes differ.
Errors errors_of(const Image& image, const std::string& path, const Image& reference, const std::string& to) {
  if (image.width != reference.width || image.height != reference.height)
    throw InputError(fmt::format(
        "{} has {} x {} pixels and {} has {} x {}: render one of them at the size of the other, with --set "
        "film.width={} "
        "--set film.height={}; of two pictures, --resample brings one to the size of the other",
        path, image.width, image.height, to, reference.width, reference.height, reference.width, reference.height));
  return {mse(image, reference), relative_mse(image, reference), relative_mse_of_pbrt(image, reference)};
}

/// Errors over pixels that are not finite are not either: says which pictures have such.
void warn_of_non_finite(const Image& image, const std::string& path) {
  if (const size_t broken = non_finite_pixels(image))
    fmt::print(stderr, "warning: {}: {} of its pixels are not finite, so that errors are not\n", path, broken);
}

// --- Two pictures

Json noise_json(const NoisyImage& picture, double noise) { return picture.variance ? number(noise) : Json(); }

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
          {"width", image.width},
          {"height", image.height},
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

/// What of the relative MSE is noise, as far as the pictures tell.
void print_noise(const Pair& pair) {
  const NoisyDifference& d = pair.difference;
  if (!pair.picture.variance && !pair.reference.variance) {
    fmt::print("{:<14} neither picture tells its noise (layers variance.*)\n", "");
    return;
  }
  fmt::print("{:<14} {:.4g} +- {:.2g} less noise, of which {}, and {}\n", "", d.less_noise, d.standard_error,
             pair.picture.variance ? fmt::format("I has {:.2g}", d.noise) : "I tells none",
             pair.reference.variance ? fmt::format("R {:.2g}", d.noise_of_reference) : "R tells none");
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
  fmt::print("{} (I) against {} (R), {} x {} pixels{}\n", options.images[0], options.images[1], image.width,
             image.height,
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

NoisyImage cropped(const NoisyImage& picture, const PixelRect& rect) {
  if (rect.width() == picture.image.width && rect.height() == picture.image.height) return picture;
  NoisyImage part{cropped(picture.image, rect), {}, {}};
  if (picture.variance) part.variance = cropped(*picture.variance, rect);
  return part;  // what the means of all pixels vary says nothing of theirs
}

/// The pixels that both files have, where pictures are crops of one film.
PixelRect pixels_of_both(const ErrorOptions& options, const ExrChannels& picture, const ExrChannels& reference) {
  const PixelRect both = common_pixels(picture.held, reference.held);
  if (!lies_in(both, reference.width, reference.height))
    throw InputError(
        fmt::format("{} and {} have no pixel in common: they are crops", options.images[0], options.images[1]));
  return both;
}

/// A crop has no size to bring to another; whole pictures have.
bool is_crop(const ExrChannels& file) { return file.held != PixelRect{0, 0, file.width, file.height}; }

int compare_pair(const ErrorOptions& options) {
  check_output(options);
  const ExrChannels files[] = {read_exr_channels(options.images[0]), read_exr_channels(options.images[1])};
  Pair pair{read_picture(options.images[0], files[0]),
            read_picture(options.images[1], files[1]),
            share_noise(origin_of(files[0]), origin_of(files[1])),
            {},
            {},
            {}};
  if (options.resample) resample(options, pair.picture, pair.reference.image);
  if (is_crop(files[0]) || is_crop(files[1])) {
    if (options.resample) throw InputError("--resample is for whole pictures, and one of these is a crop");
    errors_of(pair.picture.image, options.images[0], pair.reference.image, options.images[1]);  // their sizes
    pair.crop = pixels_of_both(options, files[0], files[1]);
    pair.picture = cropped(pair.picture, *pair.crop);
    pair.reference = cropped(pair.reference, *pair.crop);
  }
  const Image& reference = pair.reference.image;
  const Image& image = pair.picture.image;
  pair.errors = errors_of(image, options.images[0], reference, options.images[1]);
  pair.difference = noisy_difference(pair.picture, pair.reference);
  if (!options.output.empty())
    write_exr(options.output, difference_of(image, reference), {},
              {{"vpm.quantity", "difference, image - reference"},
               {"vpm.image", fs::path(options.images[0]).filename().string()},
               {"vpm.reference", fs::path(options.images[1]).filename().string()}});
  warn_of_non_finite(image, options.images[0]);
  warn_of_non_finite(reference, options.images[1]);
  if (options.json)
    fmt::print("{}\n", report_of_pair(options, pair).dump(2, ' ', false, Json::error_handler_t::replace));
  else
    print_pair(options, pair);
  return 0;
}

// --- A series

/// What a reference's own noise adds to errors against it; 0 where it does not tell.
struct ReferenceNoise {
  double mse = 0.0, relative_mse = 0.0;
};

ReferenceNoise noise_of(const NoisyImage& reference) {
  if (!reference.variance) return {};
  const Rgbd variance = channel_means(*reference.variance);
  const NoisyImage exact{reference.image, {}, {}};
  return {(variance.r + variance.g + variance.b) / 3.0, noisy_difference(exact, reference).noise_of_reference};
}

/// A picture of a series.
struct Member {
  std::string path;
  Origin origin;
  Errors errors;

  double mse_less(const ReferenceNoise& noise) const { return errors.mse - noise.mse; }
  double relative_mse_less(const ReferenceNoise& noise) const { return errors.relative_mse - noise.relative_mse; }
};

/// How an error, less the reference's noise, falls with passes, error ~ passes^slope; or why that cannot be said.
struct Convergence {
  std::optional<LineFit> line;
  std::string why_not;
};

Convergence convergence_of(const std::vector<Member>& series, const ReferenceNoise& noise,
                           double (Member::*error)(const ReferenceNoise&) const) {
  std::vector<double> x, y;
  for (const Member& member : series) {
    const Origin &origin = member.origin, &first = series[0].origin;
    if (!origin.passes) return {std::nullopt, fmt::format("{} does not tell its passes (vpm.passes)", member.path)};
    if (origin.scene != first.scene || origin.settings != first.settings)
      return {std::nullopt, fmt::format("{} has another scene or other settings than {}", member.path, series[0].path)};
    const double value = (member.*error)(noise);
    if (!(value > 0.0) || std::isinf(value))
      return {std::nullopt,
              fmt::format("the error of {} is {:.4g}{}", member.path, value,
                          noise.mse > 0.0 ? ", less the noise of the reference: render that longer" : "")};
    x.push_back(std::log(static_cast<double>(*origin.passes)));
    y.push_back(std::log(value));
  }
  if (std::all_of(x.begin(), x.end(), [&](double value) { return value == x[0]; }))
    return {std::nullopt, "all pictures have the same number of passes"};
  return {fit_line(x, y), ""};
}

Json json_of(const Convergence& convergence) {
  if (!convergence.line) return {{"slope", nullptr}, {"why_not", convergence.why_not}};
  return {{"slope", number(convergence.line->slope)}, {"standard_error", number(convergence.line->slope_error)}};
}

void print_convergence(const char* name, const Convergence& convergence) {
  if (!convergence.line)
    fmt::print("{}: no slope over passes: {}\n", name, convergence.why_not);
  else if (std::isnan(convergence.line->slope_error))
    fmt::print("{} goes as passes^{:.3f} (two pictures: no error can be given)\n", name, convergence.line->slope);
  else
    fmt::print("{} goes as passes^{:.3f} +- {:.3f}, for pictures that are independent of each other\n", name,
               convergence.line->slope, convergence.line->slope_error);
}

void print_series(const std::vector<Member>& series, const std::string& to, const Image& reference,
                  const ReferenceNoise& noise) {
  fmt::print("against {} (R), {} x {} pixels\n  MSE: {}\n  relMSE: {}\n  pbrt's MRSE: {}\n", to, reference.width,
             reference.height, kMse, kRelativeMse, kRelativeMseOfPbrt);
  fmt::print("{:>8} {:>12} {:>12} {:>12}  image (I)\n", "passes", "MSE", "relMSE", "pbrt's MRSE");
  for (const Member& m : series)
    fmt::print("{:>8} {:>12.6g} {:>12.6g} {:>12.6g}  {}\n", m.origin.passes ? std::to_string(*m.origin.passes) : "?",
               m.errors.mse, m.errors.relative_mse, m.errors.relative_mse_of_pbrt, m.path);
  if (noise.mse > 0.0)
    fmt::print(
        "of each MSE {:.3g}, and of each relMSE {:.3g}, are noise of the reference: slopes are of what is left\n",
        noise.mse, noise.relative_mse);
}

void print_series_json(const std::vector<Member>& series, const std::string& to, const NoisyImage& reference,
                       const ReferenceNoise& noise, const Convergence& of_mse, const Convergence& of_relative) {
  Json members = Json::array();
  for (const Member& m : series)
    members.push_back({{"image", m.path},
                       {"passes", m.origin.passes ? Json(*m.origin.passes) : Json(nullptr)},
                       {"mse", number(m.errors.mse)},
                       {"relative_mse", number(m.errors.relative_mse)},
                       {"relative_mse_of_pbrt", number(m.errors.relative_mse_of_pbrt)}});
  const Json report{
      {"reference", to},
      {"width", reference.image.width},
      {"height", reference.image.height},
      {"noise_of_reference",
       {{"mse", noise_json(reference, noise.mse)}, {"relative_mse", noise_json(reference, noise.relative_mse)}}},
      {"formulas", {{"mse", kMse}, {"relative_mse", kRelativeMse}, {"relative_mse_of_pbrt", kRelativeMseOfPbrt}}},
      {"series", std::move(members)},
      {"over_passes", {{"mse", json_of(of_mse)}, {"relative_mse", json_of(of_relative)}}}};
  fmt::print("{}\n", report.dump(2, ' ', false, Json::error_handler_t::replace));
}

void refuse_crop(const std::string& path, const ExrChannels& file) {
  if (is_crop(file))
    throw InputError(fmt::format("{} is a crop: a series is of whole pictures; two pictures are compared there", path));
}

int compare_series(const ErrorOptions& options) {
  const std::string& to = options.images.back();
  refuse_crop(to, read_exr_channels(to));
  const NoisyImage reference = read_picture(to, read_exr_channels(to));
  std::vector<Member> series;
  for (size_t i = 0; i + 1 < options.images.size(); ++i) {
    const std::string& path = options.images[i];
    const Image image = read_exr(path);
    const ExrChannels file = read_exr_channels(path);
    refuse_crop(path, file);
    series.push_back({path, origin_of(file), errors_of(image, path, reference.image, to)});
    warn_of_non_finite(image, path);
  }
  warn_of_non_finite(reference.image, to);
  const ReferenceNoise noise = noise_of(reference);
  const Convergence of_mse = convergence_of(series, noise, &Member::mse_less);
  const Convergence of_relative = convergence_of(series, noise, &Member::relative_mse_less);
  if (options.json) {
    print_series_json(series, to, reference, noise, of_mse, of_relative);
    return 0;
  }
  print_series(series, to, reference.image, noise);
  print_convergence("MSE", of_mse);
  print_convergence("relMSE", of_relative);
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
