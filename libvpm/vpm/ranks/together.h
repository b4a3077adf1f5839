// A render by several processes: rank 0 joins the passes that all make, in the order of their numbers. So the picture,
// the statistics, and where a render by passes or by error ends are those of one process, to the last bit, whatever the
// number of ranks and of their threads. Passes beyond that end are dropped.
//
// Rank 0 hands out the next number to whoever is free, makes passes itself, and keeps what is finished; the others keep
// nothing. What grows with the number of ranks is what rank 0 receives and sums, see papers/performance.md.
#pragma once

#include "vpm/integrators/settings.h"
#include "vpm/ranks/ranks.h"
#include "vpm/render/render.h"

namespace vpm {

/// What rank 0 of several does: run_passes() over the passes of all. Returns once all other ranks have ended their
/// work; where the work was given up (base/cancel.h), at once, as a rank may be gone: ranks are then to be aborted,
/// after what is finished is written. Throws what run_passes() and the maker throw.
RenderResult lead_passes(Ranks& ranks, const StopRule& until, const PassMaker& maker, RenderResult result,
                         const RunControl& control);

/// What the others do, until rank 0 says that there is no more. Throws what the maker throws; rank 0 waits for
/// that pass then, so that ranks are to be aborted.
void make_passes(Ranks& ranks, const PassMaker& maker);

/// The same of a scene. Throws SettingError where pixels have radii of their own, which follow from all passes before,
/// and what render() throws.
RenderResult lead_render(Ranks& ranks, const Scene& scene, const RenderSettings& settings, RenderResult result,
                         const RunControl& control);
void make_render(Ranks& ranks, const Scene& scene, const RenderSettings& settings);

}  // namespace vpm
