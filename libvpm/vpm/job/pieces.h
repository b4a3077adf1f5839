// Pieces of a render: passes are pure functions of scene, settings and number, so that any process may make any of
// them.
#pragma once

#include "vpm/render/render.h"

namespace vpm {

/// Adds what another process has rendered of the same scene and settings. Throws InputError where both have a pass of
/// the same number, where they are of films of two sizes or of other layers, and where pixels have radii of their own,
/// which follow from all passes before.
void add_piece(RenderResult& whole, const RenderResult& piece);

/// "0 to 63, 128 to 191": the numbers of passes. "none" where there is none.
std::string passes_text(const PassSet& passes);

/// The numbers below the last one of a set that are not in it: what is missing of a whole.
PassSet missing_passes(const PassSet& passes);

}  // namespace vpm
