#include "vpm/study/sample_moments.h"

#include <algorithm>

#include "vpm/base/parallel.h"

namespace vpm {

std::vector<Moments> sample_moments(size_t quantities, uint64_t count, uint64_t seed,
                                    const std::function<void(Rng& rng, double* out)>& sample) {
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
