// Means of quantities over many independent samples, on all threads.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "vpm/base/parallel.h"
#include "vpm/base/rng.h"
#include "vpm/base/statistics.h"

namespace vpm {

/// The moments of `quantities` numbers over `count` samples. sample(Rng&, double* out) adds what one sample is to
/// out[0 .. quantities - 1], which are 0 before; sample i has the random numbers (seed, i). The same for any number of
/// threads.
template <class Sample>
std::vector<Moments> sample_moments(size_t quantities, uint64_t count, uint64_t seed, Sample&& sample) {
  const size_t chunk_size = std::clamp<size_t>(count / 64, 1, 1024);  // of few samples each may be much work
  std::vector<std::vector<Moments>> parts(chunk_count(count, chunk_size));
  parallel_for_chunks(count, chunk_size, [&](size_t begin, size_t end, size_t chunk) {
    std::vector<Moments>& part = parts[chunk];
    part.resize(quantities);
    std::vector<double> out(quantities);
    for (size_t i = begin; i < end; ++i) {
      Rng rng(seed, rng_stream(RngUse::test, 0), i);
      std::fill(out.begin(), out.end(), 0.0);
      sample(rng, out.data());
      for (size_t q = 0; q < quantities; ++q) part[q].add(out[q]);
    }
  });
  std::vector<Moments> all(quantities);
  for (const std::vector<Moments>& part : parts)
    for (size_t q = 0; q < quantities; ++q) all[q].merge(part[q]);
  return all;
}

}  // namespace vpm
