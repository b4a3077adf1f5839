// Chunks cover the work once and are the same for any number of threads.
#include "vpm/base/parallel.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

#include "vpm/base/error.h"

namespace vpm {
namespace {

class Parallel : public testing::Test {
 protected:
  ~Parallel() override { set_threads(0); }
};

/// A sum in floats, whose value depends on the order of its terms, chunk by chunk.
float chunked_sum(size_t count, size_t chunk) {
  std::vector<float> parts(chunk_count(count, chunk), 0.0f);
  parallel_for_chunks(count, chunk, [&](size_t begin, size_t end, size_t index) {
    for (size_t i = begin; i < end; ++i) parts[index] += std::sin(static_cast<float>(i));
  });
  float sum = 0.0f;
  for (float part : parts) sum += part;
  return sum;
}

TEST_F(Parallel, CoversEveryItemOnce) {
  for (const size_t count : {0u, 1u, 6u, 7u, 8u, 1000u}) {
    std::vector<std::atomic<int>> seen(count), chunks(chunk_count(count, 7));
    parallel_for_chunks(count, 7, [&](size_t begin, size_t end, size_t index) {
      EXPECT_EQ(begin, index * 7);
      EXPECT_EQ(end, std::min(count, begin + 7));
      ++chunks[index];
      for (size_t i = begin; i < end; ++i) ++seen[i];
    });
    for (const auto& n : seen) EXPECT_EQ(n, 1);
    for (const auto& n : chunks) EXPECT_EQ(n, 1);
  }
}

TEST_F(Parallel, TheSameBitsForAnyNumberOfThreads) {
  set_threads(1);
  const float one = chunked_sum(100000, 64);
  EXPECT_NE(one, chunked_sum(100000, 63));  // the order does matter
  for (const int n : {2, 3, 8}) {
    set_threads(n);
    for (int repeat = 0; repeat < 5; ++repeat) EXPECT_EQ(one, chunked_sum(100000, 64));
  }
}

/// How many threads take part in work that waits until so many have come, or for ten seconds on a busy machine.
size_t threads_at_work(size_t awaited) {
  std::mutex mutex;
  std::condition_variable came;
  std::set<std::thread::id> threads;
  parallel_for_chunks(64, 1, [&](size_t, size_t, size_t) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    std::unique_lock<std::mutex> lock(mutex);
    threads.insert(std::this_thread::get_id());
    came.notify_all();
    came.wait_for(lock, std::chrono::seconds(10), [&] { return threads.size() >= awaited; });
  });
  return threads.size();
}

TEST_F(Parallel, KeepsToTheNumberOfThreads) {
  set_threads(0);
  EXPECT_GE(thread_count(), 1);
  EXPECT_LE(thread_count(), static_cast<int>(std::thread::hardware_concurrency()));
  for (const int n : {1, 2, 4, 1}) {  // up, also above the number of cores, and down again
    set_threads(n);
    EXPECT_EQ(thread_count(), n);
    const auto awaited = static_cast<size_t>(std::min(n, 2));
    const size_t at_work = threads_at_work(awaited);
    EXPECT_LE(at_work, static_cast<size_t>(n));
    EXPECT_GE(at_work, awaited);
  }
}

TEST_F(Parallel, RefusesSenselessNumbers) {
  EXPECT_THROW(set_threads(-1), InputError);
  EXPECT_THROW(set_threads(1 << 20), InputError);
  EXPECT_GE(thread_count(), 1);
}

TEST_F(Parallel, ExceptionsComeOut) {
  for (const int n : {1, 2}) {
    set_threads(n);
    std::atomic<int> calls{0};
    const auto work = [&](size_t, size_t, size_t index) {
      ++calls;
      if (index == 3) throw std::runtime_error("chunk 3");
    };
    EXPECT_THROW(parallel_for_chunks(100000, 1, work), std::runtime_error);
    EXPECT_LT(calls, 100000);
  }
  EXPECT_NO_THROW(parallel_for_chunks(10, 1, [](size_t, size_t, size_t) {}));
}

TEST_F(Parallel, MayBeNested) {
  std::array<std::atomic<int>, 64> seen{};
  parallel_for_chunks(8, 1, [&](size_t row, size_t, size_t) {
    parallel_for_chunks(8, 1, [&](size_t column, size_t, size_t) { ++seen[8 * row + column]; });
  });
  for (const auto& n : seen) EXPECT_EQ(n, 1);
}

}  // namespace
}  // namespace vpm
