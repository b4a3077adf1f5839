// Meshes that are written: the reader gives back the same bits.
#include "vpm/input/mesh/mesh_writer.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "input/expectations.h"
#include "support/test_file.h"
#include "vpm/input/mesh/mesh_file.h"
#include "vpm/surface/mesh.h"
#include "vpm/surface/procedural_mesh.h"

namespace vpm {
namespace {

void expect_round_trip(const TriangleMesh& mesh) {
  const std::string path = test_file("mesh.ply");
  write_ply(mesh, path);
  const LoadedMesh loaded = load_mesh(path);
  EXPECT_EQ(loaded.notes.without_area, 0u);
  EXPECT_EQ(loaded.mesh.positions, mesh.positions);
  EXPECT_EQ(loaded.mesh.normals, mesh.normals);
  EXPECT_EQ(loaded.mesh.uvs, mesh.uvs);
  EXPECT_EQ(loaded.mesh.triangles, mesh.triangles);
}

TEST(MeshWriter, WritesWhatTheReaderReads) {
  for (const ProceduralMesh& mesh : procedural_meshes()) expect_round_trip(mesh.make(20));
}

TEST(MeshWriter, LeavesOutWhatAMeshHasNot) {
  expect_round_trip(box_mesh(Vec3d(-1, 0.1, -1e-20), Vec3d(1, 3e7, 1)));
  expect_round_trip(quad_mesh(Vec3d(0), Vec3d(1, 0, 0), Vec3d(0, 0, 1)));
}

TEST(MeshWriter, WritesLittleEndianBytes) {
  const std::string path = test_file("mesh.ply");
  write_ply({{{1, 2, -0.0f}, {1, 0, 0}, {0, 1, 0}}, {{2, 0, 1}}}, path);
  std::ifstream file(path, std::ios::binary);
  const std::string text(std::istreambuf_iterator<char>(file), {});
  const std::string body = text.substr(text.find("end_header\n") + 11);
  ASSERT_EQ(body.size(), 3u * 12 + 13);
  EXPECT_EQ(body.substr(0, 12), std::string("\0\0\x80\x3f\0\0\0\x40\0\0\0\x80", 12));
  EXPECT_EQ(body.substr(36), std::string("\3\2\0\0\0\0\0\0\0\1\0\0\0", 13));
}

TEST(MeshWriter, RefusesWhatItCannotMake) {
  const std::string path = test_file("none.ply");
  const auto refusal = [&path](const char* name, int resolution) {
    return message_of([&] { write_procedural_mesh(name, resolution, path); });
  };
  EXPECT_EQ(refusal("nothing", 16), "there is no mesh 'nothing' to make; there are: ring, pole, waves");
  EXPECT_EQ(refusal("ring", 2), "resolution 2: must lie between 3 and 2048");
  EXPECT_EQ(refusal("ring", 2049), "resolution 2049: must lie between 3 and 2048");
  EXPECT_FALSE(std::filesystem::exists(path));
}

}  // namespace
}  // namespace vpm
