// A room full of fog as a pass of photon beams sees it: the flights of photons, and the rays of a camera. And another
// library's indices of photon beams.
#pragma once

#include <memory>
#include <vector>

#include "vpm/base/parallel.h"
#include "vpm/photon/photon_beam.h"
#include "vpm/scene/scene.h"

namespace vpm::bench {

/// The room of scenes/fog_room.toml, 2 m wide, with fog of that many free paths a metre. The camera stands in the fog.
Scene foggy_room(float sigma_t);

/// The first `count` flights of photons in the room. Their powers are not yet divided by the photons emitted.
std::vector<PhotonBeam> room_beams(const Scene& scene, size_t count);

/// An eye ray, up to the wall that it meets.
struct EyeRay {
  Ray ray;
  Interval interval;
};
/// A ray for each pixel, block by block: 16 that follow each other are 4 x 4 pixels.
std::vector<EyeRay> room_rays(const Scene& scene);

/// The beams cut into pieces of equal length, none longer than `longest`, m.
std::vector<PhotonBeam> cut_beams(const std::vector<PhotonBeam>& beams, double longest);

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
