// vpm render as one of several processes.
#pragma once

#include <functional>
#include <string>

#include "commands.h"
#include "vpm/job/render_job.h"
#include "vpm/ranks/ranks.h"

namespace vpm::tools {

/// Calls run(), which is the whole work of a rank. What it throws is told once, and ends all ranks with the exit status
/// of main(); of one process it is main() that tells.
int run_as_rank(Ranks& ranks, const std::function<int()>& run);

struct JobOfRank {
  RenderJob job;
  std::string not_shared{};  // why this rank does not share grids that it should; "" where it does, or has none
};

/// The job of a scene file with these options, by each rank. Of the ranks of one machine the first reads the grids, and
/// the others look them up in the memory where it has put them.
JobOfRank load_as_rank(Ranks& ranks, const RenderOptions& options);

/// Prints that note, if there is anything to say.
void say_not_shared(const Ranks& ranks, const RenderOptions& options, const std::string& why);

/// Loads the scene, waits for what rank 0 tells, and makes passes for it. Throws InputError where this rank's scene or
/// program is another.
int make_passes_for_leader(Ranks& ranks, const RenderOptions& options);

}  // namespace vpm::tools
