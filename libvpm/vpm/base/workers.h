// The threads behind parallel_for_chunks: the part that knows oneTBB, kept apart for the thread sanitizer.
#pragma once

#include <cstddef>

namespace vpm {

/// Calls task(context, i) once for each i < count on all threads and returns when all are done; an exception ends the
/// work and comes out. Use parallel_for_chunks: this file is compiled without the thread sanitizer, which cannot see
/// into oneTBB and would raise false alarms, so callers must order memory by themselves.
void run_on_workers(size_t count, void (*task)(void* context, size_t i), void* context);

}  // namespace vpm
