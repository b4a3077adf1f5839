// Running moments of colours, channel by channel.
#pragma once

#include <array>
#include <cmath>

#include "vpm/base/statistics/moments.h"
#include "vpm/base/vec.h"

namespace vpm {

struct ChannelMoments {
  std::array<Moments, 3> channels;

  void add(const Rgbd& x) {
    for (int c = 0; c < 3; ++c) channels[static_cast<size_t>(c)].add(x[c]);
  }
  void merge(const ChannelMoments& other) {
    for (size_t c = 0; c < 3; ++c) channels[c].merge(other.channels[c]);
  }
  Rgbd mean() const { return {channels[0].mean(), channels[1].mean(), channels[2].mean()}; }
  /// Of mean(), over independent samples; NaN below two, where it is unknown.
  Rgbd standard_error() const {
    return {std::sqrt(channels[0].variance_of_mean()), std::sqrt(channels[1].variance_of_mean()),
            std::sqrt(channels[2].variance_of_mean())};
  }
};

}  // namespace vpm
