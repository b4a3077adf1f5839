// Scene files: every key arrives where it belongs, and every mistake is refused with its place and what would be right.
#include "input/scene_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "image/exr.h"
#include "input/expectations.h"
#include "support/test_file.h"

namespace vpm {
namespace {

const std::string kCamera = "[camera]\nposition = [0, 0, 3]\ntarget = [0, 0, 0]\n";
const std::string kLight = "[[lights]]\ntype = \"point\"\nposition = [0, 2, 0]\npower = 1\n";
const std::string kGrey = "[materials.grey]\ntype = \"lambertian\"\nreflectance = 0.5\n";

std::string write_scene(const std::string& text) {
  const std::string path = test_file("scene.toml");
  std::ofstream(path) << text;
  return path;
}

/// Loads a camera, a point light and `text`.
LoadedScene load_with(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return load_scene(write_scene(kCamera + kLight + text), overrides);
}

/// What is said about --set options to a scene with a named ball.
std::string option_message(const std::string& option) {
  const std::string ball =
      "[[shapes]]\nname = \"ball\"\ntype = \"sphere\"\nmaterial = \"grey\"\ncenter = [0, 0, 0]\nradius = 1\n";
  const std::string fog = "[media.fog]\ntype = \"homogeneous\"\nsigma_s = 1\nsigma_a = 1\n";
  return message_of([&] { load_with(kGrey + ball + fog, {option}); });
}

float relative_difference(const Rgb& a, const Rgb& b) { return glm::length(a - b) / glm::length(b); }

TEST(SceneFile, RefusesBadFiles) {
  for (const std::string& path : bad_files({".toml"})) {
    SCOPED_TRACE(path);
    const std::string message = message_of([&] { load_scene(path); });
    expect_message(path, message);
    std::istringstream lines(message);
    std::string first, source, caret;
    std::getline(lines, first);
    std::getline(lines, source);
    std::getline(lines, caret);
    const size_t column = std::stoul(first.substr(first.find(':', path.size() + 1) + 1));
    EXPECT_EQ(caret.find('^'), source.find('|') + 1 + column) << message;
  }
}

TEST(SceneFile, PlacesTheCaretUnderWideCharactersAndTabs) {
  const std::string text =
      kLight + "[camera]\nposition = [0, 0, 3]\ntarget = [0, 0, 0]\n\"\xc3\xa4\xe2\x82\xac\" =\t1\n";
  const std::string message = message_of([&] { load_scene(write_scene(text)); });
  EXPECT_NE(message.find("scene.toml:8:1: unknown key '\xc3\xa4\xe2\x82\xac'"), std::string::npos) << message;
  const std::string line = "m = {\t'\xc3\xa4\xe2\x82\xac' = 1,\ttype = 'x' }";
  const std::string message_in_line =
      message_of([&] { load_scene(write_scene(kCamera + kLight + "[materials]\n" + line)); });
  EXPECT_NE(message_in_line.find("\n  9 | " + line + "\n    |      \t         \t       ^"), std::string::npos)
      << message_in_line;
}

/// Guessing at what was meant would take minutes here, by the square of the length.
TEST(SceneFile, GuessesAtNoNamesOfAbsurdLength) {
  const std::string name(300'000, 'a');
  const std::string ball = "[[shapes]]\ntype = 'sphere'\ncenter = [0, 0, 0]\nradius = 1\nmaterial = '" + name + "b'\n";
  const std::string message = message_of([&] { load_with("[materials." + name + "]\ntype = 'mirror'\n" + ball); });
  EXPECT_NE(message.find("there is no material 'aaa"), std::string::npos);
  EXPECT_EQ(message.find("did you mean"), std::string::npos);
}

TEST(SceneFile, RefusesMissingFilesAndFolders) {
  EXPECT_EQ(message_of([] { load_scene("no_such.toml"); }), "no_such.toml: cannot open: No such file or directory");
  EXPECT_EQ(message_of([] { load_scene("/tmp"); }), "/tmp: is a folder, not a file");
}

TEST(SceneFile, OptionsChangeKeys) {
  const std::string ball =
      "[[shapes]]\nname = \"ball\"\ntype = \"sphere\"\nmaterial = \"grey\"\ncenter = [0, 0, 0]\nradius = 1\n";
  const LoadedScene plain = load_with(kGrey + ball);
  const LoadedScene changed =
      load_with(kGrey + ball, {"shapes.0.radius=2", "shapes.ball.center=[0, 5, 0]", "render.passes=7",
                               "materials.grey.type=mirror", "lights.0.power=[1, 2, 3]"});
  EXPECT_EQ(plain.scene.geometry.bounds().hi, Vec3(1));
  EXPECT_EQ(changed.scene.geometry.bounds().hi, Vec3(2, 7, 2));
  EXPECT_EQ(changed.settings.passes, 7);
  EXPECT_TRUE(std::holds_alternative<Mirror>(changed.scene.materials[0]));
  EXPECT_FALSE(changed.scene.grey);
  EXPECT_EQ(plain.hash.size(), 16u);
  EXPECT_NE(plain.hash, changed.hash);
  EXPECT_EQ(plain.hash, load_with(kGrey + ball).hash);
}

TEST(SceneFile, HashesTheBytesOfTheFilesItNames) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(test_file("scene.toml")).parent_path();
  const fs::path textures = fs::path(VPM_SOURCE_DIR) / "tests/input/textures";
  const auto picture = [&](const char* name) {
    fs::copy_file(textures / name, folder / "picture.png", fs::copy_options::overwrite_existing);
  };
  const auto mesh = [&](const char* end) {
    std::ofstream(folder / "one.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n" << end;
  };
  const auto sky = [&](float radiance) {
    Image image(1, 1);
    image.pixels[0] = Rgb(radiance);
    write_exr(folder / "sky.exr", image, {}, {});
  };
  const auto hash = [&] {
    const LoadedScene loaded = load_with(
        "[[lights]]\ntype = 'environment'\npath = 'sky.exr'\n[[shapes]]\ntype = 'mesh'\npath = 'one.obj'\n"
        "material = { type = 'mirror', reflectance = { texture = 'picture.png' } }\n");
    EXPECT_EQ(loaded.files.size(), 3u);
    return loaded.hash;
  };
  picture("grey.png"), mesh(""), sky(1.0f);
  const std::string first = hash();
  EXPECT_EQ(hash(), first);
  picture("checker.png");
  EXPECT_NE(hash(), first);
  picture("grey.png"), mesh("# other bytes");
  EXPECT_NE(hash(), first);
  mesh(""), sky(2.0f);
  EXPECT_NE(hash(), first);
  sky(1.0f);
  EXPECT_EQ(hash(), first);
}

TEST(SceneFile, ReadsEveryMaterial) {
  const LoadedScene loaded = load_with(R"(
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

TEST(SceneFile, ClosedRangesHoldTheirEnds) {
  const LoadedScene loaded = load_with(
      "[materials.a]\ntype = 'conductor'\neta = 1e-3\nk = 1e-6\n[materials.b]\ntype = 'dielectric'\nior = 1000\n"
      "[render]\nmax_optical_step = 1e-4\n[distance]\nstep = 1e-3\n");
  EXPECT_EQ(std::get<Conductor>(loaded.scene.materials[0]).k, Rgb(1e-6f));
  EXPECT_EQ(loaded.settings.max_optical_step, 1e-4f);
}

TEST(SceneFile, RefusesBadOptions) {
  const std::pair<std::string, std::string> cases[] = {
      {"render.passes", "--set render.passes: there is no '='"},
      {"render..passes=3", "--set render..passes=3: the path 'render..passes' has an empty key"},
      {"=3", "--set =3: the path '' has an empty key"},
      {"render.pases=3", "--set render.pases=3: unknown key 'pases' in [render]\ndid you mean 'passes'?"},
      {"rendr.passes=3", "--set rendr.passes=3: unknown key 'rendr' in the scene file\ndid you mean 'render'?"},
      {"render.passes=many", "--set render.passes=many: 'passes' of [render] must be an integer, not a string"},
      {"render.passes=0", "--set render.passes=0: 'passes' of [render] must be from 1"},
      {"shapes.1.radius=3",
       "--set shapes.1.radius=3: 'shapes' has no element '1'\nits elements are 0 to 0; named: ball"},
      {"shapes.bal.radius=3",
       "'shapes' has no element 'bal'\nits elements are 0 to 0; did you mean 'ball'? named: ball"},
      {"media.fgo.sigma_s=3", "'media' has no 'fgo'\ndid you mean 'fog'? there are: fog"},
      {"media.fog.phase.g=0.5", "'media.fog' has no 'phase'\nthere are: type, sigma_s, sigma_a"},
      {"shapes.0.radius.x=3", "'shapes.0.radius' is an integer and has no 'x'"},
      {"media.fog.measured=skin1", "[media.fog] gives its coefficients in two ways"},
      {"shapes.0.material=gray", "--set shapes.0.material=gray: there is no material 'gray'\ndid you mean 'grey'?"},
      {"render.passes=\xc3\xa4", "'passes' of [render] must be an integer, not a string"},
      {"camera={}", "--set camera={}: [camera] lacks the key 'position'"},
  };
  for (const auto& [option, expected] : cases) {
    const std::string message = option_message(option);
    EXPECT_NE(message.find(expected), std::string::npos) << option << "\n" << message;
  }
}

TEST(SceneFile, FindsFilesFromTheSceneAndFromTheCurrentFolder) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(test_file("scene.toml")).parent_path();
  std::ofstream(folder / "one.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 2\n";
  std::ofstream(folder / "scene.toml") << kCamera << kLight << kGrey
                                       << "[[shapes]]\ntype = \"mesh\"\nmaterial = \"grey\"\npath = \"one.obj\"\n";
  const LoadedScene loaded = load_scene((folder / "scene.toml").string());
  ASSERT_EQ(loaded.notes.size(), 1u);
  EXPECT_EQ(loaded.notes[0], "shape 'shape 0': 1 triangles without area dropped");
  const std::string here = fs::relative(folder / "one.obj").string();
  EXPECT_NO_THROW(load_scene((folder / "scene.toml").string(), {"shapes.0.path=" + here}));
  EXPECT_THROW(load_scene((folder / "scene.toml").string(), {"shapes.0.path=one.obj"}), InputError);
}

TEST(SceneFile, CountsTrianglesThatTheTransformFlattens) {
  std::ofstream(test_file("two.obj")) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 900 0 0\nv 0 900 0\nf 1 2 3\nf 1 4 5\n";
  const LoadedScene loaded = load_with(
      "[[shapes]]\ntype = 'mesh'\nmaterial = { type = 'mirror' }\npath = 'two.obj'\nemission = 1\n"
      "transform = [{ translate = [1e8, 1e8, 0] }]\n");  // where floats are 8 m apart
  EXPECT_EQ(loaded.notes, std::vector<std::string>{"shape 'shape 0': 1 triangles without area dropped"});
  EXPECT_EQ(loaded.scene.geometry.triangle_count(0), 1u);
}

TEST(SceneFile, ReadsCoefficients) {
  const LoadedScene loaded = load_with(
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
  const LoadedScene loaded = load_scene(write_scene(text));
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

/// The normal that a downward ray at (x, z) meets first.
Vec3 normal_below(const Scene& scene, float x, float z) {
  const std::optional<Hit> hit = scene.geometry.intersect({Vec3(x, 50, z), Vec3(0, -1, 0)});
  return hit ? hit->normal : Vec3(0);
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
  const LoadedScene checker = load_with(wall("{ texture = \"" + folder + "checker.png\", filter = \"nearest\" }"));
  EXPECT_EQ(at(checker.scene, 0.5f, 0.5f), Rgb(1.0f));  // the lower left quarter
  EXPECT_EQ(at(checker.scene, 1.5f, 0.5f), Rgb(0.0f));
  EXPECT_EQ(at(checker.scene, 0.5f, 1.5f), Rgb(0.0f));
  EXPECT_EQ(checker.scene.textures[0], nullptr);
  EXPECT_EQ(std::get<Lambertian>(checker.scene.materials[1]).reflectance, Rgb(0.5f));
  EXPECT_TRUE(checker.scene.grey);
  const LoadedScene smooth = load_with(wall("{ texture = \"" + folder + "checker.png\" }"));
  EXPECT_NEAR(at(smooth.scene, 1.0f, 0.5f).r, 0.5f, 1e-6f);
  const LoadedScene colours = load_with(wall("{ texture = \"" + folder + "colours.png\", filter = \"nearest\" }"));
  EXPECT_LT(glm::distance(at(colours.scene, 0.5f, 1.0f), Rgb(0.50289f, 0.0f, 1.0f)), 1e-4f);
  EXPECT_FALSE(colours.scene.grey);
  const LoadedScene raw =
      load_with(wall("{ texture = \"" + folder + "colours.png\", filter = \"nearest\", raw = true }"));
  EXPECT_LT(glm::distance(at(raw.scene, 1.5f, 1.0f), Rgb(0.2f, 0.4f, 128.0f / 255.0f)), 1e-6f);
}

TEST(SceneFile, TurnsNormalsWithTheirMesh) {
  const std::string path = test_file("slope.obj");
  std::ofstream(path) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 3 0 4\nf 1//1 2//1 3//1\n";
  const auto normal = [&](const std::string& transform, const Vec3& at) {
    const LoadedScene loaded = load_with(kGrey + "[[shapes]]\ntype = \"mesh\"\nmaterial = \"grey\"\npath = \"" + path +
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

TEST(SceneFile, ReadsCameraAndFilm) {
  const Camera camera = load_with("[film]\nwidth = 30\nheight = 20\nfilter = 'tent'\n", {"camera.fov=90"}).scene.camera;
  EXPECT_EQ(camera.position, Vec3(0, 0, 3));
  EXPECT_LT(glm::length(camera.forward - Vec3(0, 0, -1)), 1e-6f);
  EXPECT_NEAR(camera.tan_half_fov, 1.0f, 1e-6f);
  EXPECT_EQ(camera.width, 30);
  EXPECT_EQ(camera.height, 20);
  EXPECT_EQ(camera.filter.kind, FilterKind::tent);
  EXPECT_EQ(camera.filter.radius, 1.0f);
}

TEST(SceneFile, ReadsEverySetting) {
  const RenderSettings s =
      load_with(
          "[render]\nintegrator = 'photon'\npasses = 3\nseconds = 1.5\nseed = 9\nsamples_per_pixel = 2\nmax_events = "
          "77\nradii = 'constant'\n"
          "max_optical_step = 0.25\n[photons]\nemitted = 1000\nstored = 500\nin_cube = 4\n[importance]\nimportons = "
          "70\n"
          "aim = false\nsplit = false\nscatter = true\n[distance]\nstrategy = 'ray-march'\nstep "
          "= 0.5\noptical_step = 0.02\nextinction_floor = 0.2\nmajorant = 0.125\n"
          "[transmittance]\nestimator = 'ray-march'\nstep = 0.75\nsamples = 2.5\n"
          "[volume]\ngather = 'nearest'\nradius = 0.1\ncount = 40\nkernel = 'biweight'\nform = "
          "'density-at-photon'\ndirect = 'shadow-rays'\n"
          "[surface]\ngather = 'nearest'\nradius = 0.3\ncount = 60\nkernel = 'constant'\ndirect = 'photons'\n"
          "indirect = 'final-gather'\ngather_rays = 5\ngather_by = 'photons'\nirradiance = 'precomputed'\n"
          "[caustics]\nradius = 0.01\nemitted = 800\n")
          .settings;
  EXPECT_EQ(s.integrator, Integrator::photon);
  EXPECT_EQ(s.passes, 3);
  EXPECT_EQ(s.seconds, 1.5);
  EXPECT_EQ(s.seed, 9u);
  EXPECT_EQ(s.samples_per_pixel, 2);
  EXPECT_EQ(s.max_events, 77);
  EXPECT_EQ(s.radii, RadiusSchedule::constant);
  EXPECT_EQ(s.max_optical_step, 0.25f);
  EXPECT_EQ(s.photons_emitted, 1000u);
  EXPECT_EQ(s.photons_stored, 500u);
  EXPECT_EQ(s.photons_in_cube, 4u);
  EXPECT_EQ(s.guide.importons, 70u);
  EXPECT_FALSE(s.guide.aim);
  EXPECT_FALSE(s.guide.split);
  EXPECT_TRUE(s.guide.scatter);
  EXPECT_EQ(s.caustics.radius, 0.01f);
  EXPECT_EQ(s.caustics_emitted, 800u);
  EXPECT_EQ(s.distance.strategy, "ray-march");
  EXPECT_EQ(s.distance.step, 0.5f);
  EXPECT_EQ(s.distance.optical_step, 0.02f);
  EXPECT_EQ(s.distance.extinction_floor, 0.2f);
  EXPECT_EQ(s.distance.majorant, 0.125f);
  EXPECT_EQ(s.transmittance.estimator, "ray-march");
  EXPECT_EQ(s.transmittance.step, 0.75f);
  EXPECT_EQ(s.transmittance.samples, 2.5f);
  EXPECT_EQ(s.volume.mode, GatherMode::nearest);
  EXPECT_EQ(s.volume.radius, 0.1f);
  EXPECT_EQ(s.volume.count, 40u);
  EXPECT_EQ(s.volume.kernel, KernelKind::biweight);
  EXPECT_EQ(s.volume_form, VolumeForm::density_at_photon);
  EXPECT_EQ(s.volume_direct, DirectLight::shadow_rays);
  EXPECT_EQ(s.surface.mode, GatherMode::nearest);
  EXPECT_EQ(s.surface.radius, 0.3f);
  EXPECT_EQ(s.surface.count, 60u);
  EXPECT_EQ(s.surface.kernel, KernelKind::constant);
  EXPECT_EQ(s.surface_direct, DirectLight::photons);
  EXPECT_EQ(s.surface_indirect, IndirectLight::final_gather);
  EXPECT_EQ(s.gather_rays, 5);
  EXPECT_EQ(s.gather_by, GatherBy::photons);
  EXPECT_EQ(s.end_irradiance, EndIrradiance::precomputed);
}

TEST(SceneFile, CorrectsAtBordersWhereAsked) {
  const RenderSettings volume = load_with("[volume]\nboundary = 'corrected'\n").settings;
  EXPECT_EQ(volume.volume.boundary, BoundaryRule::corrected);
  EXPECT_EQ(volume.surface.boundary, BoundaryRule::none);
  EXPECT_EQ(volume.caustics.boundary, BoundaryRule::none);
  const RenderSettings surface = load_with("[surface]\nboundary = 'corrected'\n").settings;
  EXPECT_EQ(surface.volume.boundary, BoundaryRule::none);
  EXPECT_EQ(surface.surface.boundary, BoundaryRule::corrected);
  EXPECT_EQ(surface.caustics.boundary, BoundaryRule::corrected);  // goes with the surface's
  const RenderSettings plain = load_with("[volume]\nboundary = 'none'\n[surface]\nboundary = 'none'\n").settings;
  EXPECT_EQ(plain.volume.boundary, BoundaryRule::none);
  EXPECT_EQ(plain.surface.boundary, BoundaryRule::none);
}

TEST(SceneFile, AMethodChoosesDirectAndIndirectLight) {
  const auto with = [](const std::string& method) {
    return load_with("[surface]\nmethod = '" + method + "'\n").settings;
  };
  EXPECT_EQ(with("visualise").surface_direct, DirectLight::photons);
  EXPECT_EQ(with("visualise").surface_indirect, IndirectLight::photons);
  EXPECT_EQ(with("progressive").surface_direct, DirectLight::shadow_rays);
  EXPECT_EQ(with("progressive").surface_indirect, IndirectLight::photons);
  EXPECT_EQ(with("final-gather").surface_direct, DirectLight::shadow_rays);
  EXPECT_EQ(with("final-gather").surface_indirect, IndirectLight::final_gather);
}

TEST(SceneFile, RadiiAreOfAllPassesOrShrinkByPassOrByPixel) {
  const auto with = [](const std::string& radii) { return load_with("[render]\nradii = '" + radii + "'\n").settings; };
  EXPECT_EQ(load_with("").settings.radii, RadiusSchedule::per_pass);
  EXPECT_EQ(with("constant").radii, RadiusSchedule::constant);
  EXPECT_EQ(with("per-pass").radii, RadiusSchedule::per_pass);
  EXPECT_EQ(with("per-pixel").radii, RadiusSchedule::per_pixel);
}

TEST(SceneFile, DefaultsAreThoseOfTheSettings) {
  const RenderSettings s = load_with("[render]\n[photons]\n[distance]\n[transmittance]\n[volume]\n[surface]\n")
                               .settings,
                       d;
  EXPECT_EQ(s.passes, d.passes);
  EXPECT_EQ(s.seed, d.seed);
  EXPECT_EQ(s.max_events, d.max_events);
  EXPECT_EQ(s.photons_emitted, d.photons_emitted);
  EXPECT_EQ(s.photons_stored, d.photons_stored);
  EXPECT_EQ(s.distance.strategy, d.distance.strategy);
  EXPECT_EQ(s.transmittance.estimator, d.transmittance.estimator);
  EXPECT_EQ(s.transmittance.samples, d.transmittance.samples);
  EXPECT_EQ(s.volume.count, d.volume.count);
  EXPECT_EQ(s.volume.kernel, d.volume.kernel);
  EXPECT_EQ(s.surface_direct, d.surface_direct);
  EXPECT_EQ(s.gather_by, d.gather_by);
  EXPECT_EQ(s.end_irradiance, d.end_irradiance);
  EXPECT_EQ(load_with("[photons]\nstored = 10\n").settings.photons_emitted, 0u);  // until the maps are full
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
    EXPECT_EQ(normal_below(scene, 0.0f, bounds.centre().z), Vec3(0, 1, 0));
    EXPECT_EQ(medium_at(scene, bounds.centre()), 0);
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

TEST(SceneFile, TheExamplesLoad) {
  for (const auto& entry : std::filesystem::directory_iterator(std::string(VPM_SOURCE_DIR) + "/scenes")) {
    if (entry.path().extension() != ".toml") continue;
    const std::string message = message_of([&] { load_scene(entry.path().string()); });
    // Grids and meshes that vpm makes, or that users have, may not be there.
    const bool lacks_a_file =
        message.find("there is no file '") != std::string::npos &&
        (message.find(".vdb'") != std::string::npos || message.find(".ply'") != std::string::npos);
    EXPECT_TRUE(message.empty() || lacks_a_file) << message;
  }
}

}  // namespace
}  // namespace vpm
