// Scenes put together from parts in code: what comes out, and that every mistake is refused with the part it is in.
#include "vpm/scene/assemble.h"

#include <gtest/gtest.h>

#include <functional>

#include "vpm/base/rng.h"
#include "vpm/medium/grid/make_grid.h"

namespace vpm {
namespace {

/// A grey ball on a floor under a light; the camera stands before them.
SceneParts ball_on_floor() {
  SceneParts parts;
  parts.materials = {{Lambertian{Rgb(0.5f)}, nullptr}, {Dielectric{1.5f}, nullptr}, {Boundary{}, nullptr}};
  ShapePart ball, floor;
  ball.name = "ball";
  ball.surface = SphereShape{{0, 0, 0}, 1.0f};
  floor.surface = QuadMesh{quad_mesh(Vec3d(-5, -1, -5), Vec3d(0, 0, 10), Vec3d(10, 0, 0))};
  parts.shapes = {ball, floor};
  parts.lights = {{"lamp", PointLight{{0, 5, 0}, Rgb(1)}}};
  parts.camera = make_camera({0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 40, {8, 6});
  return parts;
}

Medium fog(const std::string& name, const Rgb& sigma_t = Rgb(1)) {
  Medium medium = make_medium(nullptr, sigma_t);
  medium.name = name;
  return medium;
}

/// Smoke in a cube of side 2 m about the origin.
Medium smoke(float background = 0.0f) {
  GridFrame frame = centered_frame(4, 0.25);
  frame.background = background;
  Medium medium = make_medium(make_grid(frame, [](int, int, int) { return 1.0; }), Rgb(1));
  medium.name = "smoke";
  return medium;
}

/// A sphere of a boundary with media on its sides.
ShapePart bubble(const Vec3& center, float radius, const Interface& media) {
  ShapePart shape;
  shape.surface = SphereShape{center, radius};
  shape.material = 2;
  shape.media = media;
  return shape;
}

/// Changes the parts of ball_on_floor() and tells how assemble() refuses them; "" where it does not.
std::string refusal(const std::function<void(SceneParts&)>& change) {
  SceneParts parts = ball_on_floor();
  change(parts);
  try {
    assemble(std::move(parts));
  } catch (const PartError& error) {
    return error.what();
  }
  return "";
}

/// The refusal must begin with `part`, colon, `wrong`.
void expect_refusal(const std::string& part, const std::string& wrong, const std::function<void(SceneParts&)>& change) {
  const std::string message = refusal(change);
  EXPECT_EQ(message.substr(0, part.size() + 2 + wrong.size()), part + ": " + wrong) << message;
}

TEST(Assemble, KeepsTheOrderOfParts) {
  SceneParts parts = ball_on_floor();
  parts.shapes[0].emission = Rgb(2);
  parts.shapes[1].emission = Rgb(3);
  const AssembledScene assembled = assemble(std::move(parts));
  const Scene& scene = assembled.scene;
  ASSERT_EQ(scene.shapes.size(), 2u);
  EXPECT_EQ(scene.shapes[0].name, "ball");
  EXPECT_EQ(scene.shapes[1].name, "shape 1");
  EXPECT_EQ(scene.shapes[0].light, 1);
  EXPECT_EQ(scene.shapes[1].light, 2);
  EXPECT_EQ(assembled.light_names, (std::vector<std::string>{"lamp", "ball", "shape 1"}));
  ASSERT_EQ(scene.lights.size(), 3u);
  EXPECT_EQ(std::get<SphereLight>(scene.lights[1]).radiance, Rgb(2));
  EXPECT_EQ(std::get<QuadLight>(scene.lights[2]).edge_u, Vec3(0, 0, 10));
  EXPECT_EQ(scene.light_probability.size(), 3u);
  EXPECT_EQ(scene.camera.width, 8);
  EXPECT_EQ(scene.camera_medium, kVacuum);
  EXPECT_TRUE(assembled.notes.empty());
}

TEST(Assemble, GivesAMaterialTheMeanOfItsTexture) {
  SceneParts parts = ball_on_floor();
  Image image(2, 1);
  image.pixels = {Rgb(0.25f), Rgb(0.75f)};
  parts.materials[0].texture = std::make_shared<const Texture>(image, TextureFilter::nearest);
  const Scene scene = assemble(std::move(parts)).scene;
  EXPECT_EQ(*diffuse_reflectance(scene.materials[0]), Rgb(0.5f));
  EXPECT_NE(scene.textures[0], nullptr);
}

TEST(Assemble, PutsABoxAroundAGridThatNoShapeBounds) {
  SceneParts parts = ball_on_floor();
  parts.shapes.resize(1);
  parts.media = {{smoke(), GridBoundary::automatic, {}}};
  const Scene scene = assemble(parts).scene;
  ASSERT_EQ(scene.shapes.size(), 2u);
  EXPECT_EQ(scene.shapes[1].name, "box of smoke");
  EXPECT_TRUE(is_boundary(scene.materials[scene.shapes[1].material]));
  EXPECT_EQ(medium_at(scene, Vec3(1.1f, 0, 0)), 0);
  EXPECT_EQ(medium_at(scene, Vec3(1.3f, 0, 0)), kVacuum);
  parts.shapes.push_back(bubble({0, 0, 0}, 1.2f, {0, kVacuum}));
  EXPECT_EQ(assemble(parts).scene.shapes.size(), 2u);
}

/// Where its faces are met too roughly, a box would leave out what lies at its ends, by up to some voxels.
TEST(Assemble, TheBoxOfAWideGridHasAMargin) {
  for (const int apart : {1000, 1'000'000, 10'000'000}) {
    SceneParts parts = ball_on_floor();
    parts.shapes.clear();
    GridFrame frame = centered_frame(0, 1.0 / 24.0);  // its faces have no coordinates in single precision
    frame.lo = Vec3i(0);
    frame.hi = Vec3i(apart + 15, 15, 15);
    const auto fill = [](const Vec3i&, float* values) {
      values[0] = 1.0f;
      return DensityGrid::Filled::one;
    };
    const std::vector<IndexBox> ends{{Vec3i(0), Vec3i(15)}, {Vec3i(apart, 0, 0), frame.hi}};
    parts.media = {
        {make_medium(std::make_shared<const DensityGrid>(frame, fill, ends), Rgb(1)), GridBoundary::automatic, {}}};
    const Scene scene = assemble(parts).scene;
    const DensityGrid& grid = *scene.media[0].grid;
    Rng rng(7, rng_stream(RngUse::test, 0), 0);
    int outside = 0;
    for (int i = 0; i < 1000; ++i) {
      // From 40 m beyond the end, where its cloud is seen.
      const Vec3 origin(grid.bounds().hi.x + 40.0f, 6.0f * rng.uniform() - 3.0f, 6.0f * rng.uniform() - 3.0f);
      const Vec3 target(grid.bounds().hi.x, 0.6f * rng.uniform(), 0.6f * rng.uniform());
      const Ray ray{origin, glm::normalize(target - origin)};
      const std::optional<Hit> face = scene.geometry.intersect(ray);
      ASSERT_TRUE(face);
      outside += face->t > grid.clip(ray, {}).t0 + 1e-6f * 40.0f ? 1 : 0;
    }
    EXPECT_EQ(outside, 0) << apart;
    EXPECT_LT(scene.bounds.hi.x - grid.bounds().hi.x, 1e-5f * grid.bounds().hi.x) << apart;
  }
}

TEST(Assemble, TakesTheCamerasMediumFromTheShapesUnlessTold) {
  SceneParts parts = ball_on_floor();
  parts.shapes.resize(1);
  parts.media = {{fog("fog"), GridBoundary::automatic, {}}};
  parts.shapes.push_back(bubble({0, 0, 0}, 9.0f, {0, kVacuum}));
  EXPECT_EQ(assemble(parts).scene.camera_medium, 0);
  parts.camera_medium = kVacuum;
  EXPECT_EQ(assemble(parts).scene.camera_medium, kVacuum);
}

TEST(Assemble, NotesWhatSinglePrecisionDoesNotResolve) {
  SceneParts parts = ball_on_floor();
  parts.media = {{fog("ink", Rgb(1e9f)), GridBoundary::automatic, {}}};
  TriangleMesh mesh = box_mesh(Vec3d(-3.0), Vec3d(-2.0));
  mesh.triangles.push_back({0, 0, 1});
  ShapePart box;
  box.name = "box";
  box.surface = mesh;
  parts.shapes.push_back(box);
  const std::vector<std::string> notes = assemble(std::move(parts)).notes;
  ASSERT_EQ(notes.size(), 2u);
  EXPECT_EQ(notes[0], "shape 'box': 1 triangles without area dropped");
  EXPECT_NE(notes[1].find("medium 'ink': its free paths"), std::string::npos);
  parts = ball_on_floor();
  parts.shapes[0].surface = SphereShape{{1e6f, 0, 0}, 1.0f};
  parts.shapes.resize(1);
  EXPECT_EQ(assemble(std::move(parts)).notes.size(), 1u);
}

TEST(Assemble, RefusesWhatIsNotInTheLists) {
  EXPECT_EQ(refusal([](SceneParts&) {}), "");
  expect_refusal("shapes[1].material", "there is no material of number 3",
                 [](SceneParts& p) { p.shapes[1].material = 3; });
  expect_refusal("shapes[0].inside", "there is no medium of number 0", [](SceneParts& p) {
    p.shapes[0].media = Interface{0, kVacuum};
  });
  expect_refusal("shapes[0].outside", "there is no medium of number -2", [](SceneParts& p) {
    p.shapes[0].media = Interface{kVacuum, kSeveralMedia};
  });
  expect_refusal("world_medium", "there is no medium of number 0", [](SceneParts& p) { p.world_medium = 0; });
  expect_refusal("camera_medium", "there is no medium of number 4", [](SceneParts& p) { p.camera_medium = 4; });
  expect_refusal("media[0].outside", "there is no medium of number 1", [](SceneParts& p) {
    p.media = {{smoke(), GridBoundary::box, 1}};
  });
}

TEST(Assemble, RefusesNumbersOutOfTheirRanges) {
  expect_refusal("media[0]", "its extinction", [](SceneParts& p) {
    p.media = {{fog("fog", Rgb(kInfinity)), GridBoundary::automatic, {}}};
  });
  expect_refusal("media[0]", "its scattering coefficient", [](SceneParts& p) {
    p.media = {{fog("fog"), GridBoundary::automatic, {}}};
    p.media[0].medium.sigma_s = Rgb(0, 0, 1.5f);
  });
  expect_refusal("media[0]", "its g must be in (-1, 1)", [](SceneParts& p) {
    p.media = {{fog("fog"), GridBoundary::automatic, {}}};
    p.media[0].medium.phase = HenyeyGreenstein{-1.0f};
  });
  const std::pair<Material, const char*> materials[] = {{Lambertian{Rgb(0, 0, 1.01f)}, "its reflectance"},
                                                        {Mirror{Rgb(-0.1f)}, "its reflectance"},
                                                        {Phong{Rgb(0.6f), Rgb(0.5f), 10.0f}, "its diffuse and glossy"},
                                                        {Phong{Rgb(0.5f), Rgb(0.5f), -1.0f}, "its exponent"},
                                                        {Conductor{Rgb(0.0f), Rgb(1.0f)}, "its eta"},
                                                        {Conductor{Rgb(1.0f), Rgb(1e7f)}, "its k"},
                                                        {RoughConductor{Rgb(1.0f), Rgb(1.0f), 0.0f}, "its roughness"},
                                                        {Dielectric{0.0f}, "its ior"},
                                                        {ThinDielectric{kInfinity}, "its ior"},
                                                        {RoughDielectric{1.001f, 0.1f}, "its ior must be at least"},
                                                        {RoughDielectric{1.5f, 2.0f}, "its roughness"}};
  for (const auto& [material, wrong] : materials)
    expect_refusal("materials[0]", wrong, [&](SceneParts& p) { p.materials[0].material = material; });
  const Vec3 down(0, -1, 0);
  const std::pair<Light, const char*> lights[] = {{PointLight{{NAN, 0, 0}, Rgb(1)}, "its position"},
                                                  {PointLight{{}, Rgb(0)}, "its intensity is 0"},
                                                  {PointLight{{}, Rgb(1, 1, -1)}, "its intensity must"},
                                                  {SpotLight{{}, down, 0.5f, 0.6f, Rgb(1)}, "the cosines"},
                                                  {SpotLight{{}, down, 1.0f, 1.0f, Rgb(1)}, "its outer cone"},
                                                  {BeamLight{{}, 2.0f * down, 1.0f, Rgb(1)}, "its direction"},
                                                  {BeamLight{{}, down, 0.0f, Rgb(1)}, "its radius"},
                                                  {DirectionalLight{down, Rgb(kInfinity)}, "its irradiance"},
                                                  {ConstantEnvironment{Rgb(0)}, "its radiance is 0"},
                                                  {EnvironmentMap{}, "it lacks its picture"},
                                                  {SphereLight{}, "a surface that emits is a shape"}};
  for (const auto& [light, wrong] : lights)
    expect_refusal("lights[1]", wrong, [&](SceneParts& p) { p.lights.push_back({"", light}); });
  expect_refusal("camera", "its film", [](SceneParts& p) { p.camera.width = 0; });
  expect_refusal("camera", "its position", [](SceneParts& p) { p.camera.position.y = kInfinity; });
  expect_refusal("camera", "its field of view", [](SceneParts& p) { p.camera.tan_half_fov = 0.0f; });
  expect_refusal("camera", "the filter's radius", [](SceneParts& p) { p.camera.filter.radius = NAN; });
}

TEST(Assemble, RefusesShapes) {
  expect_refusal("shapes[1].name", "two shapes are named 'ball'", [](SceneParts& p) { p.shapes[1].name = "ball"; });
  expect_refusal("shapes[1].name", "two shapes are named 'shape 1'",
                 [](SceneParts& p) { p.shapes[0].name = "shape 1"; });
  expect_refusal("shapes[0].emission", "the emission of shape 'ball' is black",
                 [](SceneParts& p) { p.shapes[0].emission = Rgb(0); });
  expect_refusal("shapes[0].emission", "the emission of shape 'ball' must be at least 0",
                 [](SceneParts& p) { p.shapes[0].emission = Rgb(1, -1, 1); });
  expect_refusal("shapes[1].emission", "a boundary has no surface that could emit", [](SceneParts& p) {
    p.shapes[1].emission = Rgb(1);
    p.shapes[1].material = 2;
  });
  expect_refusal("shapes[0]", "sphere: the radius is -1", [](SceneParts& p) {
    p.shapes[0].surface = SphereShape{{}, -1.0f};
  });
  expect_refusal("shapes[0].surface", "the normal of a disc", [](SceneParts& p) {
    p.shapes[0].surface = DiscShape{{}, {0, 2, 0}, 1.0f};
  });
  expect_refusal("shapes[1]", "mesh: triangle 1 names vertex 7",
                 [](SceneParts& p) { std::get<QuadMesh>(p.shapes[1].surface).mesh.triangles[1].y = 7; });
  expect_refusal("shapes[1]", "quad: it must have the four vertices", [](SceneParts& p) {
    p.shapes[1].surface = QuadMesh{box_mesh(Vec3d(-1), Vec3d(1))};
    p.shapes[1].emission = Rgb(1);
  });
}

TEST(Assemble, RefusesTexturesThatNothingTells) {
  const auto picture = std::make_shared<const Texture>(Image(1, 1), TextureFilter::nearest);
  expect_refusal("shapes[0].material", "the material of shape 'ball' has a texture, but", [&](SceneParts& p) {
    p.materials[0].texture = picture;
    p.shapes[0].surface = DiscShape{};
  });
  expect_refusal("materials[1].texture", "a texture is a reflectance",
                 [&](SceneParts& p) { p.materials[1].texture = picture; });
}

TEST(Assemble, RefusesLightThatReachesNothing) {
  const LightPart sky{"", ConstantEnvironment{}};
  expect_refusal("scene", "the scene has no light", [](SceneParts& p) { p.lights.clear(); });
  expect_refusal("lights", "a light at infinity has nothing to shine on", [&](SceneParts& p) {
    p.lights = {sky};
    p.shapes.clear();
  });
  expect_refusal("lights", "lights: their power is inf", [&](SceneParts& p) {
    p.lights = {{"", PointLight{{}, Rgb(3e38f)}}};
  });
  expect_refusal("world_medium", "a medium fills the world, but a light comes from infinity", [&](SceneParts& p) {
    p.media = {{fog("fog"), GridBoundary::automatic, {}}};
    p.world_medium = 0;
    p.lights.push_back(sky);
  });
}

TEST(Assemble, RefusesGridsWithoutAnEnd) {
  const auto with_smoke = [](SceneParts& p, GridBoundary boundary, float background = 0.0f) {
    p.media = {{smoke(background), boundary, {}}};
  };
  expect_refusal("media[0]", "no shape names the grid medium 'smoke'",
                 [&](SceneParts& p) { with_smoke(p, GridBoundary::shapes); });
  expect_refusal("media[0]", "the grid medium 'smoke' lies outside of shapes only", [&](SceneParts& p) {
    with_smoke(p, GridBoundary::automatic);
    p.shapes[0].media = Interface{kVacuum, 0};
  });
  expect_refusal("media[0]", "the grid medium 'smoke' fills the world and cannot have a box", [&](SceneParts& p) {
    with_smoke(p, GridBoundary::box);
    p.world_medium = 0;
  });
  expect_refusal("world_medium", "the grid of 'smoke' has background 0", [&](SceneParts& p) {
    with_smoke(p, GridBoundary::automatic);
    p.world_medium = 0;
  });
  expect_refusal("media[0]", "the grid of 'smoke' has a background other than 0",
                 [&](SceneParts& p) { with_smoke(p, GridBoundary::automatic, 0.5f); });
  expect_refusal("media[0].outside", "a medium cannot be outside itself", [&](SceneParts& p) {
    with_smoke(p, GridBoundary::box);
    p.media[0].outside = 0;
  });
  expect_refusal("media[0]", "a medium without a grid has no box", [](SceneParts& p) {
    p.media = {{fog("fog"), GridBoundary::box, {}}};
  });
  expect_refusal("media[0]", "no medium can be named 'vacuum'", [](SceneParts& p) {
    p.media = {{fog("vacuum"), GridBoundary::automatic, {}}};
  });
}

TEST(Assemble, RefusesShapesThatContradictEachOther) {
  expect_refusal("shapes[1]", "shape 'shape 1' has vacuum outside, but the shapes around it say that 'fog' is there",
                 [](SceneParts& p) {
                   p.media = {{fog("fog"), GridBoundary::automatic, {}}};
                   p.shapes = {bubble({1, 0, 0}, 2.0f, {0, kVacuum}), bubble({0, 0, 0}, 1.5f, {0, kVacuum})};
                 });
  expect_refusal("shapes[1]", "shape 'shape 1' has a face in common with shape 'ball'", [](SceneParts& p) {
    p.shapes[1].surface = p.shapes[0].surface;
    p.shapes[0].material = p.shapes[1].material = 1;
  });
  // The box of a grid is told as the grid's medium.
  expect_refusal("media[0]", "shape 'box of smoke' has vacuum outside", [](SceneParts& p) {
    p.media = {{smoke(), GridBoundary::automatic, {}}, {fog("fog"), GridBoundary::automatic, {}}};
    p.shapes = {bubble({0, 0, 0}, 9.0f, {1, kVacuum})};
  });
}

TEST(Assemble, TellsThePartAndWhatWouldBeRight) {
  SceneParts parts = ball_on_floor();
  parts.shapes[1].name = "ball";
  try {
    assemble(std::move(parts));
    FAIL();
  } catch (const PartError& error) {
    EXPECT_EQ(error.part().kind, PartKind::shape);
    EXPECT_EQ(error.part().number, 1u);
    EXPECT_EQ(error.part().field, "name");
    EXPECT_EQ(error.wrong(), "two shapes are named 'ball'");
    EXPECT_EQ(std::string(error.what()),
              "shapes[1].name: two shapes are named 'ball'\ngive each shape a name of its own");
  }
}

}  // namespace
}  // namespace vpm
