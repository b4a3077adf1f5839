// Memory for packed tables.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "vpm/base/memory/packed_tables.h"

namespace vpm {

class AlignedBytes {
 public:
  /// So many at least; all are 0.
  explicit AlignedBytes(size_t bytes = 0) : lines_((bytes + kPackedAlignment - 1) / kPackedAlignment) {}

  std::byte* data() { return reinterpret_cast<std::byte*>(lines_.data()); }
  std::span<const std::byte> bytes() const { return std::as_bytes(std::span(lines_)); }
  /// Makes zeros of them, below whoever reads them.
  void wipe() { std::fill(lines_.begin(), lines_.end(), Line{}); }

 private:
  struct alignas(kPackedAlignment) Line {
    std::byte bytes[kPackedAlignment] = {};
  };
  std::vector<Line> lines_;
};

}  // namespace vpm
