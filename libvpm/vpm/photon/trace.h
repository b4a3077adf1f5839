// Photon tracing [Jarosz2008, alg. 7.1 to 7.3, corrected]: from the lights into records of collisions and surface hits.
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "vpm/base/progress.h"
#include "vpm/medium/distance/strategy.h"
#include "vpm/photon/ledger.h"
#include "vpm/photon/photon.h"
#include "vpm/photon/photon_guide.h"
#include "vpm/scene/scene.h"

namespace vpm {

/// What one pass of photon tracing is told.
struct TraceSettings {
  uint64_t seed = 1;
  uint64_t pass = 0;
  uint64_t emitted = 0;      // photons to emit at the most; 0: no limit, `stored` decides
  uint64_t stored = 0;       // stop once the volume maps together or the surface map hold that many; 0: no limit
  int max_events = 100'000;  // of one photon
  bool keep_volume = true, keep_surface = true;                // store at all
  bool keep_direct_volume = true, keep_direct_surface = true;  // store photons that have not scattered yet
  bool keep_caustics = false, keep_direct_caustics = false;    // the same of the caustic map
  bool keep_specular_caustics = true;  // those of the caustic map that trace_caustics() makes, too
  bool keep_from_rough = false;        // store those that a rough surface scattered last by themselves, too
  bool keep_sites = false;             // one of kSiteStep photons finds sites and is not in the surface map
  VolumeForm volume_form = VolumeForm::density_at_query;
  const PhotonGuide* guide = nullptr;  // where photons are emitted and scattered; null: as power is
  bool split = false;                  // with a guide: by importance also on their way
  float density_floor = 0.0f;  // density at the query: the least to divide by, over the medium's largest, in [0, 1]
  const std::atomic<bool>* stop = nullptr;  // once true, tracing ends as soon as it can, with photons of no use
};

/// The photons of one pass; powers are those of the photons, not yet divided by `ledger.emitted_count`.
struct TracedPhotons {
  std::vector<std::vector<Photon>> volume;  // by medium
  std::vector<Photon> surface;
  std::vector<Photon> caustics;    // those of the surface photons that no rough surface has scattered last
  std::vector<Photon> from_rough;  // those that one has
  std::vector<SurfaceSite> sites;  // on Lambertian surfaces, found by photons that are not in `surface`
  uint64_t surface_emitted = 0;    // photons emitted for `surface`: all, or without those
  Ledger ledger;
};

/// Where sites are kept, one of so many photons finds them [Christensen1999].
inline constexpr uint64_t kSiteStep = 4;

/// Traces photons in parallel. Photon i depends on (seed, pass, i) alone, and the records stand in the photons' order.
///
/// A volume photon is stored at every collision, before the choice between absorption and scattering (photons that
/// weighted strategies made lighter than a tenth of what was emitted first play roulette). Its power is the flux Phi
/// that collides (density at the photon) or Phi / density there (density at the query), so that the estimates only
/// multiply by what belongs to the query. That density is relative, over the medium's largest: powers then fit into
/// floats whatever the scale of densities. A floor makes the power Phi / max(density, floor): that bounds the powers,
/// and what is thinner than the floor scatters less, by density / floor. A photon is direct until its first scattering,
/// reflection or refraction; crossing a boundary is none. A caustic photon comes from a light or a medium, through
/// mirrors and glass alone; photons that rough surfaces scattered are what final gathering is for.
TracedPhotons trace_photons(const Scene& scene, const DistanceStrategy& strategy, const TraceSettings& settings,
                            Progress& progress);

}  // namespace vpm
