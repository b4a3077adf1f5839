// The time and the memory that a pass will take, estimated before the first.
#pragma once

#include <string>

#include "vpm/base/clock.h"
#include "vpm/integrators/settings.h"
#include "vpm/scene/scene.h"

namespace vpm {

/// What a pass takes, s, by small passes that took about `looking` s.
struct ForeseenPass {
  double seconds = 0.0;
  double of_rays = 0.0;  // of these, what rays take whatever photons there are
  double photons = 0.0;  // that it emits; 0: none
};
ForeseenPass foresee_pass(const Scene& scene, const RenderSettings& settings, double looking,
                          const Clock& clock = WallClock());

/// "about 210000 integrator.photons.emitted": with which the pass takes so many seconds, > 0; "" where its rays alone
/// take longer.
std::string photons_that_fit(const ForeseenPass& pass, const RenderSettings& settings, double seconds);
/// "integrator.volume.radius = 0.12": the first half, quarter, ... of the radius with which a pass takes less; "" where
/// there is none, or no radius decides what is gathered. Passes are timed for `looking` s in all, or a little longer.
std::string radius_that_fits(const Scene& scene, RenderSettings settings, double seconds, double looking,
                             const Clock& clock = WallClock());

/// What passes show: a picture what the eye sees, a light map surfaces alone.
enum class PassOf { picture, light_map };

/// "a ray from the eye gathers about 430000 photons, ...": where it gathers more than 100,000 within the radii of
/// the first pass; else "". Estimated from a few photons and rays.
std::string wide_gather_text(const Scene& scene, const RenderSettings& settings);

/// About how many bytes the photons or light sub-paths that a pass, or a block of it, stores take while maps are made;
/// 0 where there are none. A few are traced for that.
double bytes_of_maps(const Scene& scene, const RenderSettings& settings, PassOf of);
/// Throws InputError where the photons that a pass, or a block of it, stores take more than `memory` bytes. Only where
/// they may be many does it trace some.
void check_memory(const Scene& scene, const RenderSettings& settings, PassOf of, double memory);

// Bytes while maps are made: of a stored photon (62 in scenes/street_lamp.toml); of a flight, while it is recorded; and
// of one that is kept, while it becomes a beam (both in scenes/fog_room.toml, with a radius of 1 cm).
inline constexpr double kMapBytes = 64.0, kFlightBytes = 100.0, kBeamBytes = 450.0;

/// Bytes of the machine.
double physical_memory();

}  // namespace vpm
