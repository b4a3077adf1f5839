// Scene files: media, on both sides of shapes and in grids.
#include "vpm/input/scene_file.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "input/expectations.h"
#include "input/scene_text.h"

namespace vpm {
namespace {

TEST(SceneFile, ReadsCoefficients) {
  const RenderJob loaded = load_with(
      "[media.a]\ntype = 'homogeneous'\nsigma_s = [1, 2, 3]\nsigma_a = 0.5\nphase = { type = 'henyey-greenstein', g = "
      "-0.3 }\n"
      "[media.b]\ntype = 'homogeneous'\nsigma_t = 4\nalbedo = [0.25, 0.5, 1]\nphase = { type = 'rayleigh' }\n"
      "[media.c]\ntype = 'homogeneous'\nmeasured = 'wholemilk'\nscale = 0.1\n");
  const std::vector<Medium>& media = loaded.scene.media;
  ASSERT_EQ(media.size(), 3u);
  EXPECT_EQ(media[0].sigma_s, Rgb(1, 2, 3));
  EXPECT_EQ(media[0].sigma_t, Rgb(1.5, 2.5, 3.5));
  EXPECT_EQ(std::get<HenyeyGreenstein>(media[0].phase).g, -0.3f);
  EXPECT_EQ(media[1].sigma_t, Rgb(4));
  EXPECT_EQ(media[1].sigma_s, Rgb(1, 2, 4));
  EXPECT_TRUE(std::holds_alternative<Rayleigh>(media[1].phase));
  EXPECT_LT(relative_difference(media[2].sigma_s, Rgb(255, 321, 377)), 1e-6f);  // 2.55 1/mm = 2550 1/m
  EXPECT_LT(relative_difference(media[2].sigma_t - media[2].sigma_s, Rgb(0.11, 0.24, 1.4)), 1e-4f);
}

TEST(SceneFile, ReadsMediaOnBothSides) {
  const std::string media =
      "[media.fog]\ntype = 'homogeneous'\nsigma_s = 1\nsigma_a = 0\n[media.oil]\ntype = 'homogeneous'\nsigma_s = "
      "0\nsigma_a = 1\n";
  const std::string shapes =
      "[[shapes]]\nname = 'room'\ntype = 'box'\nmaterial = 'grey'\nmin = [-9, -9, -9]\nmax = [9, 9, 9]\ninside = "
      "'fog'\n"
      "[[shapes]]\nname = 'drop'\ntype = 'sphere'\nmaterial = { type = 'dielectric', ior = 1.4 }\ncenter = [0, 0, "
      "0]\nradius = 1\n"
      "inside = 'oil'\noutside = 'fog'\n"
      "[[shapes]]\nname = 'stone'\ntype = 'sphere'\nmaterial = 'grey'\ncenter = [4, 0, 0]\nradius = 1\n";
  const Scene scene = load_with(kGrey + media + shapes).scene;
  EXPECT_EQ(scene.shapes[0].media.inside, 0);
  EXPECT_EQ(scene.shapes[0].media.outside, kVacuum);
  EXPECT_EQ(scene.shapes[1].media.inside, 1);
  EXPECT_EQ(scene.shapes[1].media.outside, 0);
  EXPECT_FALSE(scene.shapes[2].separates_media);
  EXPECT_EQ(scene.camera_medium, 0);
  EXPECT_EQ(scene.light_medium[0], 0);
  EXPECT_EQ(load_with(kGrey + media + shapes, {"camera.medium=vacuum"}).scene.camera_medium, kVacuum);
  EXPECT_EQ(load_with(kGrey + media + shapes, {"camera.target=[0, 0.5, 0.1]", "camera.position=[0, 0, 0]"})
                .scene.camera_medium,
            1);
  EXPECT_EQ(load_with(media, {"world.medium=oil"}).scene.camera_medium, 1);
}

/// The path of a shared grid; "" where it is not there.
std::string shared_grid(const std::string& name) {
  const std::string path = std::string(VPM_SHARED_DIR) + "/vdb/" + name;
  return std::filesystem::exists(path) ? path : "";
}

TEST(SceneFile, PutsABoxAroundAGrid) {
  const std::string path = shared_grid("usd_smoke3.vdb");
  if (path.empty()) GTEST_SKIP() << "the shared grids are not there";
  const std::string text = kCamera + kLight + "[media.smoke]\ntype = 'grid'\npath = '" + path +
                           "'\nsigma_t = 2\nalbedo = 0.5\ndensity_scale = 3\n";
  for (const char* steps : {"[]", "[{ scale = [1, 1, -2] }]"}) {
    SCOPED_TRACE(steps);
    const Scene scene = load_scene(write_scene(text + "transform = " + steps + "\n")).scene;
    ASSERT_EQ(scene.shapes.size(), 1u);
    EXPECT_EQ(scene.shapes[0].name, "box of smoke");
    EXPECT_TRUE(is_boundary(scene.materials[scene.shapes[0].material]));
    EXPECT_EQ(scene.media[0].sigma_t, Rgb(6));
    EXPECT_EQ(scene.media[0].sigma_s, Rgb(3));
    const Box bounds = scene.geometry.bounds(), support = scene.media[0].grid->bounds();
    EXPECT_LT(glm::length(bounds.lo - support.lo) + glm::length(bounds.hi - support.hi), 1e-4f);
    EXPECT_EQ(normal_below(scene, 0.0f, bounds.center().z), Vec3(0, 1, 0));
    EXPECT_EQ(medium_at(scene, bounds.center()), 0);
    EXPECT_EQ(medium_at(scene, bounds.hi + 1.0f), kVacuum);
  }
}

TEST(SceneFile, ShapesBoundAGrid) {
  const std::string path = shared_grid("edge/background_one_box.vdb");
  if (path.empty()) GTEST_SKIP() << "the shared grids are not there";
  const std::string medium = "[media.smoke]\ntype = 'grid'\npath = '" + path + "'\nalbedo = 0.5\n";
  const std::string ball =
      "[[shapes]]\nname = 'ball'\ntype = 'sphere'\nmaterial = { type = 'boundary' }\ncenter = [0, 0, 0]\nradius = 1\n";
  EXPECT_NE(message_of([&] { load_with(medium); }).find("scene.toml:10:8: "),
            std::string::npos);  // its background is not 0
  EXPECT_EQ(load_with(medium + ball + "inside = 'smoke'\n").scene.shapes.size(), 1u);
  const std::string shell =
      "[[shapes]]\nname = 'shell'\ntype = 'sphere'\nmaterial = { type = 'boundary' }\ncenter = [0, 0, 0]\nradius = 3\n";
  EXPECT_EQ(load_with(medium + ball + "outside = 'smoke'\n" + shell + "inside = 'smoke'\n").scene.shapes.size(), 2u);
  EXPECT_NE(message_of([&] {
              load_with(medium + ball + "outside = 'smoke'\n", {"media.smoke.boundary=shapes"});
            }).find("say that vacuum is there"),
            std::string::npos);
  EXPECT_NO_THROW(load_with(medium, {"world.medium=smoke"}));
  const std::string empty_outside = shared_grid("usd_smoke3.vdb");
  EXPECT_NE(message_of([&] {
              load_with(medium, {"world.medium=smoke", "media.smoke.path=" + empty_outside});
            }).find("has background 0"),
            std::string::npos);
  EXPECT_EQ(load_with(medium + ball + "outside = 'smoke'\n",
                      {"media.smoke.boundary=box", "media.smoke.path=" + empty_outside})
                .scene.shapes.size(),
            2u);
}

/// A box between planes across the x axis, `more` of keys beside.
std::string box_between(const std::string& name, double from, double to, const std::string& more) {
  return fmt::format("[[shapes]]\nname = '{}'\ntype = 'box'\nmin = [{}, -1, -1]\nmax = [{}, 1, 1]\n{}\n", name, from,
                     to, more);
}

bool has_common_face(const std::string& text) {
  return message_of([&] { load_with(text); }).find("has a face in common with") != std::string::npos;
}

const std::string kOil = "[media.oil]\ntype = 'homogeneous'\nsigma_s = 0\nsigma_a = 1\n";
const std::string kGlass = "material = { type = 'dielectric', ior = 1.5 }";
const std::string kWater = "material = { type = 'dielectric', ior = 1.33 }";
const std::string kFrosted = "material = { type = 'rough-dielectric', ior = 1.5, roughness = 0.1 }";
const std::string kPane = "material = { type = 'thin-dielectric', ior = 1.5 }";
const std::string kBorder = "material = { type = 'boundary' }";
const std::string kWall = "material = { type = 'lambertian', reflectance = 0.5 }";
const std::string kFilled = "\ninside = 'oil'";

TEST(SceneFile, RefusesDielectricsFlushAgainstEachOther) {
  for (const std::string& other : {kWater, kFrosted, kPane, kWater + kFilled, kBorder + kFilled}) {
    SCOPED_TRACE(other);
    const auto beside_glass = [&](double from) {
      return has_common_face(kOil + box_between("glass", -1, 0.3, kGlass) + box_between("other", from, 2, other));
    };
    EXPECT_TRUE(beside_glass(0.3));
    EXPECT_TRUE(beside_glass(0.3 + 3e-8));  // the next float
    EXPECT_FALSE(beside_glass(0.299));
    EXPECT_FALSE(beside_glass(0.301));
    EXPECT_NO_THROW(load_with(kOil + box_between("glass", -1, 0.3, kGlass) + box_between("other", 0.301, 2, other)));
  }
}

TEST(SceneFile, AcceptsOtherFacesThatCoincide) {
  const auto why_refused = [](const std::string& a, const std::string& b) {
    return message_of([&] { load_with(kOil + box_between("a", -1, 0.3, a) + box_between("b", 0.3, 2, b)); });
  };
  EXPECT_EQ(why_refused(kWall, kWater), "");
  EXPECT_EQ(why_refused(kWall, kWater + kFilled), "");
  EXPECT_EQ(why_refused(kPane, kWall), "");
  EXPECT_EQ(why_refused(kWall, kWall), "");
  EXPECT_EQ(why_refused(kBorder + kFilled, kBorder + kFilled), "");
  EXPECT_EQ(why_refused(kWall, kBorder + kFilled), "");
  EXPECT_EQ(why_refused(kGlass + kFilled, kBorder + kFilled), "");
}

TEST(SceneFile, RefusesOneBallOfGlassInItsOwnPlace) {
  const auto ball = [](double x, double radius) {
    return fmt::format("[[shapes]]\ntype = 'sphere'\ncenter = [{}, 0, 0]\nradius = {}\n{}\n", x, radius, kGlass);
  };
  EXPECT_TRUE(has_common_face(ball(0, 1) + ball(0, 1)));
  EXPECT_FALSE(has_common_face(ball(0, 1) + ball(0, 0.999)));
  EXPECT_FALSE(has_common_face(ball(0, 1) + ball(2, 1)));      // touches outside
  EXPECT_FALSE(has_common_face(ball(0, 1) + ball(0.5, 0.5)));  // touches inside
  EXPECT_FALSE(has_common_face(ball(0, 1) + box_between("block", 1, 2, kGlass)));
}

TEST(SceneFile, FindsACommonFaceOfASmallPartOfTheSurface) {
  // A knob of a hundredth of the block's side: rays through the knob find it.
  const std::string knob = "[[shapes]]\ntype = 'box'\nmin = [0.3, 0.1, 0.1]\nmax = [0.5, 0.3, 0.3]\n" + kWater + "\n";
  EXPECT_TRUE(has_common_face(box_between("block", -1, 0.3, kGlass) + knob));
}

TEST(SceneFile, NotesMediaThatPositionsDoNotResolve) {
  const auto notes = [](const std::string& sigma, const std::string& albedo) {
    return load_with("[media.fog]\ntype = 'homogeneous'\nsigma_t = " + sigma + "\nalbedo = " + albedo +
                     "\n[[shapes]]\ntype = 'sphere'\nmaterial = { type = 'boundary' }\ninside = 'fog'\ncenter = [0, "
                     "0, 0]\nradius = 1\n")
        .notes;
  };
  EXPECT_TRUE(notes("1e5", "0.5").empty());
  EXPECT_TRUE(notes("1e9", "0").empty());  // black: nothing would come out anyhow
  ASSERT_EQ(notes("1e9", "0.5").size(), 1u);
  EXPECT_NE(notes("1e9", "0.5")[0].find("medium 'fog': its free paths, down to 1e-09 m"), std::string::npos);
}

TEST(SceneFile, NotesAPlaceThatPositionsDoNotResolve) {
  const auto notes = [](const std::string& x) {
    return load_with("[[shapes]]\ntype = 'sphere'\nmaterial = { type = 'lambertian', reflectance = 0.5 }\ncenter = [" +
                     x + ", 0, 0]\nradius = 1\n")
        .notes;
  };
  EXPECT_TRUE(notes("1e3").empty());
  ASSERT_EQ(notes("1e6").size(), 1u);
  EXPECT_NE(notes("1e6")[0].find("1e+06 m from the origin, where positions are 0.062 m apart"), std::string::npos);
}

}  // namespace
}  // namespace vpm
