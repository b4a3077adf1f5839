// Asking the system for huge pages.
#include "vpm/base/huge_pages.h"

#include <sys/mman.h>

#include <cstdint>
#include <new>

namespace vpm {
namespace {

constexpr size_t kPage = size_t{2} << 20;

bool is_large(size_t bytes) { return bytes >= 2 * kPage; }

std::align_val_t alignment_of(size_t bytes, size_t alignment) {
  return std::align_val_t{is_large(bytes) ? kPage : alignment};
}

}  // namespace

void* allocate_table(size_t bytes, size_t alignment) {
  void* const table = ::operator new(bytes, alignment_of(bytes, alignment));
  if (is_large(bytes)) ask_for_huge_pages(table, bytes);
  return table;
}

void ask_for_huge_pages(void* memory, size_t bytes) {
  const auto place = reinterpret_cast<uintptr_t>(memory), first = (place + kPage - 1) / kPage * kPage;
  if (first < place + bytes) madvise(reinterpret_cast<void*>(first), place + bytes - first, MADV_HUGEPAGE);
}

void free_table(void* table, size_t bytes, size_t alignment) {
  ::operator delete(table, bytes, alignment_of(bytes, alignment));
}

}  // namespace vpm
