// A difference counts where it is no chance, and no bias of kernels either.
#include "vpm/tune/shown_light.h"

#include <algorithm>
#include <cmath>

#include "vpm/image/metrics.h"

namespace vpm {
namespace {

Shown shown(const Moments& light, const Moments& correction) {
  return {light.mean(), std::sqrt(light.variance_of_mean()), correction.mean(),
          4.0 + 24.0 / static_cast<double>(light.count())};
}

/// A few passes say little of the standard error of one block: none is taken to be less sure than all are together.
void even_out(int channel, ShownLight& blocks) {
  double squares = 0.0, lights = 0.0;
  for (const std::array<Shown, 3>& block : blocks) {
    squares += block[channel].standard_error * block[channel].standard_error;
    lights += block[channel].mean * block[channel].mean;
  }
  const double relative = lights > 0.0 ? std::sqrt(squares / lights) : 0.0;
  for (std::array<Shown, 3>& block : blocks)
    block[channel].standard_error = std::max(block[channel].standard_error, relative * std::abs(block[channel].mean));
}

/// The relative square of the light that `other` surely shows and `own` does not; `mean` of the picture.
double unseen_square(const Shown& own, const Shown& other, double mean) {
  const double least = other.mean - other.sure * other.standard_error - 2.0 * std::abs(other.correction);
  const double most = own.mean + own.sure * own.standard_error + 2.0 * std::abs(own.correction);
  const double missing = std::max(0.0, least - most);
  return missing * missing / relative_scale(other.mean, mean);
}

/// The light of all blocks and channels, and its variance.
glm::dvec2 total(const ShownLight& light) {
  glm::dvec2 sum(0.0);
  for (const std::array<Shown, 3>& block : light)
    for (const Shown& shown : block) sum += glm::dvec2(shown.mean, shown.standard_error * shown.standard_error);
  return sum;
}

}  // namespace

void MeansOfPasses::add(const SmallPass& pass) {
  for (size_t first = 0; first < pass.found.size(); first += pixels_) {
    Rgbd sum(0.0);
    for (size_t i = first; i < first + pixels_; ++i) sum += Rgbd(pass.found[i].*part_);
    for (int channel = 0; channel < 3; ++channel)
      means_[first / pixels_][channel].add(sum[channel] / static_cast<double>(pixels_));
  }
}

std::vector<Rgbd> surely_shown(const MeansOfPasses& squares) {
  constexpr double kSure = 2.0;  // standard errors
  std::vector<Rgbd> surely;
  for (const MeansOfPasses::Channels& means : squares.means()) {
    Rgbd& least = surely.emplace_back(0.0);
    for (int channel = 0; channel < 3; ++channel)
      least[channel] = std::max(0.0, means[channel].mean() - kSure * std::sqrt(means[channel].variance_of_mean()));
  }
  return surely;
}

ShownLight shown_light(const MeansOfPasses& light, const MeansOfPasses& corrections) {
  ShownLight blocks(light.means().size());
  for (int channel = 0; channel < 3; ++channel) {
    for (size_t block = 0; block < blocks.size(); ++block)
      blocks[block][channel] = shown(light.means()[block][channel], corrections.means()[block][channel]);
    even_out(channel, blocks);
  }
  return blocks;
}

bool is_black(const ShownLight& light) { return total(light).x == 0.0; }

bool is_clearly_darker(const ShownLight& own, const ShownLight& other) {
  const glm::dvec2 less = total(own), more = total(other);
  return less.x < 0.9 * more.x && more.x - less.x > 2.0 * std::sqrt(less.y + more.y);
}

double unseen_by(const ShownLight& own, const ShownLight& other) {
  double missing = 0.0;
  for (int channel = 0; channel < 3; ++channel) {
    Moments lights, squares;
    for (const std::array<Shown, 3>& block : other) lights.add(block[channel].mean);
    if (!(lights.mean() > 0.0)) continue;
    for (size_t block = 0; block < own.size(); ++block)
      squares.add(unseen_square(own[block][channel], other[block][channel], lights.mean()));
    missing += squares.mean() / 3.0;
  }
  return missing;
}

}  // namespace vpm
