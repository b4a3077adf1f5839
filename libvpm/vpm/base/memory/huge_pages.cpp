// Asking the system for huge pages.
#include "vpm/base/memory/huge_pages.h"

#include <sys/mman.h>

#include <cstdint>
#include <new>

namespace vpm {
namespace {

constexpr size_t kPage = size_t{2} << 20;

bool is_large(size_t bytes) { return bytes >= 2 * kPage; }

size_t whole_pages(size_t bytes) { return (bytes + kPage - 1) / kPage * kPage; }

/// Pages of the system's own, which it gets back at once where they are freed.
void* map_pages(size_t bytes) {
  const size_t size = whole_pages(bytes);
  void* const mapped = mmap(nullptr, size + kPage, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (mapped == MAP_FAILED) throw std::bad_alloc();
  const size_t before = whole_pages(reinterpret_cast<uintptr_t>(mapped)) - reinterpret_cast<uintptr_t>(mapped);
  char* const table = static_cast<char*>(mapped) + before;
  if (before > 0) munmap(mapped, before);
  if (before < kPage) munmap(table + size, kPage - before);
  madvise(table, size, MADV_HUGEPAGE);  // if it is refused, pages are the usual ones
  return table;
}

}  // namespace

void* allocate_table(size_t bytes, size_t alignment) {
  return is_large(bytes) ? map_pages(bytes) : ::operator new (bytes, std::align_val_t{alignment});
}

void free_table(void* table, size_t bytes, size_t alignment) {
  if (is_large(bytes))
    munmap(table, whole_pages(bytes));
  else
    ::operator delete (table, std::align_val_t{alignment});
}

}  // namespace vpm
