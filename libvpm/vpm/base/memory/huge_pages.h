// Memory for large tables that are read at random places.
#pragma once

#include <cstddef>
#include <vector>

namespace vpm {

/// Memory of so many bytes, aligned for `alignment`, a power of two; throws std::bad_alloc where there is none. From
/// 4 MiB on it lies on pages of 2 MiB, where the system gives such to who asks for them. A processor remembers where
/// some thousand pages are: of the usual 4 KiB these are few MiB, and each look-up in a larger table waits for the
/// place of its page before it waits for its value. What is freed of such goes back to the system at once.
void* allocate_table(size_t bytes, size_t alignment);
/// Gives it back, by the same numbers.
void free_table(void* table, size_t bytes, size_t alignment);

/// The allocator of such memory.
template <class T>
struct HugePages {
  using value_type = T;

  HugePages() = default;
  template <class Other>
  HugePages(const HugePages<Other>&) {}

  T* allocate(size_t count) { return static_cast<T*>(allocate_table(count * sizeof(T), alignof(T))); }
  void deallocate(T* table, size_t count) { free_table(table, count * sizeof(T), alignof(T)); }
  bool operator==(const HugePages&) const = default;
};

template <class T>
using LargeTable = std::vector<T, HugePages<T>>;

}  // namespace vpm
