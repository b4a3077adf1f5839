// The clock's limit, and when a pass that is under way will end.
#include "vpm/render/pass_time.h"

#include <fmt/format.h>
#include <algorithm>

#include "vpm/base/cancel.h"
#include "vpm/base/vec.h"

namespace vpm {
namespace {

constexpr double kFirstLook = 0.9;  // of a time, to see how quick tiles are by then

}  // namespace

std::string spent_text(double spent, double asked) {
  constexpr double kMuch = 0.25;  // of the time
  return spent > kMuch * asked ? fmt::format("{:.2g} s were over before the first pass, by loading and choosing", spent)
                               : "";
}

PassTime::PassTime(const StopRule& until, const PassMaker& passes, const RunControl& control, double earlier)
    : passes_(passes),
      control_(control),
      asked_(until.seconds),
      earlier_(earlier),
      limit_(until.seconds > 0.0 ? std::max(0.0, until.seconds - earlier) : double{kInfinity}),
      latest_(0.5 * (limit_ + longest_time(limit_))),
      tiles_("", 0, false) {}

bool PassTime::allows(const RenderResult& so_far, double last) const {
  return so_far.film.passes() == 0 || control_.clock->seconds() + last <= latest_;
}

std::optional<Pass> PassTime::make(int number, const RenderResult& so_far, PassProgress progress) {
  std::optional<Pass> pass;
  if (progress.tiles == nullptr) progress.tiles = &tiles_;
  const auto work = [&] { pass.emplace(passes_.make(number, so_far, progress)); };
  try {
    if (so_far.film.passes() > 0) {
      control_.clock->finish_by(latest_, work);
      return pass;
    }
    begin_ = seen_at_ = control_.clock->seconds();
    if (control_.clock->finish_by(std::max(begin_, kFirstLook * limit_), work, [&] { return look_at_first(); }))
      return pass;
    throw NoPassFits(asked_, pass_, control_.what_fits.empty() ? spent_text(begin_, asked_) : control_.what_fits);
  } catch (const Cancelled&) {
    return std::nullopt;
  }
}

double PassTime::look_at_first() {
  const double now = control_.clock->seconds(), last = kMostOfFirst * limit_, before_last = kFirstLook * last;
  pass_ = whole_pass(now);
  if (now < limit_) return limit_;
  if (now >= last || begin_ + pass_ > last) return now;
  if (now >= before_last) return last;
  if (control_.note)
    control_.note(fmt::format("no pass is finished after {:.2g} s{}", earlier_ + now,
                              pass_ > 0.0 ? fmt::format("; the first, of about {:.2g} s, goes on", pass_)
                                          : fmt::format("; the first goes on, for {:.2g} s at the most", limit_)));
  return before_last;
}

double PassTime::whole_pass(double now) {
  const uint64_t done = tiles_.done(), all = passes_.work * passes_.blocks;
  const auto since = static_cast<double>(done - tiles_seen_), left = static_cast<double>(all - done);
  const double pass = since > 0.0 ? now - begin_ + left / since * (now - seen_at_) : control_.foreseen;
  tiles_seen_ = done;
  seen_at_ = now;
  return pass;
}

}  // namespace vpm
