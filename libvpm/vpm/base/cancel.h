// Work that can be given up from within: cancellation points, as thread libraries have them, for all threads of a task.
#pragma once

#include <atomic>

namespace vpm {

/// Thrown from work that is given up: what it has made so far counts for nothing. It is no std::exception, so that
/// nobody takes it for a failure.
struct Cancelled {};

/// The flags that a thread's work looks at, from the innermost on: where one is set, that work is given up.
struct CancelFlags {
  const std::atomic<bool>& flag;
  const CancelFlags* outer;
};
inline constinit thread_local const CancelFlags* cancel_flags = nullptr;

/// Is the work of this thread, or of the thread whose flags these are, to be given up?
inline bool is_cancelled(const CancelFlags* flags = cancel_flags) {
  for (const CancelFlags* each = flags; each; each = each->outer)
    if (each->flag.load(std::memory_order_relaxed)) return true;
  return false;
}

/// Throws Cancelled where the work of this thread is to be given up. It costs a nanosecond or two, and stands wherever
/// work may go on for a tenth of a second without another.
inline void cancellation_point() {
  if (is_cancelled()) [[unlikely]]
    throw Cancelled();
}

/// While it lives, the work of this thread, and of those that help it (parallel_for_chunks), is given up once `flag` is
/// set, as where a scope around it says so.
class CancelScope {
 public:
  explicit CancelScope(const std::atomic<bool>& flag) : flags_{flag, cancel_flags} { cancel_flags = &flags_; }
  ~CancelScope() { cancel_flags = flags_.outer; }
  CancelScope(const CancelScope&) = delete;
  CancelScope& operator=(const CancelScope&) = delete;

 private:
  const CancelFlags flags_;
};

/// While it lives, this thread looks at the flags of another that it works for, which must live as long; at none where
/// `flags` is null, for work that is to be finished in any case.
class CancelledWith {
 public:
  explicit CancelledWith(const CancelFlags* flags) : own_(cancel_flags) { cancel_flags = flags; }
  ~CancelledWith() { cancel_flags = own_; }
  CancelledWith(const CancelledWith&) = delete;
  CancelledWith& operator=(const CancelledWith&) = delete;

 private:
  const CancelFlags* const own_;
};

}  // namespace vpm
