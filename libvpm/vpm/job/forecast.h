// What a pass will take of time and of memory, told before the first.
#pragma once

#include <string>

#include "vpm/job/pass_cost.h"
#include "vpm/render/settings.h"
#include "vpm/scene/scene.h"

namespace vpm {

/// A render that is asked for so many seconds is kept within this time, s, by all who can: the number of photons where
/// it is chosen, and the passes that are started.
double longest_time(double seconds);

/// What to say of a first pass that takes longer than the time that its render is asked for; "" where it does not.
std::string too_long_text(const PassCost& cost, const RenderSettings& settings);

/// Throws InputError where the photons that a pass, or a block of it, stores take more than `memory` bytes. Only where
/// they may be many does it trace some.
void check_memory(const Scene& scene, const RenderSettings& settings, PassOf of, double memory);

// Bytes while maps are made: of a stored photon (62 in scenes/street_lamp.toml); of a flight, while it is recorded; and
// of one that is kept, while it becomes a beam (both in scenes/fog_room.toml, with a radius of 1 cm).
inline constexpr double kMapBytes = 64.0, kFlightBytes = 100.0, kBeamBytes = 450.0;

/// Bytes of the machine.
double physical_memory();

}  // namespace vpm
