// Work that is given up: by a flag, on all threads, by a time; and what is not.
#include "vpm/base/clock.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <thread>

#include "support/simulated_clock.h"
#include "vpm/base/parallel.h"

namespace vpm {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

TEST(Cancel, OnlyInsideAScopeWhoseFlagIsSet) {
  std::atomic<bool> outer{false}, inner{false};
  EXPECT_NO_THROW(cancellation_point());
  const CancelScope around(outer);
  {
    const CancelScope within(inner);
    EXPECT_NO_THROW(cancellation_point());
    inner = true;
    EXPECT_THROW(cancellation_point(), Cancelled);
  }
  EXPECT_FALSE(is_cancelled());
  outer = true;
  inner = false;
  const CancelScope within(inner);
  EXPECT_TRUE(is_cancelled());
  const CancelledWith finishing(nullptr);
  EXPECT_NO_THROW(cancellation_point()) << "what is to be finished";
}

TEST(Cancel, ReachesTheThreadsThatHelp) {
  std::atomic<bool> stop{false};
  std::atomic<int> begun{0}, blind{0};
  const CancelScope scope(stop);
  const auto work = [&](size_t i, size_t, size_t) {
    parallel_for_chunks(4, 1, [&](size_t, size_t, size_t) {
      ++begun;
      if (!cancel_flags) ++blind;
      if (i == 3) stop = true;
    });
  };
  EXPECT_THROW(parallel_for_chunks(10'000, 1, work), Cancelled);
  EXPECT_LT(begun, 4 * 10'000);
  EXPECT_EQ(blind, 0) << "threads do not see the flags of the one that they help";
  EXPECT_NO_THROW(([&] {
    const CancelledWith finishing(nullptr);
    parallel_for_chunks(100, 1, [](size_t, size_t, size_t) { cancellation_point(); });
  }()));
}

TEST(Clock, GivesUpWhatTakesTooLong) {
  const SimulatedClock clock;
  EXPECT_TRUE(clock.finish_by(2.0, [&] { clock.work(1.9); }));
  EXPECT_FALSE(clock.finish_by(3.0, [&] { clock.work(5.0); }));
  EXPECT_DOUBLE_EQ(clock.seconds(), 3.0);
  EXPECT_TRUE(clock.finish_by(kNever, [&] { clock.work(5.0); }));
  EXPECT_NO_THROW(cancellation_point());
  EXPECT_THROW(clock.finish_by(9.0, [] { throw std::domain_error("its own"); }), std::domain_error);
}

TEST(Clock, AsksForALaterEnd) {
  const SimulatedClock clock;
  std::vector<double> asked;
  const auto later = [&] {
    asked.push_back(clock.seconds());
    return asked.size() < 3 ? clock.seconds() + 1.0 : 0.0;
  };
  EXPECT_FALSE(clock.finish_by(
      2.0, [&] { clock.work(9.0); }, later));
  EXPECT_EQ(asked, (std::vector{2.0, 3.0, 4.0}));
}

TEST(Clock, TellsItsOwnEndFromThatOfWorkAroundIt) {
  const SimulatedClock clock;
  bool inner_ended = false;
  EXPECT_FALSE(clock.finish_by(1.0, [&] {
    clock.finish_by(2.0, [&] { clock.work(9.0); });
    inner_ended = true;
  }));
  EXPECT_FALSE(inner_ended);
  EXPECT_FALSE(clock.finish_by(9.0, [&] {
    EXPECT_FALSE(clock.finish_by(2.0, [&] { clock.work(5.0); }));
    clock.work(99.0);
  }));
}

TEST(WallClock, EndsWorkThatNeverEnds) {
  const WallClock clock;
  const auto never_ends = [] {
    for (;; std::this_thread::yield()) cancellation_point();
  };
  EXPECT_FALSE(clock.finish_by(0.02, never_ends));
  EXPECT_GE(clock.seconds(), 0.02);
  // Each new end is over as soon as it is told, or hardly later.
  int asked = 0;
  EXPECT_FALSE(clock.finish_by(0.0, never_ends, [&] { return ++asked < 1000 ? clock.seconds() + 1e-7 : 0.0; }));
  EXPECT_TRUE(clock.finish_by(kNever, [] {}));
}

}  // namespace
}  // namespace vpm
