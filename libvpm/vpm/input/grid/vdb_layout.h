// What a .vdb file holds, read from its own bytes: the grids' names, types and places. OpenVDB trusts the lengths it
// finds in a file, so a damaged one can make it write past its buffers or wait for ever; everything it will read is
// checked here first.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "vpm/input/grid/vdb_cursor.h"

namespace vpm {

/// One grid of a file, before its values are read.
struct VdbGridEntry {
  std::string name;                    // as users write it: "density", or "density[1]" where a name repeats
  std::string type;                    // "Tree_float_5_4_3"
  bool stored_half = false;            // floats are stored in 16 bits
  std::string tree_of;                 // name of the grid whose tree this one shares; usually empty
  std::string grid_class = "unknown";  // "fog volume", "level set", ...
  std::string map_type;                // "UniformScaleMap", "AffineMap", ...
  uint64_t stated_voxels = 0;          // active voxels according to the file's metadata; 0 where it says nothing
  uint32_t compression = 0;            // flags of openvdb::io
  uint64_t transform_position = 0;     // byte at which the transform begins; the tree follows it

  /// "float", "float stored as half", "double", "vec3s", ...
  std::string value_type() const;
  /// Whether its values are numbers, whole ones and bool too, in a tree of the standard shape: what can be densities.
  bool scalar() const { return value_bytes() > 0; }
  /// The size of such a value in memory, and of single ones in the file; 0 of others.
  uint64_t value_bytes() const;
  /// Do leaves hold bits and their origin in the place of values? Those of masks are their active voxels.
  bool holds_bits() const { return value_bytes() == 1; }
  bool is_mask() const { return type == "Tree_mask_5_4_3"; }
  /// Whether its transform is a 4 x 4 matrix.
  bool affine() const;
};

struct VdbLayout {
  uint32_t file_version = 0;
  uint32_t library_major = 0, library_minor = 0;
  std::vector<VdbGridEntry> grids;

  /// The grid of that name, or null; a name that repeats needs its suffix. Where none has it, the only one that has it
  /// but for capitals.
  const VdbGridEntry* find(const std::string& name) const;
  /// "the file holds: density (float, fog volume), vel (vec3s, staggered)".
  std::string listing() const;
};

/// Reads the header, the descriptors and the metadata. Throws InputError for what is not a whole .vdb file of format
/// 222 to 225.
VdbLayout read_vdb_layout(VdbCursor& cursor);

/// Walks the tree of a scalar grid, which begins at the cursor, without keeping its values: node masks, compressed
/// blocks, lengths. Leaves the cursor where it was. Throws InputError at the first thing that OpenVDB could not read
/// safely.
void check_vdb_tree(VdbCursor& cursor, const VdbGridEntry& entry);

}  // namespace vpm
