// Looking on: not oftener than it is worth, and never at the cost of the run.
#include "run_watch.h"

#include <fmt/format.h>
#include <algorithm>
#include <cstdio>
#include <utility>

#include "vpm/base/error.h"

namespace vpm::tools {
namespace {

constexpr double kRest = 10.0;  // times as long as showing or writing a picture took, none is shown or written

}  // namespace

RunWatch::RunWatch(const WatchOptions& options, ProgressMode progress, const std::string& name, const Film& film,
                   WriteFiles write)
    : preview_(options.preview), write_(std::move(write)) {
  if (options.display) connect(*options.display, name, film);
  in_bar_ = progress_enabled(progress);
}

void RunWatch::connect(const TevAddress& address, const std::string& name, const Film& film) {
  try {
    viewer_.emplace(address, name, film.width(), film.height());
  } catch (const SendError& error) {
    say(fmt::format("note: no viewer shows the picture: {}:{}: {}", address.host, address.port, error.what()));
  }
}

void RunWatch::finished(const RenderResult& so_far) {
  if (viewer_ && since_shown_.seconds() >= kRest * showing_) show(so_far);
  if (preview_ && (!since_rewritten_ || since_rewritten_->seconds() >= std::max(*preview_, kRest * rewriting_)))
    rewrite(so_far);
}

void RunWatch::finish(const RenderResult& result) {
  in_bar_ = false;
  if (viewer_ && shown_ != result.film.passes()) show(result);
}

void RunWatch::show(const RenderResult& so_far) {
  const Stopwatch showing;
  try {
    viewer_->show(so_far.film.mean());
  } catch (const SendError& error) {
    viewer_.reset();
    const std::string shown = shown_ == 0 ? "nothing" : "no more than " + passes_text(shown_);
    say(fmt::format("note: the viewer shows {}: {}", shown, error.what()));
  }
  shown_ = so_far.film.passes();
  showing_ = showing.seconds();
  since_shown_ = Stopwatch();
}

void RunWatch::rewrite(const RenderResult& so_far) {
  const Stopwatch rewriting;
  try {
    write_(so_far);
  } catch (const InputError& error) {
    if (!failed_) say(fmt::format("warning: the run goes on without a preview: {}", error.what()));
    failed_ = true;
  }
  rewriting_ = rewriting.seconds();
  since_rewritten_.emplace();
}

void RunWatch::say(const std::string& text) const { fmt::print(stderr, "{}{}\n", in_bar_ ? "\n" : "", text); }

}  // namespace vpm::tools
