// Joining, turns, and how Python's end leaves the others.
#include "joined_ranks.h"

#include <mutex>

#include "bindings.h"
#include "vpm/base/error.h"

namespace vpm::python {
namespace {

std::unique_ptr<JoinedRanks>& joined() {
  static std::unique_ptr<JoinedRanks> ranks;
  return ranks;
}

/// What was printed by Python is not lost. A stream may be closed.
void flush_streams() {
  const py::module_ sys = py::module_::import("sys");
  for (const char* stream : {"stdout", "stderr"}) {
    try {
      sys.attr(stream).attr("flush")();
    } catch (const py::error_already_set&) {
      continue;
    }
  }
}

}  // namespace

JoinedRanks& JoinedRanks::own() {
  static std::once_flag joining;
  const py::gil_scoped_release others_run;  // all processes have to come here
  std::call_once(joining, [] {
    joined().reset(new JoinedRanks(join_ranks()));
    const py::gil_scoped_acquire lock;
    py::module_::import("atexit").attr("register")(py::cpp_function(&JoinedRanks::leave));
  });
  if (!joined()) throw InputError("Python ends, and the other processes are left");
  return *joined();
}

/// Before mpi4py, which may have begun MPI, ends it. Where the others may wait for this process they are ended.
void JoinedRanks::leave() {
  if (joined()->broken_ || joined()->busy_) {
    flush_streams();
    joined()->ranks().abort(1);
  }
  joined().reset();
}

JoinedRanks::Turn::Turn(JoinedRanks& joined) : joined_(joined) {
  if (joined.busy_) throw InputError("another thread renders together: one at a time can");
  if (joined.broken_)
    throw InputError(
        "an earlier render together ended with an exception in this process, and the others may still "
        "wait for it: start the script again");
  joined.busy_ = true;
}

JoinedRanks::Turn::~Turn() {
  joined_.busy_ = false;
  joined_.broken_ = !finished_ && joined_.ranks_->size() > 1;
}

}  // namespace vpm::python
