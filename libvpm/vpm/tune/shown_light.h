// What passes of a pilot surely show, and what one way to render misses of that.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "vpm/base/floats.h"
#include "vpm/base/statistics/moments.h"
#include "vpm/integrators/small_pass.h"

namespace vpm {

/// What squared errors are divided by (relative_scale), for each channel of each square of kBlock pixels.
using Scales = std::vector<Rgbd>;
/// As many as all blocks have.
inline constexpr size_t kSquares = kAllBlocks * kBlockRays / kBlock;

/// Of values that are no NaN.
inline Moments moments_of_known(const std::vector<double>& values) {
  Moments moments;
  for (const double value : values)
    if (!std::isnan(value)) moments.add(value);
  return moments;
}

/// Over passes: the means of so many pixels one after another, at most those of a block, in the order of all blocks.
/// Those of blocks that were not followed count none.
class MeansOfPasses {
 public:
  using Channels = std::array<Moments, 3>;

  explicit MeansOfPasses(size_t pixels, Rgb KernelEstimate::*part = &KernelEstimate::value)
      : pixels_(pixels), part_(part), means_(kAllBlocks * kBlockRays / pixels) {}
  void add(const SmallPass& pass);
  int passes() const { return passes_; }
  const std::vector<Channels>& means() const { return means_; }

 private:
  size_t pixels_;
  Rgb KernelEstimate::*part_;
  std::vector<Channels> means_;
  int passes_ = 0;
};

/// Means that are known by two passes, less two standard errors, though not below 0; NaN elsewhere.
std::vector<Rgbd> surely_shown(const MeansOfPasses& squares);

/// What a channel of passes shows, and the kernels' correction of it.
struct Shown {
  double mean = NAN, standard_error = 0.0, correction = 0.0;
  double sure = 0.0;  // standard errors that are no chance: more where these are known by few passes
};
/// In each of all blocks; NaN where it was not followed.
using ShownLight = std::vector<std::array<Shown, 3>>;
ShownLight shown_light(const MeansOfPasses& light, const MeansOfPasses& corrections);

/// The relative square of the light that one way misses, but another shows in the same blocks, the mean of these: more
/// than four standard errors, or ten where four passes say them, and twice the correction of either above what it
/// shows.
double unseen_by(const ShownLight& own, const ShownLight& other);

}  // namespace vpm
