// The loop over passes.
#include "render/render.h"

#include <algorithm>
#include <chrono>

#include "render/photon_pass.h"

namespace vpm {

RenderResult render(const Scene& scene, const RenderSettings& settings, const std::atomic<bool>& stop,
                    ProgressMode progress) {
  using Clock = std::chrono::steady_clock;
  RenderResult result{Film(scene.camera.width, scene.camera.height), {}, 0.0};
  const Clock::time_point start = Clock::now();
  const auto elapsed = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  const bool timed = settings.seconds > 0.0;
  Progress bar("passes", timed ? 1000 : static_cast<uint64_t>(settings.passes), progress_enabled(progress));
  for (int pass = 0; timed ? pass == 0 || elapsed() < settings.seconds : pass < settings.passes; ++pass) {
    const Pass done = render_photon_pass(scene, settings, pass, stop, ProgressMode::never);
    if (stop) break;
    result.film.add(done.image);
    result.statistics.merge(done.statistics);
    const auto target = timed ? static_cast<uint64_t>(1000.0 * std::min(1.0, elapsed() / settings.seconds)) : pass + 1u;
    bar.advance(target - bar.done());
  }
  bar.finish();
  result.seconds = elapsed();
  return result;
}

}  // namespace vpm
