// The pool: a map behind a lock that is held for a moment a pass.
#include "vpm/ranks/pass_pool.h"

#include <cassert>
#include <chrono>
#include <utility>

#include "vpm/base/cancel.h"

namespace vpm {

PassPool::PassPool(PassRange range, PassSet there, int ahead) : range_(range), taken_(std::move(there)), ahead_(ahead) {
  assert(ahead > 0);
}

PassPool::Task PassPool::next() {
  const int number = taken_.first_missing(range_.first);
  if (closed_ || number >= range_.end) return {Order::leave};
  if (under_way_ >= ahead_) return {Order::wait};
  taken_.add({number, number + 1});
  ++under_way_;
  return {Order::make, number};
}

PassPool::Task PassPool::try_take() {
  const std::lock_guard lock(mutex_);
  return next();
}

PassPool::Task PassPool::take() {
  std::unique_lock lock(mutex_);
  for (;;) {
    const Task task = next();
    if (task.order != Order::wait) return task;
    changed_.wait(lock);
  }
}

void PassPool::deliver(int number, Pass pass) {
  const std::lock_guard lock(mutex_);
  if (closed_) return;
  made_.emplace(number, std::move(pass));
  changed_.notify_all();
}

Pass PassPool::join(int number) {
  constexpr std::chrono::milliseconds kBetweenLooks(20);  // at whether the work is given up
  std::unique_lock lock(mutex_);
  while (!changed_.wait_for(lock, kBetweenLooks, [&] { return closed_ || made_.contains(number); }))
    cancellation_point();
  if (failure_) std::rethrow_exception(failure_);
  if (closed_) throw Cancelled();
  Pass pass = std::move(made_.extract(number).mapped());
  --under_way_;
  changed_.notify_all();
  return pass;
}

void PassPool::close() {
  const std::lock_guard lock(mutex_);
  closed_ = true;
  made_.clear();
  changed_.notify_all();
}

bool PassPool::closed() {
  const std::lock_guard lock(mutex_);
  return closed_;
}

void PassPool::fail(std::exception_ptr why) {
  const std::lock_guard lock(mutex_);
  closed_ = true;
  failure_ = std::move(why);
  changed_.notify_all();
}

}  // namespace vpm
