// The processes that mpiexec started this one with, of which renders together make use one at a time.
#pragma once

#include <memory>
#include <utility>

#include "vpm/ranks/ranks.h"

namespace vpm::python {

class JoinedRanks {
 public:
  /// Joins them at its first call; they are left when Python ends. Throws InputError where they are several and vpm is
  /// built without MPI.
  static JoinedRanks& own();

  Ranks& ranks() { return *ranks_; }

  /// What this process does with the others, from here to its scope's end; done with the interpreter's lock. Throws
  /// InputError where another thread has its turn, or where an earlier turn was not finished, after which the others
  /// may wait for messages that never come.
  class Turn {
   public:
    explicit Turn(JoinedRanks& joined);
    ~Turn();
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;

    /// All was said that the others wait for.
    void finish() { finished_ = true; }

   private:
    JoinedRanks& joined_;
    bool finished_ = false;
  };

 private:
  explicit JoinedRanks(std::unique_ptr<Ranks> ranks) : ranks_(std::move(ranks)) {}
  static void leave();

  std::unique_ptr<Ranks> ranks_;
  bool busy_ = false, broken_ = false;
};

}  // namespace vpm::python
