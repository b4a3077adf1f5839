// Reading and writing that is given up: each way of it looks at the flags of its thread.
#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <string>

#include "support/test_file.h"
#include "vpm/base/cancel.h"
#include "vpm/base/fnv.h"
#include "vpm/input/grid/vdb_cursor.h"
#include "vpm/input/mesh/mesh_file.h"
#include "vpm/input/mesh/mesh_writer.h"
#include "vpm/surface/procedural_mesh.h"

namespace vpm {
namespace {

TEST(GivenUp, FilesAreReadAndWrittenNoFurther) {
  const std::string ply = test_file("ring.ply"), obj = test_file("one.obj"), never = test_file("never.ply");
  std::filesystem::remove(never);
  const TriangleMesh mesh = find_procedural_mesh("ring")->make(8);
  write_ply(mesh, ply);
  std::ofstream(obj) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  VdbCursor cursor(ply);  // it takes any bytes
  std::ifstream hashed(ply);
  Fnv1a hash;
  const std::atomic<bool> stop{true};
  const CancelScope scope(stop);
  EXPECT_THROW(load_mesh(ply), Cancelled);
  EXPECT_THROW(load_mesh(obj), Cancelled);
  EXPECT_THROW(cursor.read<char>(), Cancelled);
  EXPECT_THROW(cursor.skip(1), Cancelled);
  EXPECT_THROW(hash.add(hashed), Cancelled);
  EXPECT_THROW(find_procedural_mesh("ring")->make(8), Cancelled);
  EXPECT_THROW(write_ply(mesh, never), Cancelled);
  EXPECT_FALSE(std::filesystem::exists(never));
}

}  // namespace
}  // namespace vpm
