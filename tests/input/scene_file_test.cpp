// Scene files: every mistake is refused with its place and what would be right; options and the files it names.
#include "vpm/input/scene_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "input/expectations.h"
#include "input/scene_text.h"
#include "support/test_file.h"
#include "vpm/image/exr.h"

namespace vpm {
namespace {

/// What is said about --set options to a scene with a named ball.
std::string option_message(const std::string& option) {
  const std::string ball =
      "[[shapes]]\nname = \"ball\"\ntype = \"sphere\"\nmaterial = \"grey\"\ncenter = [0, 0, 0]\nradius = 1\n";
  const std::string fog = "[media.fog]\ntype = \"homogeneous\"\nsigma_s = 1\nsigma_a = 1\n";
  return message_of([&] { load_with(kGrey + ball + fog, {option}); });
}

TEST_F(BadInput, ScenesAreRefused) {
  for (const Row& row : rows(".toml")) {
    const std::string& path = row.path;
    SCOPED_TRACE(path);
    const std::string message = message_of([&] { load_scene(path); });
    expect_message(row, message);
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

TEST(SceneFile, ReadsLettersBeyondAsciiBehindJoinedLines) {
  const RenderJob loaded = load_with(
      "[[shapes]]\nname = \"\"\"la \\\n  \u00e9toile\"\"\"\ntype = 'sphere'\nmaterial = { type = 'lambertian', "
      "reflectance = 0.5 }\ncenter = [0, 0, 0]\nradius = 1\n");
  EXPECT_EQ(loaded.scene.shapes.back().name, "la \u00e9toile");
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
  const RenderJob plain = load_with(kGrey + ball);
  const RenderJob changed =
      load_with(kGrey + ball, {"shapes.0.radius=2", "shapes.ball.center=[0, 5, 0]", "render.passes=7",
                               "materials.grey.type=mirror", "lights.0.power=[1, 2, 3]"});
  EXPECT_EQ(plain.scene.geometry.bounds().hi, Vec3(1));
  EXPECT_EQ(changed.scene.geometry.bounds().hi, Vec3(2, 7, 2));
  EXPECT_EQ(changed.settings.until.passes, 7);
  EXPECT_TRUE(std::holds_alternative<Mirror>(changed.scene.materials[0]));
  EXPECT_FALSE(changed.scene.grey);
  EXPECT_EQ(plain.hash.size(), 16u);
  EXPECT_NE(plain.hash, changed.hash);
  EXPECT_EQ(plain.hash, load_with(kGrey + ball).hash);
}

TEST(SceneFile, OptionsAddElements) {
  const std::string ball =
      "[[shapes]]\nname = 'a ball'\ntype = 'sphere'\nmaterial = 'grey'\ncenter = [0, 0, 0]\nradius = 1\n";
  const RenderJob added = load_with(
      kGrey + ball, {" shapes.1 = {type='sphere', material='grey', center=[0, 0, 3]}", "shapes.1.radius=2",
                     "shapes. a ball .center=[0, 0, -1]", "lights.1={type='point', position=[0, 4, 0], power=1}",
                     "lights.new={type='point', position=[0, 5, 0], power=1}"});
  EXPECT_EQ(added.scene.geometry.bounds().lo, Vec3(-2, -2, -2));
  EXPECT_EQ(added.scene.geometry.bounds().hi, Vec3(2, 2, 5));
  EXPECT_EQ(added.scene.lights.size(), 3u);
  // Where the file has no such list, too.
  for (const char* key : {"0", "new"}) {
    const std::string sphere =
        std::string("shapes.") + key + "={type='sphere', material='grey', center=[0, 0, 0], radius=3}";
    EXPECT_EQ(load_with(kGrey, {sphere}).scene.geometry.bounds().hi, Vec3(3)) << key;
  }
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
    const RenderJob loaded = load_with(
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

TEST(SceneFile, RefusesBadOptions) {
  const std::pair<std::string, std::string> cases[] = {
      {"render.passes", "--set render.passes: there is no '='"},
      {"render..passes=3", "--set render..passes=3: the path 'render..passes' has an empty key"},
      {"=3", "--set =3: the path '' has an empty key"},
      {"render.pases=3", "--set render.pases=3: unknown key 'pases' in [render]\ndid you mean 'passes'?"},
      {"rendr.passes=3", "--set rendr.passes=3: unknown key 'rendr' in the scene file\ndid you mean 'render'?"},
      {"render.passes=.5",
       "--set render.passes=.5: '.5' is no TOML value\nnumbers have a digit before the point, as 0.5; texts in lists "
       "and tables stand in quotes; keys and values "
       "are parted by '='"},
      {"camera.fov={a = .5}",
       "--set camera.fov={a = .5}: '{a = .5}' is no TOML value\nnumbers have a digit before the point, as 0.5; texts "
       "in lists and tables stand in quotes; keys and values "
       "are parted by '='"},
      {"render.passes=many", "--set render.passes=many: 'passes' of [render] must be an integer, not 'many'"},
      {"render.passes=0", "--set render.passes=0: 'passes' of [render] must be from 1"},
      {"shapes.2.radius=3",
       "--set shapes.2.radius=3: 'shapes' has no element '2'\nits elements are 0 to 0, 'new' would be a new one; "
       "named: "
       "ball"},
      {"shapes.99999999999999999999.radius=3", "'shapes' has no element '99999999999999999999'"},
      {"shapes.1.radius=3", "--set shapes.1.radius=3: [[shapes]] number 1 lacks the key 'type'"},
      {"shapes.bal.radius=3",
       "'shapes' has no element 'bal'\nits elements are 0 to 0, 'new' would be a new one; did you mean 'ball'? named: "
       "ball"},
      {"media.fgo.sigma_s=3", "'media' has no 'fgo'\ndid you mean 'fog'? there are: fog"},
      {"media.fog.phase.g=0.5", "'media.fog' has no 'phase'\nthere are: type, sigma_s, sigma_a"},
      {"shapes.0.radius.x=3", "'shapes.0.radius' is an integer and has no 'x'"},
      {"media.fog.measured=skin1", "[media.fog] gives its coefficients in two ways"},
      {"shapes.0.material=gray", "--set shapes.0.material=gray: there is no material 'gray'\ndid you mean 'grey'?"},
      {"render.passes=\xc3\xa4", "'passes' of [render] must be an integer, not '\xc3\xa4'"},
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
  const RenderJob loaded = load_scene((folder / "scene.toml").string());
  ASSERT_EQ(loaded.notes.size(), 1u);
  EXPECT_EQ(loaded.notes[0], "shape 'shape 0': 1 triangles without area dropped");
  const std::string here = fs::relative(folder / "one.obj").string();
  EXPECT_NO_THROW(load_scene((folder / "scene.toml").string(), {"shapes.0.path=" + here}));
  EXPECT_THROW(load_scene((folder / "scene.toml").string(), {"shapes.0.path=one.obj"}), InputError);
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
