// The pool of passes: every number once, in bounded room, joined in order.
#include "vpm/ranks/pass_pool.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <thread>
#include <vector>

#include "vpm/base/cancel.h"

namespace vpm {
namespace {

using Order = PassPool::Order;

/// A pass that tells its number.
Pass pass_of_number(int number) {
  Pass pass(1, 1);
  pass.image.at(0, 0) = Rgb(static_cast<float>(number));
  return pass;
}
int number_of(const Pass& pass) { return static_cast<int>(pass.image.at(0, 0).r); }

TEST(PassPool, GivesOutWhatIsMissingInOrder) {
  PassPool pool({2, 9}, PassSet({{2, 4}, {6, 7}}), 100);
  for (const int expected : {4, 5, 7, 8}) {
    const PassPool::Task task = pool.try_take();
    EXPECT_EQ(task.order, Order::make);
    EXPECT_EQ(task.number, expected);
  }
  EXPECT_EQ(pool.try_take().order, Order::leave);
}

TEST(PassPool, HasNoMoreUnderWayThanThereIsRoomFor) {
  PassPool pool({0, std::numeric_limits<int>::max()}, {}, 2);
  EXPECT_EQ(pool.try_take().number, 0);
  EXPECT_EQ(pool.try_take().number, 1);
  EXPECT_EQ(pool.try_take().order, Order::wait);
  pool.deliver(1, pass_of_number(1));
  EXPECT_EQ(pool.try_take().order, Order::wait) << "pass 1 is made, but waits for pass 0";
  pool.deliver(0, pass_of_number(0));
  EXPECT_EQ(number_of(pool.join(0)), 0);
  const PassPool::Task next = pool.try_take();
  EXPECT_EQ(next.order, Order::make);
  EXPECT_EQ(next.number, 2);
  EXPECT_EQ(pool.try_take().order, Order::wait);
}

TEST(PassPool, JoinsThePassesOfManyMakersInOrder) {
  constexpr int kPasses = 500, kMakers = 7;
  PassPool pool({0, kPasses}, {}, 2 * kMakers);
  std::vector<std::thread> makers;
  for (int i = 0; i < kMakers; ++i)
    makers.emplace_back([&] {
      for (PassPool::Task task = pool.take(); task.order == Order::make; task = pool.take())
        pool.deliver(task.number, pass_of_number(task.number));
    });
  for (int number = 0; number < kPasses; ++number) EXPECT_EQ(number_of(pool.join(number)), number);
  for (std::thread& maker : makers) maker.join();
  EXPECT_EQ(pool.try_take().order, Order::leave);
}

TEST(PassPool, WakesAllWhenItIsClosed) {
  PassPool pool({0, 9}, {}, 1);
  EXPECT_EQ(pool.take().number, 0);
  std::thread maker([&] { EXPECT_EQ(pool.take().order, Order::leave); });
  std::thread joiner([&] { EXPECT_THROW(pool.join(0), Cancelled); });
  EXPECT_FALSE(pool.closed());
  pool.close();
  maker.join();
  joiner.join();
  EXPECT_TRUE(pool.closed());
  pool.deliver(0, pass_of_number(0));
  EXPECT_THROW(pool.join(0), Cancelled) << "what comes late is dropped";
}

TEST(PassPool, TellsTheJoinerWhyAMakerCannotGoOn) {
  PassPool pool({0, 9}, {}, 4);
  std::thread joiner([&] { EXPECT_THROW(pool.join(0), std::domain_error); });
  pool.fail(std::make_exception_ptr(std::domain_error("no")));
  joiner.join();
  EXPECT_EQ(pool.try_take().order, Order::leave);
}

}  // namespace
}  // namespace vpm
