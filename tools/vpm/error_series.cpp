// Several pictures against one reference: a line each, and the slope of their errors over passes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "commands.h"
#include "compared_picture.h"
#include "vpm/base/error.h"
#include "vpm/base/statistics/line_fit.h"
#include "vpm/image/metrics.h"

namespace vpm::tools {
namespace {

/// What a reference's own noise adds to errors against it; 0 where it is not known.
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
  PictureOrigin origin;
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
    const PictureOrigin &origin = member.origin, &first = series[0].origin;
    if (!origin.passes) return {std::nullopt, fmt::format("{} does not state its passes (vpm.passes)", member.path)};
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

void refuse_crop(const std::string& path, const ComparedPicture& picture) {
  if (picture.is_crop())
    throw InputError(fmt::format("{} is a crop: a series is of whole pictures; two pictures are compared there", path));
}

}  // namespace

int compare_series(const ErrorOptions& options) {
  const std::string& to = options.images.back();
  const ComparedPicture last = read_compared(to, options.reference_layer);
  refuse_crop(to, last);
  const NoisyImage& reference = last.picture;
  std::vector<Member> series;
  for (size_t i = 0; i + 1 < options.images.size(); ++i) {
    const std::string& path = options.images[i];
    const ComparedPicture member = read_compared(path, options.layer);
    refuse_crop(path, member);
    const Image& image = member.picture.image;
    series.push_back({path, member.origin, errors_of(image, path, reference.image, to)});
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

}  // namespace vpm::tools
