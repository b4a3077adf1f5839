// Tables one after another in one piece of memory, which other processes of the same program read where they lie.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

namespace vpm {

/// Each table begins a multiple of so many bytes after the first.
constexpr size_t kPackedAlignment = 64;

class TablePacker {
 public:
  /// Writes from `memory` on, which is aligned for kPackedAlignment; null: only counts the bytes.
  explicit TablePacker(std::byte* memory) : memory_(memory) {}

  /// Copies the entries' bytes, which must mean the same in any process: no addresses.
  template <class T>
  void add(std::span<const T> table) {
    add_one(uint64_t{table.size()});
    put(table);
  }
  /// A table of one entry.
  template <class T>
  void add_one(const T& entry) {
    put(std::span(&entry, 1));
  }
  /// So many were written so far, or would have been.
  size_t bytes() const { return bytes_; }

 private:
  template <class T>
  void put(std::span<const T> table) {
    // Vectors of glm's have constructors that copy their bytes, by which they do not count as trivial.
    static_assert(std::is_trivially_destructible_v<T> && std::is_standard_layout_v<T> && !std::is_pointer_v<T>);
    static_assert(alignof(T) <= kPackedAlignment);
    const std::span<const std::byte> bytes = std::as_bytes(table);
    if (memory_) std::copy(bytes.begin(), bytes.end(), memory_ + bytes_);
    bytes_ += (bytes.size() + kPackedAlignment - 1) / kPackedAlignment * kPackedAlignment;
  }

  std::byte* memory_;
  size_t bytes_ = 0;
};

/// Takes tables in the order in which they were added, and with the same types; what else lies there is not noticed.
class TableUnpacker {
 public:
  explicit TableUnpacker(std::span<const std::byte> memory) : rest_(memory) {}

  /// The next table: a view of that memory.
  template <class T>
  std::span<const T> take() {
    const auto count = static_cast<size_t>(take_one<uint64_t>());
    return {take_entries<T>(count), count};
  }
  /// The next table of one entry.
  template <class T>
  const T& take_one() {
    return *take_entries<T>(1);
  }

 private:
  template <class T>
  const T* take_entries(size_t count) {
    const std::byte* const table = rest_.data();
    const size_t bytes = (count * sizeof(T) + kPackedAlignment - 1) / kPackedAlignment * kPackedAlignment;
    assert(bytes <= rest_.size());
    rest_ = rest_.subspan(bytes);
    return reinterpret_cast<const T*>(table);
  }

  std::span<const std::byte> rest_;
};

}  // namespace vpm
