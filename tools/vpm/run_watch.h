// How a run can be watched while it goes on: in a viewer, and by its files, which are written again and again. A run is
// held up by a small part of its time, is not ended by what fails here, and gives the same picture.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "commands.h"
#include "tev_display.h"
#include "vpm/base/clock.h"
#include "vpm/render/render.h"

namespace vpm::tools {

class RunWatch {
 public:
  /// Writes all files of the run. Throws InputError where one cannot be written.
  using WriteFiles = std::function<void(const RenderResult& so_far)>;

  /// Shows an image of that name, of the film's size, in the viewer; where that is not there, stderr says so.
  /// `progress` is how the run shows its own.
  RunWatch(const WatchOptions& options, ProgressMode progress, const std::string& name, const Film& film,
           WriteFiles write);

  /// After each pass.
  void finished(const RenderResult& so_far);
  /// After the last: the viewer has the final picture. The files are left to the caller.
  void finish(const RenderResult& result);

 private:
  void connect(const TevAddress& address, const std::string& name, const Film& film);
  void show(const RenderResult& so_far);
  void rewrite(const RenderResult& so_far);
  void say(const std::string& text) const;

  std::optional<double> preview_;  // s
  WriteFiles write_;
  std::optional<TevDisplay> viewer_;          // while it is there
  int shown_ = 0;                             // passes of the picture last shown
  double showing_ = 0.0;                      // s that it took
  Stopwatch since_shown_;                     // or since the beginning
  double rewriting_ = 0.0;                    // s that the last writing of the files took
  std::optional<Stopwatch> since_rewritten_;  // once they have been written
  bool failed_ = false;                       // has that failed already?
  bool in_bar_ = false;                       // is the cursor in the line of a progress bar?
};

}  // namespace vpm::tools
