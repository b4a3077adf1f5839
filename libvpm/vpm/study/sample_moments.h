// Means of quantities over many independent samples, on all threads.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "vpm/base/rng.h"
#include "vpm/base/statistics/moments.h"

namespace vpm {

/// The moments of `quantities` numbers over `count` samples. sample(rng, out) adds what one sample is to
/// out[0 .. quantities - 1], which are 0 before; sample i has the random numbers (seed, i). The same for any number of
/// threads.
std::vector<Moments> sample_moments(size_t quantities, uint64_t count, uint64_t seed,
                                    const std::function<void(Rng& rng, double* out)>& sample);

}  // namespace vpm
