// Meshes: what PLY and OBJ files say, in every encoding, and a clear refusal of every damaged one.
#include "vpm/input/mesh/mesh_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <fstream>

#include "input/expectations.h"
#include "support/test_file.h"

namespace vpm {
namespace {

std::string write_file(const std::string& name, const std::string& text) {
  const std::string path = test_file(name);
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

/// The bytes of a value in the given order.
template <class T>
std::string bytes(T value, std::endian order) {
  std::string s(sizeof value, '\0');
  std::memcpy(s.data(), &value, sizeof value);
  if (order != std::endian::native) std::reverse(s.begin(), s.end());
  return s;
}

/// A unit square in the plane z = 0.25, as one polygon of four corners.
void expect_square(const LoadedMesh& loaded) {
  const TriangleMesh& mesh = loaded.mesh;
  EXPECT_EQ(mesh.positions, (std::vector<Vec3>{{0, 0, 0.25}, {1, 0, 0.25}, {1, 1, 0.25}, {0, 1, 0.25}}));
  EXPECT_EQ(mesh.triangles, (std::vector<glm::uvec3>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(loaded.notes.without_area, 0u);
  EXPECT_TRUE(mesh.normals.empty() && mesh.uvs.empty());
}

TEST(MeshFile, ReadsAsciiPly) {
  expect_square(
      load_mesh(write_file("square.ply",
                           "ply\r\nformat ascii 1.0\nobj_info made by hand\nelement vertex 4\nproperty double x\n"
                           "property float y\nproperty float z\nproperty uchar red\nelement edge 1\n"
                           "property int vertex1\nproperty int vertex2\nelement face 1\nproperty uchar flags\n"
                           "property list uchar uint vertex_index\nproperty list uchar float weights\nend_header\n"
                           "0 0 .25 255\n1 0 2.5e-1 0\n+1 1 0.25 0\n0 1\n0.25 0\n0 1\n7 4 0 1 2 3 2 0.5 0.5\n")));
}

/// Every scalar type, a list to skip, and an unknown element between vertices and faces.
std::string binary_ply(std::endian order) {
  const bool little = order == std::endian::little;
  std::string text =
      "ply\nformat binary_" + std::string(little ? "little" : "big") +
      "_endian 1.0\nelement vertex 4\nproperty char x\nproperty float64 z\nproperty list ushort int16 skipped\n"
      "property float32 y\nelement thing 2\nproperty uint32 a\nproperty int32 b\nelement face 1\n"
      "property list int8 uint16 vertex_indices\nend_header\n";
  for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
    text += bytes(static_cast<int8_t>(x), order) + bytes(0.25, order) + bytes(uint16_t{2}, order) +
            bytes(int16_t{-1}, order) + bytes(int16_t{10}, order) + bytes(static_cast<float>(y), order);
  }
  for (int i = 0; i < 2; ++i) text += bytes(uint32_t{0x0a0a0a0a}, order) + bytes(int32_t{-1}, order);
  text += bytes(int8_t{4}, order);
  for (const uint16_t corner : {0, 1, 2, 3}) text += bytes(corner, order);
  return text;
}

TEST(MeshFile, ReadsBinaryPlyOfEitherByteOrder) {
  expect_square(load_mesh(write_file("little.ply", binary_ply(std::endian::little))));
  expect_square(load_mesh(write_file("big.PLY", binary_ply(std::endian::big))));
}

TEST(MeshFile, ReadsObj) {
  expect_square(
      load_mesh(write_file("square.obj",
                           "# a square\nmtllib none.mtl\no square\nv 0 0 .25\nv 1 0 .25 1.0\r\nv 1 1 .25 # corner\n"
                           "\tv 0 1 0.25\nvn 0 0 1\nvt 0 0\nusemtl none\nf 1/ 2// -2 4")));
}

TEST(MeshFile, SplitsObjVerticesByWhatCornersName) {
  const TriangleMesh mesh =
      load_mesh(write_file("fold.obj",
                           "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0 0.5\nvt 1 1\nvt 0 1\nvt 9 9\n"
                           "vn 0 0 2\nvn 1 0 1\nf 1/1/1 2/2/1 3/3/1\nf 1/1/1 3/3/-1 4/-2/1\n"))
          .mesh;
  EXPECT_EQ(mesh.triangles, (std::vector<glm::uvec3>{{0, 1, 2}, {0, 3, 4}}));
  EXPECT_EQ(mesh.positions, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 0}, {0, 1, 0}}));
  EXPECT_EQ(mesh.uvs, (std::vector<Vec2>{{0, 0}, {1, 0}, {1, 1}, {1, 1}, {0, 1}}));
  EXPECT_EQ(mesh.normals, (std::vector<Vec3>{{0, 0, 2}, {0, 0, 2}, {0, 0, 2}, {1, 0, 1}, {0, 0, 2}}));
}

TEST(MeshFile, ReadsObjWithOneOfTheTwo) {
  const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.5 -2\nvn 0 1 0\n";
  const TriangleMesh uvs = load_mesh(write_file("uvs.obj", corners + "f 3/1 1/1 2/1\n")).mesh;
  EXPECT_EQ(uvs.uvs, std::vector<Vec2>(3, Vec2(0.5f, -2.0f)));
  EXPECT_EQ(uvs.positions, (std::vector<Vec3>{{0, 1, 0}, {0, 0, 0}, {1, 0, 0}}));
  EXPECT_TRUE(uvs.normals.empty());
  const TriangleMesh normals = load_mesh(write_file("normals.obj", corners + "f 1//1 2//1 3//1\n")).mesh;
  EXPECT_EQ(normals.normals, std::vector<Vec3>(3, Vec3(0, 1, 0)));
  EXPECT_TRUE(normals.uvs.empty());
}

TEST(MeshFile, ReadsNormalsAndTextureCoordinatesOfPly) {
  for (const auto& [u, v] : {std::pair("u", "v"), {"s", "t"}, {"texture_u", "texture_v"}}) {
    const std::string header =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float nx\nproperty float x\n"
        "property double ny\nproperty float y\nproperty float z\nproperty float nz\n"
        "property float " +
        std::string(v) + "\nproperty float " + u +
        "\nelement face 1\nproperty list uchar int vertex_index\nend_header\n";
    const TriangleMesh mesh =
        load_mesh(write_file("full.ply", header + "1 0 2 0 0 3 .25 .5\n1 1 2 0 0 3 0 1\n1 0 2 1 0 -3 -1 7\n3 0 1 2\n"))
            .mesh;
    EXPECT_EQ(mesh.positions, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    EXPECT_EQ(mesh.normals, (std::vector<Vec3>{{1, 2, 3}, {1, 2, 3}, {1, 2, -3}}));
    EXPECT_EQ(mesh.uvs, (std::vector<Vec2>{{0.5f, 0.25f}, {1, 0}, {7, -1}}));
  }
}

TEST(MeshFile, CountsDegenerateTriangles) {
  const LoadedMesh loaded =
      load_mesh(write_file("thin.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nf 1 2 3\nf 1 2 2\nf 1 2 4\n"));
  EXPECT_EQ(loaded.mesh.triangles.size(), 1u);
  EXPECT_EQ(loaded.notes.without_area, 2u);
}

const std::string kCorners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

/// As an L-shaped room is written by every modeller.
TEST(MeshFile, PolygonsKeepTheirNotches) {
  const std::string obj = "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nf 1 2 3 4 5 6\n";
  const LoadedMesh loaded = load_mesh(write_file("room.obj", obj));
  EXPECT_EQ(loaded.mesh.triangles.size(), 4u);
  EXPECT_EQ(loaded.notes.not_plane, 0u);
  double area = 0.0;
  for (const glm::uvec3& t : loaded.mesh.triangles) {
    const auto& p = loaded.mesh.positions;
    area += 0.5 * glm::length(glm::cross(Vec3d(p[t.y] - p[t.x]), Vec3d(p[t.z] - p[t.x])));
  }
  EXPECT_DOUBLE_EQ(area, 3.0);
  const std::string bent = "v 0 0 0\nv 1 0 0\nv 1 1 1\nv 0 1 0\nf 1 2 3 4\n";
  EXPECT_EQ(load_mesh(write_file("bent.obj", bent)).notes.not_plane, 1u);
}

/// By .NET and Windows editors, old Macs, and Rhino, which wraps lines.
TEST(MeshFile, ReadsObjAsItIsWrittenElsewhere) {
  const std::string square = "v 0 0 .25\nv 1 0 .25\nv 1 1 .25\nv 0 1 .25\nf 1 2 3 4\n";
  expect_square(load_mesh(write_file("mark.obj", "\xef\xbb\xbf" + square)));
  std::string mac = square;
  std::replace(mac.begin(), mac.end(), '\n', '\r');
  expect_square(load_mesh(write_file("mac.obj", mac)));
  expect_square(load_mesh(write_file("wrapped.obj",
                                     "# C:\\models\\\nv 0 0 .25\nv 1 0\\\n .25\nv 1 1 \\\r\n.25\nv 0 1 .25\n"
                                     "f 1 2\\\n3\\\n4 # C:\\\n")));
}

/// Normals that faces with an area use, and are zero or no numbers, become those of the triangles; others do not
/// matter.
TEST(MeshFile, BadNormalsBecomeThoseOfTheirTriangles) {
  for (const char* bad : {"0 0 0", "nan 0 1", "-nan(ind) 0 0", "1.#QNAN0 -1.#IND 0", "inf 0 0"}) {
    const std::string normals = "vn 1 0 1\nvn " + std::string(bad) + "\n";
    const std::string unused = kCorners + normals + "f 1//1 2//1 3//1\nf 1//2 2//2 1//2\n";
    const LoadedMesh good = load_mesh(write_file("unused.obj", unused));
    EXPECT_EQ(good.mesh.normals, std::vector<Vec3>(3, Vec3(1, 0, 1))) << bad;
    EXPECT_EQ(good.notes.bad_normals, 0u);
    const LoadedMesh one =
        load_mesh(write_file("used.obj", kCorners + normals + "f 1//1 2//2 3//1\nf 1//1 3//1 4//2\n"));
    EXPECT_EQ(one.mesh.normals, (std::vector<Vec3>{{1, 0, 1}, {0, 0, 1}, {1, 0, 1}, {0, 0, 1}})) << bad;
    EXPECT_EQ(one.mesh.triangles, (std::vector<glm::uvec3>{{0, 1, 2}, {0, 2, 3}}));
    EXPECT_EQ(one.notes.bad_normals, 2u);
  }
}

/// Of several objects in one file some have normals or texture coordinates and others have none.
TEST(MeshFile, ReadsWhatSomeFacesHaveAndOthersLack) {
  const LoadedMesh loaded = load_mesh(write_file(
      "parts.obj", kCorners + "vt .5 .5\nvt nan 0\nvn 1 0 1\nf 1/1 2/1 3/1\nf 1//1 3//1 4//1\nf 1/1 2/2 4\n"));
  EXPECT_EQ(loaded.mesh.normals,
            (std::vector<Vec3>{
                {0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {1, 0, 1}, {1, 0, 1}, {1, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}}));
  EXPECT_EQ(loaded.notes.bad_normals, 0u);
  EXPECT_EQ(loaded.notes.without_uvs, 5u);
  EXPECT_EQ(loaded.notes.first_without_uvs, 9u);
}

/// Of Cinema 4D, which writes 0 for no normal; and of files that name what they have no list of.
TEST(MeshFile, NumbersOfNoNormalAreNone) {
  const LoadedMesh zero = load_mesh(write_file("zero.obj", kCorners + "vt 0 0\nvn 1 0 1\nf 1/1/0 2/0/1 3/1/1\n"));
  EXPECT_EQ(zero.mesh.normals, (std::vector<Vec3>{{0, 0, 1}, {1, 0, 1}, {1, 0, 1}}));
  EXPECT_EQ(zero.notes.bad_normals, 1u);
  EXPECT_EQ(zero.notes.without_uvs, 1u);
  const LoadedMesh none = load_mesh(write_file("none.obj", kCorners + "f 1/1/1 2/2/2 3/3/3\n"));
  EXPECT_TRUE(none.mesh.normals.empty() && none.mesh.uvs.empty());
  EXPECT_EQ(none.notes.bad_normals, 3u);
}

/// Edges that are written as faces, the word of versions before 3, surfaces of other kinds, numbers too small for
/// floats, and texture coordinates of lines.
TEST(MeshFile, ReadsRareObjStatements) {
  const LoadedMesh loaded = load_mesh(write_file(
      "rare.obj", "v 1e-46 -1.07797e-046 0\nv 1 0 0\nv 0 1 0\nvt 0.5\nf 1 2\nf 1\nfo 1/1 2/1 3/1\nsurf 0 1 0 1 1 2\n"));
  EXPECT_EQ(loaded.mesh.positions, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(loaded.mesh.uvs, std::vector<Vec2>(3, Vec2(0.5f, 0.0f)));
  EXPECT_EQ(loaded.notes.without_area, 2u);
  EXPECT_EQ(loaded.notes.free_form, 1u);
}

/// As MeshLab writes them, in text of Windows; vertices that no face uses may have no place.
TEST(MeshFile, ReadsTextureCoordinatesOfCornersOfPly) {
  const LoadedMesh loaded = load_mesh(write_file(
      "corners.ply",
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 2\nproperty list uchar int vertex_indices\nproperty list uchar float texcoord\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n-1.#IND 1.#INF 1.#QNAN0\n3 0 1 2 6 0 0 1 0 0 1\n3 0 1 2 6 0 0 1 0 1 1\n"));
  EXPECT_EQ(loaded.mesh.uvs, (std::vector<Vec2>{{0, 0}, {1, 0}, {0, 1}, {0, 0}, {1, 0}, {1, 1}}));
  EXPECT_EQ(loaded.mesh.triangles, (std::vector<glm::uvec3>{{0, 1, 2}, {3, 4, 5}}));
}

/// Vertices of PLY stay with their numbers; where a normal is bad, its triangle has a vertex of its own behind them.
TEST(MeshFile, VerticesOfPlyStay) {
  const LoadedMesh loaded = load_mesh(write_file(
      "values.ply",
      "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
      "property float nx\nproperty float ny\nproperty float nz\nproperty float u\nproperty float v\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "9 9 9 0 0 0 nan 0\n0 0 0 1 0 1 0 0\n1 0 0 0 0 0 1 0\n0 1 0 1 0 1 0 1\nnan 0 0 nan 0 0 0 0\n3 1 2 3\n"));
  EXPECT_EQ(loaded.mesh.triangles, (std::vector<glm::uvec3>{{1, 5, 3}}));
  EXPECT_EQ(loaded.mesh.positions[5], Vec3(1, 0, 0));
  EXPECT_EQ(loaded.mesh.normals, (std::vector<Vec3>{{0, 0, 1}, {1, 0, 1}, {0, 0, 1}, {1, 0, 1}, {0, 0, 1}, {0, 0, 1}}));
  EXPECT_EQ(loaded.mesh.uvs, (std::vector<Vec2>{{0, 0}, {0, 0}, {1, 0}, {0, 1}, {0, 0}, {1, 0}}));
  EXPECT_EQ(loaded.notes.bad_normals, 1u);
}

/// As organised clouds of points have them where nothing was seen.
TEST(MeshFile, PositionsThatNoFaceNamesDoNotMatter) {
  EXPECT_EQ(load_mesh(write_file("cloud.obj", "v nan nan nan\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 2 3 4\n")).mesh.triangles,
            (std::vector<glm::uvec3>{{1, 2, 3}}));
}

/// As of the scans of the Stanford repository: strips, whose triangles turn by turns, and -1 between them.
TEST(MeshFile, ReadsStripsOfTrianglesOfPly) {
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
      "element tristrips 1\nproperty list int int vertex_indices\nend_header\n";
  const std::string body = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n10 0 1 2 3 4 -1 0 1 3 -1\n";
  const std::vector<glm::uvec3> expected{{0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {0, 1, 3}};
  EXPECT_EQ(load_mesh(write_file("strips.ply", header + body)).mesh.triangles, expected);
  std::string mac = header + body;
  std::replace(mac.begin(), mac.end(), '\n', '\r');
  EXPECT_EQ(load_mesh(write_file("mac.ply", mac)).mesh.triangles, expected);
}

/// A header with the line ends of old Macs, before bytes that look like others.
TEST(MeshFile, BinaryPlyBeginsRightBehindItsHeader) {
  std::string header =
      "ply\nformat binary_little_endian 1.0\nelement odd 1\nproperty uchar a\nelement vertex 3\nproperty float x\n"
      "property float y\nproperty float z\nelement face 1\nproperty list uchar uchar vertex_indices\nend_header\n";
  std::replace(header.begin(), header.end(), '\n', '\r');
  std::string body = "\n";
  for (const float value : {0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f})
    body += bytes(value, std::endian::little);
  body += std::string("\3\0\1\2", 4);
  EXPECT_EQ(load_mesh(write_file("mac_binary.ply", header + body)).mesh.triangles,
            (std::vector<glm::uvec3>{{0, 1, 2}}));
}

TEST(MeshFile, RefusesOtherFiles) {
  EXPECT_NE(message_of([] { load_mesh("mesh.stl"); }).find("mesh.stl: a mesh must be a .ply or .obj file"),
            std::string::npos);
  EXPECT_NE(message_of([] { load_mesh("no_such.ply"); }).find("no_such.ply: cannot open"), std::string::npos);
}

TEST_F(BadInput, MeshesAreRefused) {
  for (const char* kind : {".ply", ".obj"})
    for (const Row& row : rows(kind)) {
      SCOPED_TRACE(row.path);
      expect_message(row, message_of([&] { load_mesh(row.path); }));
    }
}

/// A file cut anywhere is refused, or read up to whole faces; it never crashes.
TEST(MeshFile, SurvivesTruncation) {
  for (const std::endian order : {std::endian::little, std::endian::big}) {
    const std::string whole = binary_ply(order);
    for (size_t size = 0; size < whole.size(); size += 5) {
      const std::string path = write_file("cut.ply", whole.substr(0, size));
      EXPECT_NE(message_of([&] { load_mesh(path); }), "") << size;
    }
  }
}

}  // namespace
}  // namespace vpm
