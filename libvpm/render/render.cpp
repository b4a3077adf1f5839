// The loop over passes.
#include "render/render.h"

#include <algorithm>
#include <chrono>

#include "render/path_tracer.h"
#include "render/photon_pass.h"

namespace vpm {

RenderResult render(const Scene& scene, const RenderSettings& settings, const std::atomic<bool>& stop,
                    ProgressMode progress) {
  using Clock = std::chrono::steady_clock;
  RenderResult result{Film(scene.camera.width, scene.camera.height), {}, 0.0};
  const Clock::time_point start = Clock::now();
  const auto elapsed = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  const bool timed = settings.seconds > 0.0;
  // One pass shows its stages. Of several the whole is shown: as tiles of all passes, or as thousandths of the time.
  const bool shown = progress_enabled(progress);
  const bool single = !timed && settings.passes == 1;
  const uint64_t tiles = tile_count(scene.camera);
  Progress bar("render", timed ? 1000 : tiles * static_cast<uint64_t>(settings.passes), shown && !single);
  const PassProgress pass_progress{shown && single, timed ? nullptr : &bar};
  const auto render_pass = settings.integrator == Integrator::path ? render_path_pass : render_photon_pass;
  for (int pass = 0; timed ? pass == 0 || elapsed() < settings.seconds : pass < settings.passes; ++pass) {
    const Pass done = render_pass(scene, settings, pass, stop, pass_progress);
    if (stop) break;
    result.film.add(done.image);
    result.statistics.merge(done.statistics);
    if (timed) bar.advance(static_cast<uint64_t>(1000.0 * std::min(1.0, elapsed() / settings.seconds)) - bar.done());
  }
  bar.finish();
  result.seconds = elapsed();
  return result;
}

}  // namespace vpm
