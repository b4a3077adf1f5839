// A render: a sum of independent passes, until a count, a time, or a stop.
#pragma once

#include <atomic>

#include "base/progress.h"
#include "render/film.h"
#include "render/settings.h"
#include "render/statistics.h"
#include "scene/scene.h"

namespace vpm {

struct RenderResult {
  Film film;
  RenderStatistics statistics;
  double seconds = 0.0;  // wall clock
};

/// Renders passes 0, 1, ... until settings.passes are done or settings.seconds have passed (at least one pass then), or
/// `stop` is set: passes under way are then dropped, those finished are kept.
RenderResult render(const Scene& scene, const RenderSettings& settings, const std::atomic<bool>& stop,
                    ProgressMode progress);

}  // namespace vpm
