// A render: a sum of passes, one after the other, until a stop rule is met, or a stop.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "vpm/base/clock.h"
#include "vpm/base/progress.h"
#include "vpm/estimate/statistics.h"
#include "vpm/film/film.h"
#include "vpm/film/pass.h"
#include "vpm/film/pixel_disc.h"
#include "vpm/render/stated_error.h"
#include "vpm/render/stop_rule.h"
#include "vpm/scene/camera.h"

namespace vpm {

/// What is rendered so far, and all that the next pass needs to know of it.
struct RenderResult {
  Film film;
  RenderStatistics statistics;
  double seconds = 0.0;                   // on the runs' clocks, of all runs together where a render was resumed
  PixelDiscs discs;                       // where pixels have radii of their own, once there is a pass
  std::optional<FilmErrors> errors = {};  // of the film, once it has two passes and run_passes() has come to its end;
                                          // where the stop rule asks for an error also after each pass, once there
                                          // are kLeastPasses
  std::vector<Film> layers = {};          // layer_films() of them, as in Pass::layers, once there is a pass
};

/// "1 pass", "16 passes".
std::string passes_text(int passes);

/// How a render is watched.
struct RunControl {
  ProgressMode progress = ProgressMode::never;
  std::function<void(const RenderResult&)> finished = {};              // called after each further pass
  std::shared_ptr<const Clock> clock = std::make_shared<WallClock>();  // of the run, which may have begun before
  double foreseen = 0.0;                                               // s that a pass takes; 0: not known
  std::string what_fits = {};                         // in the place of a pass that does not fit; or ""
  std::function<void(const std::string&)> note = {};  // called, on another thread, where the first pass ends late
};

/// The time that was asked for is over, and not one pass is finished.
class NoPassFits : public std::runtime_error {
 public:
  /// Of `asked` s; a pass takes `pass` s, 0 where that is not known; `what_fits` as in RunControl.
  NoPassFits(double asked, double pass, const std::string& what_fits = "");
  double pass() const { return pass_; }

 private:
  double pass_;
};

/// Pass number `number` of any kind, to be made after those in `so_far`. In its course it advances its bar by `work`
/// units for each block of its photons.
struct PassMaker {
  std::function<Pass(int number, const RenderResult& so_far, const PassProgress& progress)> make;
  uint64_t work = 0;
  uint64_t blocks = 1;   // of a pass, >= 1
  bool ordered = false;  // does a pass depend on `so_far`?
};

/// Adds passes to the result until the stop rule is met, or the work is given up (base/cancel.h): the pass under way is
/// then dropped, and those finished are returned.
///
/// Where a time is asked for, it counts from the beginning of control.clock, and with that of earlier runs. No pass is
/// begun that would end after 1.05 times it and 0.25 s if it took as long as the last one; one that is under way then
/// is dropped. The first is finished if it is foreseen to end within twice the time.
///
/// Throws NoPassFits.
RenderResult run_passes(const StopRule& until, const PassMaker& passes, RenderResult result, const RunControl& control);

/// Throws InputError where the result cannot go on as a render of the camera's film with so many films of layers that
/// begins with pass `first`.
void check_goes_on(const RenderResult& result, const Camera& camera, size_t layers, int first);

/// A render of the camera's film before its first pass.
RenderResult nothing_rendered(const Camera& camera);

/// The errors of the film, read off it where the result does not hold them; nothing below two passes.
std::optional<FilmErrors> errors_of(const RenderResult& result);

/// The relative MSE by errors_of(); nothing below kLeastPasses passes, which say too little.
std::optional<StatedError> stated_error_of(const RenderResult& result);
/// StatedError::highest, infinite where nothing is stated: a render that asks for an error goes on until it is no more
/// than that.
double highest_error(const RenderResult& result);
inline constexpr int kLeastPasses = 8;

}  // namespace vpm
