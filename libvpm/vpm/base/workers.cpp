// The threads behind parallel_for_chunks: oneTBB.
#include "vpm/base/workers.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <memory>
#include <string>

#include "vpm/base/error.h"
#include "vpm/base/parallel.h"

namespace vpm {
namespace {

constexpr int kMostThreads = 1024;

/// The limit holds for everything in the process that uses oneTBB; the arena allows more threads than cores too.
struct Workers {
  tbb::global_control limit;
  tbb::task_arena arena;

  explicit Workers(int n) : limit(tbb::global_control::max_allowed_parallelism, static_cast<size_t>(n)), arena(n) {}
};

std::unique_ptr<Workers>& workers() {
  static auto all = std::make_unique<Workers>(tbb::info::default_concurrency());
  return all;
}

}  // namespace

void set_threads(int n) {
  if (n < 0 || n > kMostThreads) {
    throw InputError("threads = " + std::to_string(n) + ": must be 0 (one for each core) to " +
                     std::to_string(kMostThreads));
  }
  workers().reset();  // limits that exist together give the smallest: end the old one first
  workers() = std::make_unique<Workers>(n == 0 ? tbb::info::default_concurrency() : n);
}

int thread_count() { return workers()->arena.max_concurrency(); }

void run_on_workers(size_t count, void (*task)(void* context, size_t i), void* context) {
  const auto run = [&](const tbb::blocked_range<size_t>& tasks) {
    for (size_t i = tasks.begin(); i != tasks.end(); ++i) task(context, i);
  };
  workers()->arena.execute(
      [&] { tbb::parallel_for(tbb::blocked_range<size_t>(0, count), run, tbb::simple_partitioner()); });
}

}  // namespace vpm
