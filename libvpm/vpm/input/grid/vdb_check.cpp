// Walking the tree of a scalar grid through its bytes, so that OpenVDB meets only lengths that fit.
//
// In the file: buffer count; root: background, tiles, children; a child is two masks, its compressed values, its own
// children; a leaf is a mask. Then, for every leaf, a mask and its compressed values; of bits, a mask, the leaf's
// origin and, but for masks, the bits. Packed blocks are unpacked on the way: where OpenVDB meets one that cannot be,
// it loses the nodes that it is about to make.
#include <fmt/format.h>
#include <openvdb/io/Compression.h>
#include <array>
#include <bitset>
#include <memory>
#include <set>
#include <vector>

#include "vpm/input/grid/vdb_layout.h"

namespace vpm {
namespace {

enum Compression : uint32_t { kZip = 1, kActiveMask = 2, kBlosc = 4 };

constexpr size_t kLeafValues = 512;     // 8^3
constexpr size_t kLowerValues = 4096;   // 16^3
constexpr size_t kUpperValues = 32768;  // 32^3
constexpr int kRootChildSize = 4096;    // voxels along the edge of a root's child

struct TreeChecker {
  VdbCursor& cursor;
  const VdbGridEntry& entry;
  uint64_t value_bytes;                             // in memory; also in the file, for single values
  std::vector<std::array<int32_t, 3>> leaves = {};  // their origins
  std::vector<char> unpacked = {};

