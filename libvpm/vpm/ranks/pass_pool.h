// Numbers of passes, which several makers take, and the passes that they make, which one taker joins in order.
#pragma once

#include <condition_variable>
#include <exception>
#include <map>
#include <mutex>

#include "vpm/film/pass.h"

namespace vpm {

/// For any number of threads. Memory is bounded: no more than `ahead` passes are under way or made and not joined yet.
class PassPool {
 public:
  /// What a maker is to do next.
  enum class Order { make, wait, leave };
  struct Task {
    Order order;
    int number = 0;  // of the pass to make
  };

  /// Gives out the numbers of a range in rising order, without those that are there already.
  PassPool(PassRange range, PassSet there, int ahead);

  /// What to do now. `wait`: there is something to do once more passes are joined; `leave`: never again.
  Task try_take();
  /// The same, which waits.
  Task take();

  /// A pass that a maker was asked for. One that comes after close() is dropped.
  void deliver(int number, Pass pass);
  /// Pass `number`, once it is delivered. Throws what fail() was given, and Cancelled where the pool is closed or the
  /// work of this thread is given up.
  Pass join(int number);

  /// From now on there is nothing to make, and nothing to join.
  void close();
  bool closed();
  /// The same where a maker cannot go on.
  void fail(std::exception_ptr why);

 private:
  Task next();  // while locked

  const PassRange range_;
  PassSet taken_;  // or there already
  const int ahead_;
  int under_way_ = 0;  // passes that are taken and not joined
  bool closed_ = false;
  std::exception_ptr failure_;
  std::map<int, Pass> made_;
  std::mutex mutex_;
  std::condition_variable changed_;
};

}  // namespace vpm
