// What an eye ray takes along: its random numbers, its counters, and memory to work in.
#pragma once

#include <vector>

#include "vpm/base/rng.h"
#include "vpm/estimate/march.h"
#include "vpm/estimate/photon_map.h"
#include "vpm/estimate/statistics.h"
#include "vpm/medium/grid/density_integrals_along.h"
#include "vpm/path/walk.h"
#include "vpm/photon/map/photon_beam_map.h"
#include "vpm/scene/scene.h"

namespace vpm {

class EyeSegment;
class SharedGather;

/// Buffers, one set for each thread. They outlive rays, so that rays allocate nothing.
struct EyeScratch {
  DensityIntegralsAlong integrals;           // of the last segment that asked for them
  const EyeSegment* integrals_of = nullptr;  // that segment
  Marcher marcher;
  Neighbours neighbours;           // of the last gather by count
  std::vector<Track> tracks;       // of the last flight
  PhotonBeamMap::Selection beams;  // near the last bundle of rays
  std::vector<uint32_t> leaves;    // of a map of photons, likewise
  std::vector<Rgb> emitted;        // by each medium along the last ray, W/(m^2 sr)
};

struct EyeWork {
  Rng& rng;
  EyeCounters& counters;
  EyeScratch& scratch;
  size_t pixel = 0;  // the pixel that the ray belongs to, numbered row by row

  /// The counters and the memory for gathers along the ray.
  GatherWork gather() { return {counters.gather, scratch.neighbours}; }
};

/// How many rays from the camera are followed together at the most.
inline constexpr size_t kEyeRays = 64;

/// A ray from the camera.
struct EyeRay {
  Ray ray;
  EyeWork work;
  SharedGather* shared = nullptr;  // with the rays of its square of pixels; null: it gathers for itself
  bool leads = false;              // does it gather for them? It is followed before they are
  KernelEstimate radiance{};       // that is estimated along it, W/(m^2 sr)
};

}  // namespace vpm