  template <size_t N>
  void read_mask(std::bitset<N>& mask) {
    cursor.read_bytes(&mask, sizeof(mask));
  }
  void check_root();
  void check_tile();
  template <size_t N>
  void check_inner(const std::array<int32_t, 3>& origin);
  void check_leaf(const std::array<int32_t, 3>& origin);
  void check_compressed(uint64_t values, uint64_t active, uint64_t mask_bytes);
  void check_block(uint64_t bytes);
  void unpack(uint64_t position, uint64_t bytes);
};

/// A block of `bytes` bytes once unpacked: its stored length comes first, negative or zero where it is not packed.
void TreeChecker::check_block(uint64_t bytes) {
  if (!(entry.compression & (kBlosc | kZip))) return cursor.skip(bytes);
  const uint64_t begin = cursor.position();
  const auto stored = cursor.read<int64_t>();
  if (stored <= 0) {
    if (stored != -static_cast<int64_t>(bytes))
      cursor.damaged(fmt::format("a block of {} bytes instead of {}", stored, bytes));
    return cursor.skip(bytes);
  }
  const auto length = static_cast<uint64_t>(stored);
  if (length > 2 * bytes + 1024) cursor.damaged(fmt::format("{} bytes packed into {}", bytes, length));
  struct BloscHeader {
    uint32_t versions_and_flags, unpacked, block, packed;
  };
  if (entry.compression & kBlosc) {
    if (length < sizeof(BloscHeader)) cursor.damaged(fmt::format("a packed block of {} bytes", length));
    const auto header = cursor.read<BloscHeader>();
    if (header.unpacked != bytes || header.packed != length)
      cursor.damaged(fmt::format("a block that unpacks {} bytes to {} instead of {} to {}", header.packed,
                                 header.unpacked, length, bytes));
  }
  cursor.seek(begin + sizeof(stored));
  cursor.skip(length);
  unpack(begin, bytes);
}

/// Unpacks the block at `position` as OpenVDB does.
void TreeChecker::unpack(uint64_t position, uint64_t bytes) {
  const uint64_t end = cursor.position();
  cursor.seek(position);
  unpacked.resize(bytes);
  try {
    if (entry.compression & kBlosc)
      openvdb::io::bloscFromStream(cursor.stream(), unpacked.data(), bytes);
    else
      openvdb::io::unzipFromStream(cursor.stream(), unpacked.data(), bytes);
  } catch (const openvdb::Exception& e) {
    cursor.damaged(e.what());
  }
  cursor.seek(end);
}

/// Values of a node: a code for what the inactive ones are, the one or two values and the mask that this needs, the
/// rest in a block.
void TreeChecker::check_compressed(uint64_t values, uint64_t active, uint64_t mask_bytes) {
  const auto code = cursor.read<int8_t>();
  if (code < 0 || code > 6) cursor.damaged(fmt::format("unknown coding {} of inactive values", code));
  const bool one_value = code == 2 || code == 4;
  const bool two_values = code == 5;
  const bool has_mask = code == 3 || code == 4 || code == 5;
  cursor.skip((one_value ? 1 : two_values ? 2 : 0) * value_bytes + (has_mask ? mask_bytes : 0));
  const uint64_t count = (entry.compression & kActiveMask) && code != 6 ? active : values;
  if (entry.stored_half && count == 0) return;
  check_block(count * (entry.stored_half ? 2 : value_bytes));
}

/// A place in a node whose edge holds 2^Log2 nodes of `size` voxels: the last coordinate varies first.
template <int Log2>
std::array<int32_t, 3> origin_of_child(const std::array<int32_t, 3>& node, size_t place, int32_t size) {
  constexpr size_t kMask = (1u << Log2) - 1;
  const auto at = [&](int axis, size_t number) {
    return node[static_cast<size_t>(axis)] + size * static_cast<int32_t>(number);
  };
  return {at(0, place >> (2 * Log2)), at(1, place >> Log2 & kMask), at(2, place & kMask)};
}

template <size_t N>
void TreeChecker::check_inner(const std::array<int32_t, 3>& origin) {
  const auto children = std::make_unique<std::bitset<N>>();
  const auto active = std::make_unique<std::bitset<N>>();
  read_mask(*children);
  read_mask(*active);
  if ((*children & *active).any()) cursor.damaged("a node that is a value and has children there");
  check_compressed(N, active->count(), sizeof(*active));
  for (size_t i = 0; i < N; ++i) {
    if (!(*children)[i]) continue;
    if constexpr (N == kUpperValues) {
      check_inner<kLowerValues>(origin_of_child<5>(origin, i, 128));
    } else {
      cursor.skip(sizeof(std::bitset<kLeafValues>));
      leaves.push_back(origin_of_child<4>(origin, i, 8));
    }
  }
}

/// The values of a leaf. OpenVDB takes an origin that it finds there for the leaf's own.
void TreeChecker::check_leaf(const std::array<int32_t, 3>& origin) {
  std::bitset<kLeafValues> active;
  read_mask(active);
  if (!entry.holds_bits()) return check_compressed(kLeafValues, active.count(), sizeof(active));
  if (cursor.read<std::array<int32_t, 3>>() != origin) cursor.damaged("a leaf that says to lie where it does not");
  if (!entry.is_mask()) cursor.skip(sizeof(active));
}

/// A tile of the root: its value and whether it is active, which OpenVDB reads into a bool as it is.
void TreeChecker::check_tile() {
  cursor.skip(value_bytes);
  if (const auto active = cursor.read<uint8_t>(); active > 1)
    cursor.damaged(fmt::format("a tile that is active: {}, neither 0 nor 1", active));
}

void TreeChecker::check_root() {
  if (cursor.read<int32_t>() != 1) cursor.damaged("a tree with several buffers");
  cursor.skip(value_bytes);  // background
  const auto tiles = cursor.read<uint32_t>();
  const auto children = cursor.read<uint32_t>();
  std::set<std::array<int32_t, 3>> origins;
  for (uint64_t i = 0; i < uint64_t{tiles} + children; ++i) {
    const auto origin = cursor.read<std::array<int32_t, 3>>();
    for (const int32_t x : origin)
      if (x % kRootChildSize != 0)
        cursor.damaged(fmt::format("a node at voxel {}, off the lattice of {}", x, kRootChildSize));
    if (!origins.insert(origin).second) cursor.damaged("two nodes at one place");
    if (i < tiles)
      check_tile();
    else
      check_inner<kUpperValues>(origin);
  }
}

}  // namespace

void check_vdb_tree(VdbCursor& cursor, const VdbGridEntry& entry) {
  const uint64_t begin = cursor.position();
  TreeChecker checker{cursor, entry, entry.value_bytes()};
  checker.check_root();
  for (const auto& origin : checker.leaves) checker.check_leaf(origin);
  cursor.seek(begin);
}

}  // namespace vpm
