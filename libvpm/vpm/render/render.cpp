// The loop over passes.
#include "vpm/render/render.h"

#include <fmt/format.h>
#include <algorithm>
#include <limits>

#include "vpm/base/cancel.h"
#include "vpm/base/error.h"
#include "vpm/render/pass_time.h"

namespace vpm {
namespace {

/// How far a render is, from 0 to 1, in what limits it: passes, time or error (which falls about as passes grow).
double share_done(const StopRule& until, const RenderResult& result) {
  if (until.counts_passes()) return static_cast<double>(result.film.passes()) / until.passes;
  if (result.film.passes() == 0) return 0.0;
  double share = 0.0;
  if (until.seconds > 0.0) share = result.seconds / until.seconds;
  if (until.error > 0.0) share = std::max(share, until.error / highest_error(result));
  return share;
}

/// Reads the errors off the film where the stop rule goes by them.
void estimate_errors(const StopRule& until, RenderResult& result) {
  if (until.error > 0.0 && result.film.passes() >= kLeastPasses) result.errors = result.film.errors();
}

/// "7 of 16 passes, relative MSE below 0.02": what a terminal shows beside the bar. Errors are read off the film anew
/// after each kLeastPasses passes, as that takes time.
class ProgressNote {
 public:
  explicit ProgressNote(const StopRule& until) : until_(until) {}

  std::string after(const RenderResult& result) {
    const int passes = result.film.passes();
    if (result.errors || passes % kLeastPasses == 0)
      error_ = fmt::format(", relative MSE below {:.2g}", highest_error(result));
    return until_.counts_passes() ? fmt::format("{} of {} passes{}", passes, until_.passes, error_)
                                  : passes_text(passes) + error_;
  }

 private:
  const StopRule& until_;
  std::string error_;
};

/// Passes of a picture of another size, or of other layers, do not add up.
void check_size(const RenderResult& result, const Camera& camera, size_t layers) {
  const Film& film = result.film;
  const size_t pixels = static_cast<size_t>(camera.width) * static_cast<size_t>(camera.height);
  const PixelRect rendered = camera.rendered();
  if (film.width() != rendered.width() || film.height() != rendered.height())
    throw InputError(fmt::format("what is rendered so far has {} x {} pixels, but the camera renders {} x {}",
                                 film.width(), film.height(), rendered.width(), rendered.height()));
  if (!result.discs.empty() && result.discs.size() != pixels)
    throw InputError(
        fmt::format("what is rendered so far has {} discs, but the camera {} pixels", result.discs.size(), pixels));
  if (film.passes() > 0 && result.layers.size() != layers)
    throw InputError(fmt::format("what is rendered so far has {} films of layers, but the settings ask for {}",
                                 result.layers.size(), layers));
}

/// A piece goes on with its own passes.
void check_begin(const Film& film, int first) {
  if (film.passes() == 0) return;
  const int begun = film.sums().passes.ranges().front().first;
  if (begun != first)
    throw InputError(
        fmt::format("what is rendered so far begins with pass {}, but the render with pass {}: a piece of a "
                    "render goes on with the passes that it began with",
                    begun, first));
}

void add(RenderResult& result, int number, const Pass& pass) {
  result.film.add(number, pass.image, pass.correction);
  while (result.layers.size() < pass.layers.size()) result.layers.emplace_back(pass.image.width, pass.image.height);
  for (size_t i = 0; i < pass.layers.size(); ++i) result.layers[i].add(number, pass.layers[i]);
  result.errors.reset();
  result.discs.resize(pass.found.size());
  for (size_t i = 0; i < pass.found.size(); ++i) shrink(result.discs[i], pass.found[i]);
  result.statistics.merge(pass.statistics);
}

}  // namespace

std::string passes_text(int passes) { return passes == 1 ? "1 pass" : fmt::format("{} passes", passes); }

NoPassFits::NoPassFits(double asked, double pass, const std::string& what_fits)
    : std::runtime_error(fmt::format("no pass is finished within the {:.3g} s asked for{}{}{}", asked,
                                     pass > 0.0 ? fmt::format(": one takes about {:.2g} s", pass) : "",
                                     what_fits.empty() ? "" : "; ", what_fits)),
      pass_(pass) {}

RenderResult nothing_rendered(const Camera& camera) {
  const PixelRect rendered = camera.rendered();
  return {Film(rendered.width(), rendered.height()), {}, 0.0, {}};
}

std::optional<FilmErrors> errors_of(const RenderResult& result) {
  if (result.errors || result.film.passes() < 2) return result.errors;
  return result.film.errors();
}

std::optional<StatedError> stated_error_of(const RenderResult& result) {
  if (result.film.passes() < kLeastPasses) return std::nullopt;
  return stated_error(result.errors ? *result.errors : result.film.errors());
}

double highest_error(const RenderResult& result) {
  const std::optional<StatedError> stated = stated_error_of(result);
  return stated ? stated->highest : std::numeric_limits<double>::infinity();
}

void check_goes_on(const RenderResult& result, const Camera& camera, size_t layers, int first) {
  check_size(result, camera, layers);
  check_begin(result.film, first);
}

RenderResult run_passes(const StopRule& until, const PassMaker& passes, RenderResult result,
                        const RunControl& control) {
  const double earlier = result.seconds;
  // One pass shows its stages. Of several, or of blocks, the whole is shown: as work of all passes, or as thousandths
  // of the limit.
  const bool counted = until.counts_passes(), shown = progress_enabled(control.progress);
  const int missing = counted ? std::max(0, until.passes - result.film.passes()) : 0;
  const bool single = counted && missing == 1 && passes.blocks == 1;
  PassTime time(until, passes, control, earlier);
  // A pass or a block begins with its photons: how long it takes does not follow from what is done before its end.
  Progress bar("render", counted ? passes.work * passes.blocks * static_cast<uint64_t>(missing) : 1000,
               shown && !single, counted ? passes.work : 1);
  ProgressNote note(until);
  {
    const CancelledWith nothing(nullptr);  // what a render had that goes on is kept
    estimate_errors(until, result);
  }
  for (double last = 0.0; !is_cancelled() && share_done(until, result) < 1.0 && time.allows(result, last);) {
    const double begin = control.clock->seconds();
    const int number = result.film.sums().passes.first_missing(until.first);
    const std::optional<Pass> done = time.make(number, result, {shown && single, counted ? &bar : nullptr});
    if (!done) break;
    const CancelledWith nothing(nullptr);  // what follows belongs to the pass, which is finished
    add(result, number, *done);
    estimate_errors(until, result);
    result.seconds = earlier + control.clock->seconds();
    if (control.finished) control.finished(result);
    last = control.clock->seconds() - begin;
    if (!counted) {
      const auto reached = static_cast<uint64_t>(1000.0 * std::min(1.0, share_done(until, result)));
      bar.advance(reached - std::min(reached, bar.done()));  // estimates of the error may rise
    }
    if (shown && !single) bar.note(note.after(result));
  }
  bar.finish();
  const CancelledWith nothing(nullptr);
  result.errors = errors_of(result);
  return result;
}

}  // namespace vpm
