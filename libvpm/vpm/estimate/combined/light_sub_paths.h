// The sub-paths from the lights of one pass: their vertices and flights, with the sums that weigh techniques.
#pragma once

#include <vector>

#include "vpm/estimate/combined/flight_terms.h"
#include "vpm/estimate/combined/medium_photon.h"
#include "vpm/medium/distance/strategy.h"
#include "vpm/medium/transmittance/estimator.h"
#include "vpm/photon/ledger.h"
#include "vpm/photon/photon_beam.h"
#include "vpm/photon/photon_numbers.h"
#include "vpm/photon/photon_plane.h"

namespace vpm {

/// A vertex of a light sub-path that is not specular.
struct LightVertex {
  Arrival at;
  Rgb power{0.0f};  // with which the sub-path arrives, W, were it the only one
};

/// How a flight began of which a part, through one medium, is kept as a plane.
struct FlightStart {
  Departure from;
  Rgb before{1.0f};  // the transmittance of the flight up to the part
};

/// Parts of flights, by medium.
struct LightFlights {
  std::vector<std::vector<PhotonBeam>> beams;
  std::vector<std::vector<FlightTerms>> flights;

  explicit LightFlights(size_t media) : beams(media), flights(media) {}
  void join(LightFlights& part);
};

/// What a light sub-path brings to a pixel by light tracing.
struct Splat {
  uint32_t pixel = 0;  // numbered row by row
  Rgb radiance{0.0f};  // W/(m^2 sr), for each light sub-path, were light tracing the only technique
  float share = 1.0f;  // that light tracing has in it
};

struct LightSubPaths {
  std::vector<LightVertex> vertices;
  std::vector<std::vector<PlacedRecord<MediumPhoton>>> photons;  // by medium
  LightFlights short_beams, long_beams;
  std::vector<PhotonPlane> planes;
  std::vector<FlightStart> plane_starts;
  std::vector<Splat> splats;
  Ledger ledger;  // emitted, counts of events, look-ups

  explicit LightSubPaths(size_t media = 0) : photons(media), short_beams(media), long_beams(media) {}
  /// Takes over what a part has, which comes next.
  void join(LightSubPaths& part);
};

/// What tracing needs.
struct LightTracing {
  const Scene& scene;
  const DistanceStrategy& strategy;
  const TransmittanceEstimator& transmittance;  // exact
  const TechniqueCounts& counts;
  const PhotonNumbers& numbers;
  int max_events = 100'000;  // of one sub-path
};

/// Light tracing: connects a vertex, with the power that arrives there, W, to the camera.
void splat(const LightTracing& tracing, const Arrival& at, const Rgb& power, Rng& rng, LightSubPaths& paths);

/// Traces the light sub-paths of these numbers one after another. Sub-path i depends on `numbers` and i alone.
void trace_light_sub_paths(const LightTracing& tracing, uint64_t begin, uint64_t end, LightSubPaths& paths);

}  // namespace vpm
