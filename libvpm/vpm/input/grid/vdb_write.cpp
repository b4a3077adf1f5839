// The library writes; what it leaves to chance is replaced.
#include "vpm/input/grid/vdb_write.h"

#include <fmt/format.h>
#include <fstream>

#include "vpm/base/atomic_file.h"
#include "vpm/base/error.h"
#include "vpm/base/fnv.h"
#include "vpm/input/grid/vdb_layout.h"

namespace vpm {
namespace {

void write_file(const openvdb::GridPtrVec& grids, const std::string& path) {
  openvdb::io::File file(path);
  file.write(grids);
}

/// Replaces the random number of a file by one that follows from its other bytes.
void fix_unique_number(const std::string& path) {
  constexpr std::streamoff kPlace = 21;  // after magic number, format, library version and the flag for offsets
  std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
  std::string number = "00000000-0000-0000-0000-000000000000";
  file.seekg(kPlace + static_cast<std::streamoff>(number.size()));
  Fnv1a hash;
  hash.add(file);
  const std::string digits = hash.digits();
  number.replace(0, 8, digits.substr(0, 8));
  number.replace(24, 8, digits.substr(8));
  file.clear();
  file.seekp(kPlace);
  file << number << std::flush;
  if (!file) throw InputError(fmt::format("{}: cannot be written", path));
}

/// Throws InputError unless the file is whole: a full disk shows here.
void check_written(const std::string& path) {
  VdbCursor cursor(path);
  read_vdb_layout(cursor);
}

}  // namespace

openvdb::math::Transform::Ptr transform_of(const Mat4d& index_to_world) {
  openvdb::math::Mat4d rows;  // acts on rows, where ours acts on columns: its memory is the same
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) rows[i][j] = index_to_world[i][j];
  return openvdb::math::Transform::createLinearTransform(rows);
}

void write_vdb(const std::function<openvdb::GridPtrVec()>& make, const std::string& path) {
  TemporaryFile file(path);
  try {
    openvdb::initialize();
    write_file(make(), file.path());
    fix_unique_number(file.path());
  } catch (const std::exception& e) {
    throw InputError(fmt::format("{}: cannot be written: {}", path, e.what()));
  }
  check_written(file.path());
  file.commit();
}

}  // namespace vpm
