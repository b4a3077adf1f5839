// Files of other programs, after public bug reports, from the mesh or picture to what vpm says of it.
#include <gtest/gtest.h>

#include <filesystem>

#include "tools/vpm_binary.h"
#include "vpm/image/exr.h"
#include "vpm/image/metrics.h"

namespace vpm {
namespace {

class VpmBrought : public VpmBinary {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(kFolder)) GTEST_SKIP() << "no " << kFolder;
  }

  static std::string file(const std::string& name) { return kFolder + name; }

  /// The picture of a scene with that mesh in the place of its own; `said`: what must be said, where it is not "".
  Image render(const std::string& folder, const std::string& scene, const std::string& shape, const std::string& mesh,
               const std::string& said = "") const {
    std::filesystem::remove(path(scene));                                // of another call
    vpm_succeeds({"upgrade", file(folder + "/" + scene), "-o", scene});  // it has keys of its time
    const ProcessResult result = vpm_succeeds(
        {"render", scene, "-o", "picture.exr", "--set", "shapes." + shape + ".path=" + file(folder + "/" + mesh)});
    EXPECT_NE(result.err.find(said), std::string::npos) << mesh << ": " << result.err;
    EXPECT_TRUE(!said.empty() || result.err.empty()) << mesh << ": " << result.err;
    return read_exr(path("picture.exr"));
  }

  /// The MSE of a picture against `reference`, both of the folder.
  double mse(const std::string& folder, const std::string& picture, const std::string& reference) const {
    const std::vector<std::string> arguments{"error", file(folder + "/" + picture), file(folder + "/" + reference),
                                             "--json"};
    return nlohmann::json::parse(vpm_succeeds(arguments).out).at("mse").at("value");
  }

  inline static const std::string kFolder = std::string(VPM_SHARED_DIR) + "/bugs/";
};

double squared_difference(const Image& a, const Image& b) {
  double sum = 0.0;
  for (size_t i = 0; i < a.pixels.size(); ++i) {
    const Vec3d difference = Vec3d(a.pixels[i]) - Vec3d(b.pixels[i]);
    sum += glm::dot(difference, difference);
  }
  return sum;
}

TEST_F(VpmBrought, PolygonsKeepTheirNotches) {
  const auto room = [&](const char* scene, const char* mesh) {
    return render("01-concave-polygon", scene, "room", mesh);
  };
  const Image by_hand = room("opaque.toml", "room_triangles.obj");
  for (const char* mesh : {"room.obj", "room.ply"}) {
    EXPECT_LT(squared_difference(room("opaque.toml", mesh), by_hand), 1e-9) << mesh;
    EXPECT_EQ(room("fog.toml", mesh).at(0, 0), Rgb(1.0f)) << mesh;
  }
}

TEST_F(VpmBrought, AMarkBeforeTextIsNoLine) {
  const auto cube = [&](const char* mesh) { return render("02-obj-byte-order-mark", "scene.toml", "cube", mesh); };
  const Image plain = cube("cube.obj");
  for (const char* mesh : {"cube_bom.obj", "cube_negative_bom.obj", "cube_spare_bom.obj"})
    EXPECT_EQ(squared_difference(cube(mesh), plain), 0.0) << mesh;
}

TEST_F(VpmBrought, ThePictureIsThePartThatHoldsColour) {
  for (const char* picture : {"colour_then_depth.exr", "depth_then_colour.exr"})
    EXPECT_EQ(mse("03-exr-depth-part-first", picture, "colour.exr"), 0.0) << picture;
  for (const char* picture : {"depth_alone.exr", "normals.exr"})
    vpm_refuses(
        {"error", file(std::string("03-exr-depth-part-first/") + picture), file("03-exr-depth-part-first/colour.exr")},
        {picture, "it holds no picture", "asked for by name"});
}

TEST_F(VpmBrought, BadNormalsHarmNoMeshThatDoesNotUseThem) {
  const auto cube = [&](const char* mesh, const std::string& said = "") {
    return render("05-obj-bad-unused-normals", "scene.toml", "cube", mesh, said);
  };
  const Image good = cube("good.obj");
  EXPECT_EQ(squared_difference(cube("zero_unused.obj"), good), 0.0);
  EXPECT_EQ(squared_difference(cube("nan_unused.obj"), good), 0.0);
  EXPECT_EQ(squared_difference(cube("zero_on_dropped_triangle.obj", "without area dropped"), good), 0.0);
  EXPECT_EQ(squared_difference(cube("zero_at_one_corner.obj", "note: "), good), 0.0);
}

TEST_F(VpmBrought, TheOnlyLayerOfColourIsThePicture) {
  for (const char* picture : {"blender_multilayer.exr", "dot_rgb.exr", "rgba_layer.exr", "lower_case.exr"})
    EXPECT_LT(mse("07-exr-named-layers", picture, "plain.exr"), 1e-6) << picture;
}

TEST_F(VpmBrought, ABankOfTilesIsRead) {
  const std::string told = vpm_succeeds({"info", file("08-tile-fog-bank/bank_4096x256x4096.vdb")}).out;
  EXPECT_NE(told.find("active voxels 4294967296"), std::string::npos) << told;
  vpm_succeeds({"view", file("08-tile-fog-bank/bank_4096x256x4096.vdb"), "-o", "bank.exr", "--passes", "1", "--size",
                "8x8", "--set", "integrator.photons.emitted=1000"});
  for (const char* grid : {"bank_8192x256x8192.vdb", "root_tile_4096.vdb"})
    vpm_refuses({"view", file(std::string("08-tile-fog-bank/") + grid), "-o", "bank.exr"}, {"the limit is 0.25 GiB"});
}

TEST_F(VpmBrought, WholeNumbersAreDensities) {
  const auto view = [&](const std::string& kind) {
    vpm_succeeds({"view", file("09-integer-grid/" + kind + "_density.vdb"), "-o", "grid.exr", "--passes", "1", "--size",
                  "8x8", "--set", "integrator.photons.emitted=1000"});
    return read_exr(path("grid.exr"));
  };
  const auto told = [&](const std::string& kind) {
    return vpm_succeeds({"info", file("09-integer-grid/" + kind + "_density.vdb")}).out;
  };
  for (const auto& [kind, values] : {std::pair{"int32", "active values 1 to 235, mean 64.2704"},
                                     {"bool", "active values 1 to 1, mean 1\n"},
                                     {"mask", "active values 1 to 1, mean 1\n"}}) {
    EXPECT_NE(told(kind).find(values), std::string::npos) << told(kind);
  }
  const Image of_bool = view("bool");
  for (const char* kind : {"int32", "mask"}) EXPECT_GT(squared_difference(view(kind), of_bool), 0.0) << kind;
  vpm_refuses({"view", file("09-integer-grid/vec3_density.vdb"), "-o", "grid.exr"}, {"vec3s"});
}

TEST_F(VpmBrought, WrappedLinesAreOneLine) {
  const auto cube = [&](const char* mesh) { return render("12-obj-wrapped-lines", "scene.toml", "cube", mesh); };
  const Image plain = cube("cube.obj");
  for (const char* mesh : {"cube_wrapped.obj", "cube_wrapped_v.obj"})
    EXPECT_EQ(squared_difference(cube(mesh), plain), 0.0) << mesh;
}

}  // namespace
}  // namespace vpm
