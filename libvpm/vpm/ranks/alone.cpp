// Ranks of a vpm without MPI: one.
#include "vpm/ranks/alone.h"

#include <fmt/format.h>

#include "vpm/base/error.h"

namespace vpm {

std::unique_ptr<Ranks> join_ranks() {
  if (const int ranks = started_ranks(); ranks > 1)
    throw InputError(
        fmt::format("this vpm knows no MPI, so that {} of them would each render the same passes; build "
                    "one that does: tools/build mpi",
                    ranks));
  return std::make_unique<Alone>();
}

}  // namespace vpm
