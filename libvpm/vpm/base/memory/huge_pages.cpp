// Asking the system for huge pages.
#include "vpm/base/memory/huge_pages.h"

#include <sys/mman.h>

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
  if (is_large(bytes)) madvise(table, bytes, MADV_HUGEPAGE);  // if it is refused, pages are the usual ones
  return table;
}

void free_table(void* table, size_t bytes, size_t alignment) {
  ::operator delete(table, alignment_of(bytes, alignment));
}

}  // namespace vpm
