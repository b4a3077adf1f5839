// Another library's indices of photon beams.
#pragma once

#include <memory>
#include <vector>

#include "benchmarks/room.h"
#include "vpm/base/parallel.h"

namespace vpm::bench {

/// What rays find: how many crossings, and the sum over them of power * (1 - (distance / radius)^2) / sine, W.
struct Crossings {
  uint64_t count = 0;
  double sum = 0.0;

  Crossings& operator+=(const Crossings& other) {
    count += other.count;
    sum += other.sum;
    return *this;
  }
};

/// Sums up what find(ray number) gives for every `step`-th of the rays, on all threads.
template <class Find>
Crossings sum_over_rays(size_t rays, size_t step, Find&& find) {
  constexpr size_t kChunk = 1024;
  std::vector<Crossings> parts(chunk_count(rays, kChunk));
  parallel_for_chunks(rays, kChunk, [&](size_t begin, size_t end, size_t chunk) {
    for (size_t i = begin; i < end; i += step) parts[chunk] += find(i);
  });
  Crossings all;
  for (const Crossings& part : parts) all += part;
  return all;
}

class BeamIndex {
 public:
  virtual ~BeamIndex() = default;
  /// Of rays from one place, a multiple of 16.
  virtual Crossings cross(const std::vector<EyeRay>& rays) const = 0;
};

/// What Embree's hierarchy of boxes is built over, and whether it is asked by packets of 16 rays.
enum class EmbreeBeams { user_geometry, user_packets, flat_curves };

/// Built and asked on `threads` threads. Refers to the beams.
std::unique_ptr<BeamIndex> make_embree_beams(EmbreeBeams kind, const std::vector<PhotonBeam>& beams, float radius,
                                             int threads);

}  // namespace vpm::bench
