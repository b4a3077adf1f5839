// Passes over the pixels: what one gives, where it reports progress, and sets of pass numbers.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "vpm/base/progress.h"
#include "vpm/estimate/statistics.h"
#include "vpm/image/image.h"
#include "vpm/photon/kernel.h"

namespace vpm {

struct Pass {
  Image image;                  // radiance, W/(m^2 sr)
  Image correction;             // what would take away a bias of its kernels that goes as r^2 (KernelPair)
  std::vector<Image> layers;    // layer_films() of them: parts of the radiance, then what the camera sees
  std::vector<uint64_t> found;  // photons in each pixel's disc, over its samples, where pixels have discs of their own
  RenderStatistics statistics;

  /// Black.
  Pass(int width, int height) : image(width, height), correction(width, height) { statistics.passes = 1; }
  void set(int x, int y, const KernelEstimate& pixel) {
    image.at(x, y) = pixel.value;
    correction.at(x, y) = pixel.correction;
  }
};

/// Where a pass reports progress. Either may be missing.
struct PassProgress {
  bool stages = false;        // a bar for each stage of the pass
  Progress* tiles = nullptr;  // advanced by the pass's units of work in its course
};

/// Numbers first, first + 1, ... end - 1.
struct PassRange {
  int first = 0, end = 0;

  bool operator==(const PassRange&) const = default;
};

/// A set of pass numbers >= 0, as the ranges that they make.
class PassSet {
 public:
  PassSet() = default;
  /// Ranges in rising order that neither overlap nor touch; see is_valid().
  explicit PassSet(std::vector<PassRange> ranges) : ranges_(std::move(ranges)) {}
  static bool is_valid(const std::vector<PassRange>& ranges) {
    int least = 0;
    for (const PassRange& range : ranges) {
      if (range.first < least || range.end <= range.first) return false;
      least = range.end + (range.end < std::numeric_limits<int>::max());
    }
    return true;
  }

  const std::vector<PassRange>& ranges() const { return ranges_; }
  int count() const { return count_of(0, 1); }
  /// Those that leave the rest `rest` when divided by `divisor` > rest.
  int count_of(int rest, int divisor) const {
    const auto below = [&](int end) { return end / divisor + (end % divisor > rest); };
    int count = 0;
    for (const PassRange& range : ranges_) count += below(range.end) - below(range.first);
    return count;
  }
  bool overlaps(const PassRange& other) const {
    return std::any_of(ranges_.begin(), ranges_.end(),
                       [&](const PassRange& range) { return range.first < other.end && other.first < range.end; });
  }
  /// The least number >= `least` that is not in the set.
  int first_missing(int least = 0) const {
    for (const PassRange& range : ranges_)
      if (range.first <= least && least < range.end) return range.end;
    return least;
  }
  /// Adds numbers that are not in the set.
  void add(const PassRange& range) {
    const auto next = std::upper_bound(ranges_.begin(), ranges_.end(), range,
                                       [](const PassRange& a, const PassRange& b) { return a.first < b.first; });
    auto at = ranges_.insert(next, range);
    if (at != ranges_.begin() && (at - 1)->end == at->first) {
      (at - 1)->end = at->end;
      at = ranges_.erase(at) - 1;
    }
    if (at + 1 != ranges_.end() && at->end == (at + 1)->first) {
      at->end = (at + 1)->end;
      ranges_.erase(at + 1);
    }
  }
  bool operator==(const PassSet&) const = default;

 private:
  std::vector<PassRange> ranges_;
};

}  // namespace vpm
