// A picture of a file as vpm error compares it: its noise, where it is from, and how far it is
// from another.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "json.h"
#include "vpm/image/exr.h"
#include "vpm/image/metrics.h"
#include "vpm/integrators/describe.h"

namespace vpm::tools {

inline constexpr const char* kMse = "mean of (I - R)^2";
inline constexpr const char* kRelativeMse = "mean of (I - R)^2 / (R^2 + 0.01 mean(R)^2), mean(R) over the channel";
inline constexpr const char* kRelativeMseOfPbrt = "mean of (I - R)^2 / (R + 0.01)^2";

struct Errors {
  double mse, relative_mse, relative_mse_of_pbrt;
};
/// Throws InputError where the sizes differ.
void check_same_size(const Image& image, const std::string& path, const Image& reference, const std::string& to);
/// Throws InputError as check_same_size().
Errors errors_of(const Image& image, const std::string& path, const Image& reference, const std::string& to);

/// What a file says of where its picture is from; empty where it does not.
struct PictureOrigin {
  std::string scene, settings, seed;  // vpm.sceneHash, vpm.settings, vpm.seed
  std::optional<uint64_t> passes;     // vpm.passes

  std::optional<std::string> integrator() const { return integrator_of(settings); }
};

/// A picture of a file, with its noise.
struct ComparedPicture {
  NoisyImage picture;
  PictureOrigin origin;
  PixelRect held;  // the pixels that the file has

  bool is_crop() const { return held != PixelRect{0, 0, picture.image.width, picture.image.height}; }
};
/// Reads a layer of a file; empty: its picture (image/exr_layers.h). Says on stderr what was done to it, and why its
/// variances are not used where they belong to other pixels or are not finite.
ComparedPicture read_compared(const std::string& path, const std::string& layer);

/// Errors over pixels that are not finite are not either: says on stderr that the picture has such.
void warn_of_non_finite(const Image& image, const std::string& path);
/// A noise of the picture; null where it is not known.
Json noise_json(const NoisyImage& picture, double noise);

}  // namespace vpm::tools
