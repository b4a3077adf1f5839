// What passes of a pilot surely show, and what one way to render misses of that.
#pragma once

#include <array>
#include <vector>

#include "vpm/base/floats.h"
#include "vpm/base/statistics/moments.h"
#include "vpm/integrators/small_pass.h"

namespace vpm {

/// What squared errors are divided by (relative_scale), for each channel of each square of kBlock pixels.
using Scales = std::vector<Rgbd>;
inline constexpr size_t kSquares = kSmallRays / kBlock;

inline Moments moments_of(const std::vector<double>& values) {
  Moments moments;
  for (const double value : values) moments.add(value);
  return moments;
}

/// Over passes: the means of so many pixels one after another, at most those of a block.
class MeansOfPasses {
 public:
  using Channels = std::array<Moments, 3>;

  explicit MeansOfPasses(size_t pixels, Rgb KernelEstimate::*part = &KernelEstimate::value)
      : pixels_(pixels), part_(part), means_(kSmallRays / pixels) {}
  void add(const SmallPass& pass);
  const std::vector<Channels>& means() const { return means_; }

 private:
  size_t pixels_;
  Rgb KernelEstimate::*part_;
  std::vector<Channels> means_;
};

/// Means less two standard errors, though not below 0. Of two passes or more, as all that follows.
std::vector<Rgbd> surely_shown(const MeansOfPasses& squares);

/// What a channel of passes shows in a block, and the kernels' correction of it.
struct Shown {
  double mean = 0.0, standard_error = 0.0, correction = 0.0;
  double sure = 0.0;  // standard errors that are no chance: more where these are known by few passes
};
using ShownLight = std::vector<std::array<Shown, 3>>;
ShownLight shown_light(const MeansOfPasses& light, const MeansOfPasses& corrections);

bool is_black(const ShownLight& light);  // in all blocks
/// Is the light of all blocks less than nine tenths of another's, and by more than two standard errors of both?
bool is_clearly_darker(const ShownLight& own, const ShownLight& other);
/// The relative square of the light that one way misses, but another shows in the same blocks, the mean of these: what
/// the other shows beyond it by more than four standard errors of both (ten where four passes say them), and by twice
/// the corrections of both.
double unseen_by(const ShownLight& own, const ShownLight& other);

}  // namespace vpm
