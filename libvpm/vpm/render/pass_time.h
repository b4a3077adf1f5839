// Passes under a limit of time: which are begun, and which are given up.
#pragma once

#include <optional>
#include <string>

#include "vpm/render/render.h"

namespace vpm {

/// A render that is asked for so many seconds ends within so many, with all that it writes; but for one whose first
/// pass takes longer, with the choice of its radii: that may go on for kMostOfFirst times the seconds.
inline double longest_time(double seconds) { return 1.1 * seconds + 0.5; }
inline constexpr double kMostOfFirst = 2.0;

/// "3.1 s were over before the first pass, by loading and choosing": where that is much of the `asked` s; else "".
std::string spent_text(double spent, double asked);

/// The time of the passes of one run: no pass is begun, and none goes on, that would end too late.
class PassTime {
 public:
  /// After runs that took `earlier` seconds. All must live as long.
  PassTime(const StopRule& until, const PassMaker& passes, const RunControl& control, double earlier);

  /// May a pass be begun after these, if it takes as long as the last one, `last` s?
  bool allows(const RenderResult& so_far, double last) const;

  /// The pass; nothing where it was given up. Throws NoPassFits.
  std::optional<Pass> make(int number, const RenderResult& so_far, PassProgress progress);

 private:
  /// Looks at how far the first pass is: shortly before the limit and at it, shortly before twice the limit and at
  /// that. Returns the time of the next look; one that is over gives up.
  double look_at_first();
  /// What the first pass takes, s, by the tiles since the last look or else as foreseen; 0: not known.
  double whole_pass(double now);

  const PassMaker& passes_;
  const RunControl& control_;
  const double asked_;    // s, of all runs
  const double earlier_;  // s, of those before
  const double limit_;    // s on the clock; infinite where there is none
  const double latest_;   // when passes are to have ended: what is left of longest_time() is for what follows
  // Of the first pass:
  double begin_ = 0.0;       // s on the clock
  double pass_ = 0.0;        // s that it takes; 0: not known
  Progress tiles_;           // counts what it has done
  uint64_t tiles_seen_ = 0;  // at the last look
  double seen_at_ = 0.0;     // s on the clock
};

}  // namespace vpm
