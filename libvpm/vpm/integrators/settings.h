// The settings of a render. Plain values; the defaults here are those of scene files, but for
// that of the distance strategy of photon maps, and of `emitted` where `stored` is given.
#pragma once

#include <cstdint>
#include <string>

#include "vpm/estimate/gather.h"
#include "vpm/film/pass_settings.h"
#include "vpm/integrators/combined/technique.h"
#include "vpm/integrators/photon_map/volume/volume_settings.h"
#include "vpm/medium/distance/strategy.h"
#include "vpm/medium/transmittance/estimator.h"
#include "vpm/photon/photon_settings.h"
#include "vpm/render/stop_rule.h"

namespace vpm {

/// What estimates light that has not scattered yet: the photon map, or rays towards the lights. In media, these rays
/// start at every step of the march along the eye ray. `equiangular` is for media alone: rays start at a few distances
/// that are drawn for this purpose.
enum class DirectLight { photons, shadow_rays, equiangular };

/// What estimates light that surfaces have scattered before: the photon map itself, or final gathering, rays over the
/// hemisphere that end in the map. Under final gathering, light that only mirrors, glass and media have led to a
/// surface has a map of its own, the caustic map.
enum class IndirectLight { photons, final_gather };

/// How gather radii change from pass to pass. They must shrink for the mean of passes to converge to the truth.
/// `per_pass`: those of all maps shrink with the pass number [Knaus2011]. `per_pixel`: each pixel has a radius of its
/// own for the surface map, which shrinks with the photons that it has found [Hachisuka2009]; the radii of other maps
/// shrink with the pass number.
enum class RadiusSchedule { constant, per_pass, per_pixel };

/// How final gathering draws its rays: as the material scatters, or up to half of them to where photons came from.
enum class GatherBy { material, photons };

/// The irradiance that rays of final gathering take at diffuse surfaces: an estimate from all photons around their
/// ends, or one computed beforehand at a cache point nearby.
enum class EndIrradiance { estimate, precomputed };

/// What estimates radiance: photon maps, the unbiased reference path tracer, or all techniques combined.
enum class Integrator { photon, path, combined };

/// Photons, or light sub-paths, of a pass.
struct PhotonSettings {
  uint64_t emitted = 200'000;  // at the most; 0: no limit, `stored` decides
  uint64_t stored = 0;  // tracing stops once the volume maps together or the surface map hold that many; 0: no limit
  uint64_t block = 0;   // > 0: the most that are traced and gathered at a time, see mean_of_blocks(); 0: all
  PhotonSequence sequence = PhotonSequence::sobol;  // where nothing asks for random ones, see trace_pass()
  uint32_t in_cube = 0;  // > 0: the most that travel into one octant of directions, in a cube whose edges are half a
                         // radius long, see control_density()
};

/// Light that media scatter once.
struct SingleScatteringSettings {
  DirectLight type = DirectLight::photons;
  int samples = 8;  // pairs of shadow rays on each segment of an eye ray, where it is equiangular, >= 1
};

/// Light on surfaces that has not scattered yet.
struct DirectSettings {
  DirectLight type = DirectLight::shadow_rays;
  int samples = 2;  // shadow rays to each light that has an area or a solid angle, >= 1
};

/// Light on surfaces that surfaces have scattered before.
struct IndirectSettings {
  IndirectLight type = IndirectLight::photons;
  int rays = 8;  // of final gathering, at each point of a surface that the eye sees, >= 1
  GatherBy rays_by = GatherBy::material;
  EndIrradiance irradiance = EndIrradiance::estimate;
};

/// The caustic map of final gathering.
struct CausticMapSettings : AskedGather {
  uint64_t emitted = 0;  // photons per pass that are aimed at mirrors and glass; 0: it takes what the others bring
};

/// The combined estimator: which techniques it uses, and how these share the paths that several of them find.
struct CombinedSettings {
  TechniqueSet techniques;
  Heuristic heuristic = Heuristic::correlation_aware;
  bool layers = false;  // is it kept what each technique finds?
};

struct RenderSettings : PassSettings {
  Integrator integrator = Integrator::photon;
  StopRule until;  // when the render ends

  PhotonSettings photons;
  int max_events = 100'000;  // of one photon or eye path, a guard against endless paths; what it cuts is counted

  GuideSettings importance;  // by which photons are guided

  CombinedSettings combined;

  DistanceSettings distance;            // how photons fly
  TransmittanceSettings transmittance;  // towards lights

  VolumeSettings volume;  // volumetric radiance estimate
  AskedGather surface;    // surface radiance estimate
  CausticMapSettings caustics;
  RadiusSchedule radii = RadiusSchedule::per_pass;  // of maps in radius mode
  SingleScatteringSettings single_scattering;
  DirectSettings direct;
  IndirectSettings indirect;
  int square = 2;  // the edge, pixels, of squares in which one ray gathers for all; 1: each gathers for itself
  float max_optical_step = 0.5f;  // of a marching step, in optical thickness, > 0

  bool gathers_finally() const { return indirect.type == IndirectLight::final_gather; }
  /// Photons of a pass that are aimed at mirrors and glass.
  uint64_t aimed_photons() const { return gathers_finally() ? caustics.emitted : 0; }
};

}  // namespace vpm
