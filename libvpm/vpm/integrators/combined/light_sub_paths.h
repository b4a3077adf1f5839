// The sub-paths from the lights of one pass: their vertices and flights, with the sums that weigh techniques.
#pragma once

#include <span>
#include <vector>

#include "vpm/integrators/combined/flight_terms.h"
#include "vpm/integrators/combined/merge_photons.h"
#include "vpm/medium/distance/strategy.h"
#include "vpm/medium/transmittance/estimator.h"
#include "vpm/photon/ledger.h"
#include "vpm/photon/photon_beam.h"
#include "vpm/photon/photon_numbers.h"

namespace vpm {

/// Parts of flights, by medium.
struct LightFlights {
  std::vector<std::vector<PhotonBeam>> beams;
  std::vector<std::vector<FlightTerms>> flights;

  explicit LightFlights(size_t media) : beams(media), flights(media) {}
};

/// What a light sub-path brings to a pixel by light tracing.
struct Splat {
  uint32_t pixel = 0;  // numbered row by row
  Rgb radiance{0.0f};  // W/(m^2 sr), for each light sub-path, were light tracing the only technique
  float share = 1.0f;  // that light tracing has in it
};

struct LightSubPaths {
  std::vector<PathVertex> vertices;               // that eye sub-paths are connected to
  uint64_t connectable = 0;                       // of how many sub-paths
  std::vector<MergePhoton> on_surfaces;           // but those straight from lights that are sampled
  std::vector<std::vector<MergePhoton>> photons;  // by medium
  LightFlights flights;
  std::vector<Splat> splats;
  Ledger ledger;  // emitted, counts of events, look-ups

  explicit LightSubPaths(size_t media = 0) : photons(media), flights(media) {}
  /// Takes over what parts have, one after another.
  void take_over(std::span<LightSubPaths> parts);
};

/// What tracing needs.
struct LightTracing {
  const Scene& scene;
  const DistanceStrategy& strategy;
  const TransmittanceEstimator& transmittance;  // exact
  const TechniqueCounts& counts;
  const PhotonNumbers& numbers;
  int max_events = 100'000;             // of one sub-path
  uint64_t connectable = ~uint64_t{0};  // the first so many sub-paths may be connected to
};

/// Light tracing: connects a vertex to the camera.
void splat(const LightTracing& tracing, const PathVertex& at, Rng& rng, LightSubPaths& paths);

/// Traces the light sub-paths of these numbers one after another. Sub-path i depends on `numbers` and i alone.
void trace_light_sub_paths(const LightTracing& tracing, uint64_t begin, uint64_t end, LightSubPaths& paths);

}  // namespace vpm
