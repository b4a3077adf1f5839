// Scene files: materials, textures, shapes where their transforms put them, and lights.
#include "vpm/input/scene_file.h"

#include <gtest/gtest.h>

#include <fstream>

#include "input/expectations.h"
#include "input/scene_text.h"
#include "support/test_file.h"
#include "vpm/image/exr.h"

namespace vpm {
namespace {

TEST(SceneFile, ReadsEveryMaterial) {
  const RenderJob loaded = load_with(R"(
[materials]
wall = { type = "lambertian", reflectance = 0.5 }
wax = { type = "phong", diffuse = 0.7, glossy = [0.3, 0.2, 0.1], exponent = 30 }
glass = { type = "dielectric", ior = 1.5 }
frosted = { type = "rough-dielectric", ior = 1.5, roughness = 0.3 }
ring = { type = "conductor", metal = "gold" }
pan = { type = "rough-conductor", eta = 1.5, k = [3, 4, 5], roughness = 1 }
window = { type = "thin-dielectric", ior = 1.4 }

[[shapes]]
type = "sphere"
center = [0, 0, 0]
radius = 1
material = "frosted"
)");
  const std::vector<Material>& m = loaded.scene.materials;
  ASSERT_EQ(m.size(), 7u);
  EXPECT_EQ(std::get<ThinDielectric>(m[6]).ior, 1.4f);
  EXPECT_EQ(std::get<Phong>(m[1]).glossy, Rgb(0.3f, 0.2f, 0.1f));
  EXPECT_EQ(std::get<Phong>(m[1]).exponent, 30.0f);
  EXPECT_EQ(std::get<RoughDielectric>(m[3]).ior, 1.5f);
  EXPECT_EQ(std::get<RoughDielectric>(m[3]).roughness, 0.3f);
  EXPECT_EQ(std::get<Conductor>(m[4]).eta, Rgb(0.156f, 0.424f, 1.38f));
  EXPECT_EQ(std::get<RoughConductor>(m[5]).k, Rgb(3.0f, 4.0f, 5.0f));
  EXPECT_EQ(std::get<RoughConductor>(m[5]).roughness, 1.0f);
}

TEST(SceneFile, CountsTrianglesThatTheTransformFlattens) {
  std::ofstream(test_file("two.obj")) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 900 0 0\nv 0 900 0\nf 1 2 3\nf 1 4 5\n";
  const RenderJob loaded = load_with(
      "[[shapes]]\ntype = 'mesh'\nmaterial = { type = 'mirror' }\npath = 'two.obj'\nemission = 1\n"
      "transform = [{ translate = [1e8, 1e8, 0] }]\n");  // where floats are 8 m apart
  ASSERT_EQ(loaded.notes.size(), 2u);                    // the other one tells of the place
  EXPECT_EQ(loaded.notes[0], "shape 'shape 0': 1 triangles without area dropped");
  EXPECT_EQ(loaded.scene.geometry.triangle_count(0), 1u);
}

TEST(SceneFile, ReadsLights) {
  const std::string text =
      kCamera + kGrey +
      "[[lights]]\ntype = 'point'\nposition = [1, 2, 3]\npower = [4, 5, 6]\n"
      "[[lights]]\ntype = 'spot'\nposition = [0, 2, 0]\ntarget = [0, 0, 0]\ninner_angle = 10\nouter_angle = 40\npower "
      "= 7\n"
      "[[lights]]\ntype = 'beam'\nposition = [0, 2, 0]\ndirection = [0, 0, -8]\nradius = 0.5\npower = 8\n"
      "[[lights]]\ntype = 'directional'\ndirection = [3, 0, 4]\nirradiance = 9\n"
      "[[lights]]\ntype = 'environment'\nradiance = 10\n"
      "[[shapes]]\ntype = 'quad'\nmaterial = 'grey'\ncorner = [0, 0, 0]\nedge_u = [2, 0, 0]\nedge_v = [0, 0, "
      "3]\nemission = 11\n"
      "[[shapes]]\ntype = 'sphere'\nmaterial = 'grey'\ncenter = [0, 5, 0]\nradius = 2\nemission = 12\n"
      "[[shapes]]\nname = 'plate'\ntype = 'disc'\nmaterial = 'grey'\ncenter = [0, 9, 0]\nnormal = [0, -5, 0]\n"
      "radius = 0.5\nemission = 13\n"
      "[[shapes]]\ntype = 'box'\nmaterial = 'grey'\nmin = [0, 12, 0]\nmax = [1, 13, 1]\nemission = 14\n"
      "transform = [{ scale = [-1, 1, 2] }]\n";
  const RenderJob loaded = load_scene(write_scene(text));
  const Scene& scene = loaded.scene;
  ASSERT_EQ(scene.lights.size(), 9u);
  EXPECT_EQ(loaded.light_names,
            (std::vector<std::string>{"", "", "", "", "", "shape 0", "shape 1", "plate", "shape 3"}));
  const auto power = [&](size_t i) { return light_power(scene.lights[i], scene.bounds); };
  EXPECT_LT(relative_difference(power(0), Rgb(4, 5, 6)), 1e-6f);
  EXPECT_LT(relative_difference(power(1), Rgb(7)), 1e-6f);
  EXPECT_EQ(std::get<SpotLight>(scene.lights[1]).direction, Vec3(0, -1, 0));
  EXPECT_EQ(power(2), Rgb(8));
  EXPECT_EQ(std::get<BeamLight>(scene.lights[2]).direction, Vec3(0, 0, -1));
  EXPECT_EQ(std::get<DirectionalLight>(scene.lights[3]).direction, Vec3(0.6f, 0, 0.8f));
  EXPECT_EQ(std::get<DirectionalLight>(scene.lights[3]).irradiance, Rgb(9));
  EXPECT_EQ(std::get<ConstantEnvironment>(scene.lights[4]).radiance, Rgb(10));
  EXPECT_LT(relative_difference(power(5), Rgb(kPi * 6 * 11)), 1e-6f);
  EXPECT_LT(relative_difference(power(6), Rgb(kPi * 4 * kPi * 4 * 12)), 1e-6f);
  EXPECT_LT(relative_difference(power(7), Rgb(kPi * kPi * 0.25f * 13)), 1e-6f);
  EXPECT_EQ(std::get<DiscLight>(scene.lights[7]).normal, Vec3(0, -1, 0));
  EXPECT_LT(relative_difference(power(8), Rgb(kPi * 10 * 14)), 1e-6f);
  Rng rng(1, 0, 0);
  for (int i = 0; i < 100; ++i) {  // mirrored, and still outwards: below, nothing but the lower side is seen
    const auto in = sample_towards(scene.lights[8], {-0.5f, 10, 1}, rng);
    ASSERT_LT(in ? in->distance * in->direction.y : 0.0f, 2.00001f);
  }
  EXPECT_EQ(scene.shapes[2].light, 7);
  EXPECT_EQ(scene.shapes[3].light, 8);
  EXPECT_EQ(scene.shapes[0].light, 5);
  EXPECT_EQ(scene.shapes[1].light, 6);
}

TEST(SceneFile, RefusesPicturesThatNoSkyShows) {
  const auto message = [](const Rgb& first, const Rgb& last) {
    Image image(3, 2);
    image.pixels.front() = first;
    image.pixels.back() = last;
    write_exr(test_file("sky.exr"), image, {}, {});
    return message_of([] { load_with("[[lights]]\ntype = 'environment'\npath = 'sky.exr'\nscale = 10\n"); });
  };
  const auto expect = [](const std::string& found, const std::string& words) {
    EXPECT_NE(found.find("scene.toml:10:8: "), std::string::npos) << found;
    EXPECT_NE(found.find(words), std::string::npos) << found;
  };
  const Rgb one(1.0f);
  expect(message(one, Rgb(1.0f, -1.0f, 1.0f)), "the radiance at column 2, row 1 is negative or not finite");
  expect(message(Rgb(1.0f, 1.0f, 1e38f), one), "the radiance at column 0, row 0 is negative or not finite");
  expect(message(Rgb(0.0f), Rgb(0.0f)), "the whole environment is black");
}

TEST(SceneFile, TransformsInTheOrderOfTheList) {
  const std::string box = kGrey + "[[shapes]]\ntype = 'box'\nmaterial = 'grey'\nmin = [0, 0, 0]\nmax = [1, 2, 3]\n";
  const auto bounds = [&](const std::string& steps) {
    return load_with(box + "transform = " + steps + "\n").scene.geometry.bounds();
  };
  EXPECT_EQ(bounds("[{ scale = 2 }, { translate = [1, 0, 0] }]").hi, Vec3(3, 4, 6));
  EXPECT_EQ(bounds("[{ translate = [1, 0, 0] }, { scale = [2, 1, 1] }]").hi, Vec3(4, 2, 3));
  const Box turned = bounds("[{ rotate = { axis = [0, 0, 2], degrees = 90 } }]");  // x to y, y to -x
  EXPECT_LT(glm::length(turned.lo - Vec3(-2, 0, 0)), 1e-6f);
  EXPECT_LT(glm::length(turned.hi - Vec3(0, 1, 3)), 1e-6f);
  EXPECT_EQ(bounds("[{ matrix = [0,1,0,10, 1,0,0,20, 0,0,1,30, 0,0,0,1] }]").hi, Vec3(12, 21, 33));
}

TEST(SceneFile, KeepsNormalsOutwardUnderMirrors) {
  for (const char* steps : {"[]", "[{ scale = [-1, 1, 1] }, { translate = [1, 0, 0] }]", "[{ scale = [1, -1, 1] }]",
                            "[{ scale = -1 }, { translate = [1, 0, 1] }]"}) {
    const std::string box =
        "[[shapes]]\ntype = 'box'\nmaterial = 'grey'\nmin = [0, 0, 0]\nmax = [1, 1, 1]\ntransform = " +
        std::string(steps) + "\n";
    EXPECT_EQ(normal_below(load_with(kGrey + box).scene, 0.3f, 0.6f), Vec3(0, 1, 0)) << steps;
  }
  const std::string lamp =
      "[[shapes]]\ntype = 'quad'\nmaterial = 'grey'\ncorner = [0, 1, 0]\nedge_u = [1, 0, 0]\nedge_v = [0, 0, "
      "1]\nemission = 1\n";
  const Scene scene =
      load_with(kGrey + lamp + "transform = [{ scale = [-1, 1, 1] }, { translate = [1, 0, 0] }]\n").scene;
  EXPECT_EQ(normal_below(scene, 0.3f, 0.6f), Vec3(0, -1, 0));
  const auto& quad = std::get<QuadLight>(scene.lights[1]);
  EXPECT_EQ(glm::cross(quad.edge_u, quad.edge_v), Vec3(0, -1, 0));
}

TEST(SceneFile, ReadsTextures) {
  const std::string folder = std::string(VPM_SOURCE_DIR) + "/tests/input/textures/";
  const auto wall = [&](const std::string& reflectance) {
    return "[materials.plain]\ntype = \"mirror\"\n[materials.wall]\ntype = \"lambertian\"\nreflectance = " +
           reflectance + "\n[[shapes]]\ntype = \"quad\"\nmaterial = \"wall\"\ncorner = [0, 0, 0]\n" +
           "edge_u = [2, 0, 0]\nedge_v = [0, 2, 0]\n";
  };
  const auto at = [](const Scene& scene, float x, float y) {
    return std::get<Lambertian>(material_at(scene, *scene.geometry.intersect({Vec3(x, y, 1), Vec3(0, 0, -1)})))
        .reflectance;
  };
  const RenderJob checker = load_with(wall("{ texture = \"" + folder + "checker.png\", filter = \"nearest\" }"));
  EXPECT_EQ(at(checker.scene, 0.5f, 0.5f), Rgb(1.0f));  // the lower left quarter
  EXPECT_EQ(at(checker.scene, 1.5f, 0.5f), Rgb(0.0f));
  EXPECT_EQ(at(checker.scene, 0.5f, 1.5f), Rgb(0.0f));
  EXPECT_EQ(checker.scene.textures[0], nullptr);
  EXPECT_EQ(std::get<Lambertian>(checker.scene.materials[1]).reflectance, Rgb(0.5f));
  EXPECT_TRUE(checker.scene.grey);
  const RenderJob smooth = load_with(wall("{ texture = \"" + folder + "checker.png\" }"));
  EXPECT_NEAR(at(smooth.scene, 1.0f, 0.5f).r, 0.5f, 1e-6f);
  const RenderJob colours = load_with(wall("{ texture = \"" + folder + "colours.png\", filter = \"nearest\" }"));
  EXPECT_LT(glm::distance(at(colours.scene, 0.5f, 1.0f), Rgb(0.50289f, 0.0f, 1.0f)), 1e-4f);
  EXPECT_FALSE(colours.scene.grey);
  const RenderJob raw =
      load_with(wall("{ texture = \"" + folder + "colours.png\", filter = \"nearest\", raw = true }"));
  EXPECT_LT(glm::distance(at(raw.scene, 1.5f, 1.0f), Rgb(0.2f, 0.4f, 128.0f / 255.0f)), 1e-6f);
}

TEST(SceneFile, TurnsNormalsWithTheirMesh) {
  const std::string path = test_file("slope.obj");
  std::ofstream(path) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 3 0 4\nf 1//1 2//1 3//1\n";
  const auto normal = [&](const std::string& transform, const Vec3& at) {
    const RenderJob loaded = load_with(kGrey + "[[shapes]]\ntype = \"mesh\"\nmaterial = \"grey\"\npath = \"" + path +
                                       "\"\ntransform = [" + transform + "]\n");
    return loaded.scene.geometry.intersect({at + Vec3(0, 0, 5), Vec3(0, 0, -1)})->shading_normal;
  };
  EXPECT_LT(glm::distance(normal("", Vec3(0.2f)), Vec3(0.6f, 0, 0.8f)), 1e-6f);
  EXPECT_LT(glm::distance(normal("{ scale = [2, 1, 1] }", Vec3(0.2f)), glm::normalize(Vec3(0.3f, 0, 0.8f))), 1e-6f);
  EXPECT_LT(glm::distance(normal("{ scale = [-1, 1, 1] }", Vec3(-0.2f, 0.2f, 0)), Vec3(-0.6f, 0, 0.8f)), 1e-6f);
  EXPECT_LT(glm::distance(normal("{ rotate = { axis = [0, 0, 1], degrees = 90 } }", Vec3(-0.2f, 0.2f, 0)),
                          Vec3(0, 0.6f, 0.8f)),
            1e-6f);
}

}  // namespace
}  // namespace vpm
