// Work on all cores, cut into chunks that do not depend on the number of threads.
#pragma once

#include <cstddef>
#include <functional>

namespace vpm {

/// From now on at most `n` threads work at once, the caller included; 0 = one for each core. Throws InputError unless
/// 0 <= n <= 1024. Not while work is running.
void set_threads(int n);

/// How many threads work at once.
int thread_count();

/// The number of chunks that `count` items make: the last one may be shorter.
inline size_t chunk_count(size_t count, size_t chunk) { return (count + chunk - 1) / chunk; }

/// Calls work(begin, end, chunk_index) once for each chunk [begin, end) of `chunk` > 0 items of [0, count), in no
/// particular order, on all threads, and returns when all are done. Results kept by chunk_index and joined in that
/// order are the same for any number of threads. An exception ends the work: no new chunk starts, and one exception
/// comes out. Calls may be nested.
void parallel_for_chunks(size_t count, size_t chunk,
                         const std::function<void(size_t begin, size_t end, size_t chunk_index)>& work);

}  // namespace vpm
