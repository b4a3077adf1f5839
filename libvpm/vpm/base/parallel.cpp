// Work on all cores, cut into chunks: from chunks to tasks.
#include "vpm/base/parallel.h"

#include <algorithm>
#include <atomic>
#include <cassert>

#include "vpm/base/cancel.h"
#include "vpm/base/workers.h"

namespace vpm {
namespace {

/// What the caller wrote is seen by the tasks, what the tasks wrote by the caller. oneTBB does that already; it is said
/// again here, where the thread sanitizer can see it. Static, as a task may read nothing before it.
std::atomic<size_t> handover{0};

void publish() { handover.fetch_add(1, std::memory_order_release); }
void receive() { handover.load(std::memory_order_acquire); }

struct PublishAtEnd {
  ~PublishAtEnd() { publish(); }
};

struct Job {
  size_t count, chunk;
  const std::function<void(size_t, size_t, size_t)>& work;
  const CancelFlags* flags;  // that its caller looks at
};

void run_chunk(void* context, size_t i) {
  receive();
  const PublishAtEnd publish_even_an_exception;
  const Job& job = *static_cast<const Job*>(context);
  const CancelledWith caller(job.flags);
  cancellation_point();
  job.work(i * job.chunk, std::min(job.count, (i + 1) * job.chunk), i);
}

}  // namespace

void parallel_for_chunks(size_t count, size_t chunk,
                         const std::function<void(size_t begin, size_t end, size_t chunk_index)>& work) {
  assert(chunk > 0);
  struct ReceiveAtEnd {
    ~ReceiveAtEnd() { receive(); }
  } const receive_even_an_exception;
  Job job{count, chunk, work, cancel_flags};
  publish();
  run_on_workers(chunk_count(count, chunk), run_chunk, &job);
}

}  // namespace vpm
