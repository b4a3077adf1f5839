// Tables one after another in one piece of memory, which other processes of the same program read where they lie.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

namespace vpm {

/// Where each table begins is a multiple of so many bytes from where the first does.
constexpr size_t kPackedAlignment = 64;

class TablePacker {
 public:
  /// Writes from `memory` on, which is aligned for kPackedAlignment; null: only counts the bytes.
  explicit TablePacker(std::byte* memory) : memory_(memory) {}

  template <class T>
  void add(std::span<const T> table) {
    const uint64_t count = table.size();
    put(std::as_bytes(std::span(&count, 1)));
    put_table(table);
  }
  /// A table of one entry.
  template <class T>
  void add_one(const T& entry) {
    put_table(std::span(&entry, 1));
  }
  /// So many were written so far, or would have been.
  size_t bytes() const { return bytes_; }

 private:
  template <class T>
  void put_table(std::span<const T> table) {
    // Bytes are what it is: of vectors of glm's, too, which have constructors of their own.
    static_assert(std::is_trivially_destructible_v<T> && std::is_standard_layout_v<T>);
    static_assert(!std::is_pointer_v<T> && alignof(T) <= kPackedAlignment);
    put(std::as_bytes(table));
  }
  void put(std::span<const std::byte> bytes) {
    if (memory_) std::copy(bytes.begin(), bytes.end(), memory_ + bytes_);
    bytes_ += (bytes.size() + kPackedAlignment - 1) / kPackedAlignment * kPackedAlignment;
  }

  std::byte* memory_;
  size_t bytes_ = 0;
};

/// Takes tables in the order in which they were added, and with the same types.
class TableUnpacker {
 public:
  explicit TableUnpacker(std::span<const std::byte> memory) : rest_(memory) {}

  /// It lies in the memory.
  template <class T>
  std::span<const T> take() {
    const auto count = static_cast<size_t>(take_one<uint64_t>());
    return {take_table<T>(count), count};
  }
  template <class T>
  const T& take_one() {
    return *take_table<T>(1);
  }

 private:
  template <class T>
  const T* take_table(size_t count) {
    const std::byte* const table = rest_.data();
    const size_t bytes = (count * sizeof(T) + kPackedAlignment - 1) / kPackedAlignment * kPackedAlignment;
    assert(bytes <= rest_.size());
    rest_ = rest_.subspan(bytes);
    return reinterpret_cast<const T*>(table);
  }

  std::span<const std::byte> rest_;
};

}  // namespace vpm
