// The scene around a grid: which grid is meant, its extinction, and that all of it is seen.
#include "vpm/input/view_scene.h"

#include <fmt/format.h>
#include <openvdb/tools/LevelSetSphere.h>

#include "input/grid_folder.h"
#include "vpm/base/error.h"
#include "vpm/input/scene_file.h"

namespace vpm {
namespace {

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// A cube of such voxels, each a tenth of a metre wide, with a margin of zeros around it.
openvdb::FloatGrid::Ptr cube_grid(const std::string& name, int voxels, int margin, float density = 1.0f) {
  auto grid = new_grid<openvdb::FloatGrid>();
  grid->setName(name);
  grid->setGridClass(openvdb::GRID_FOG_VOLUME);
  grid->setTransform(openvdb::math::Transform::createLinearTransform(0.1));
  auto accessor = grid->getAccessor();
  const openvdb::Coord end(voxels - 1 + margin);
  for (const openvdb::Coord& c : openvdb::CoordBBox(openvdb::Coord(-margin), end)) accessor.setValueOn(c, 0.0f);
  for (const openvdb::Coord& c : openvdb::CoordBBox(openvdb::Coord(0), openvdb::Coord(voxels - 1)))
    accessor.setValueOn(c, density);
  return grid;
}

class ViewOfGrid : public GridFile {
 protected:
  ViewScene view(const ViewWishes& wishes = {}) const { return make_view_scene(path_, path_, wishes); }
  RenderJob job_of(const ViewWishes& wishes = {}) const {
    return load_scene(SceneText{"view.toml", view(wishes).text});
  }
  std::string refusal_of(const ViewWishes& wishes = {}) const {
    try {
      view(wishes);
    } catch (const InputError& error) {
      return error.what();
    }
    return "(accepted)";
  }
};

TEST_F(ViewOfGrid, HasTheOpticalDepthAcrossThatIsWished) {
  write({cube_grid("density", 32, 8, 0.25f)});
  for (const double depth : {5.0, 0.5}) {
    const RenderJob job = job_of({.optical_depth = depth});
    const Medium& medium = job.scene.media.at(0);
    const double across = 32 * 0.1;
    EXPECT_NEAR(medium.sigma_t.g * 0.25 * across, depth, 1e-3 * depth);
  }
}

// A sheet of one voxel in 300 is between the points of any lattice that is not much finer than the grid.
TEST_F(ViewOfGrid, HasTheOpticalDepthOfThinSheetsToo) {
  for (const int place : {100, 101, 102, 103}) {
    auto grid = new_grid<openvdb::FloatGrid>();
    grid->setName("density");
    grid->fill(openvdb::CoordBBox({0, 0, place}, {15, 15, place}), 3.0f);
    for (const int end : {0, 299}) grid->getAccessor().setValueOn({0, 0, end}, 1e-6f);
    write({grid});
    EXPECT_NEAR(job_of().scene.media.at(0).sigma_t.g * 3.0, 5.0, 0.01) << "at voxel " << place;
  }
}

/// Whatever is 0 around what is dense, whichever axis is up, and whatever the shape of the picture, the corners of that
/// are in the frame and near its edge.
TEST_F(ViewOfGrid, ShowsAllThatIsDenseAndNotMuchMore) {
  const auto expect_framed = [&](const ViewWishes& wishes, int width, int height) {
    const std::vector<std::string> film{fmt::format("film.width={}", width), fmt::format("film.height={}", height)};
    const Camera camera = load_scene(SceneText{"view.toml", view(wishes).text}, film).scene.camera;
    const Vec2 middle = 0.5f * Vec2(width, height);
    float widest = 0.0f;
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 p(corner & 1 ? 2.0f : 0.0f, corner & 2 ? 2.0f : 0.0f, corner & 4 ? 2.0f : 0.0f);
      const std::optional<Vec2> seen = camera.film_of(glm::normalize(p - camera.position));
      ASSERT_TRUE(seen);
      for (const int axis : {0, 1}) widest = std::max(widest, std::abs((*seen)[axis] / middle[axis] - 1.0f));
    }
    EXPECT_LT(widest, 0.95f);
    EXPECT_GT(widest, 0.7f);
  };
  for (const int margin : {0, 40}) {
    write({cube_grid("density", 20, margin)});
    for (const UpAxis up : {UpAxis::y, UpAxis::z}) expect_framed({.up = up}, 512, 512);
    expect_framed({.aspect = 0.5}, 200, 400);
    expect_framed({.aspect = 3.0}, 600, 200);
  }
}

TEST_F(ViewOfGrid, TakesTheDensityOfSeveralGridsAndTheOnlyOneOfAnyName) {
  const auto temperature = cube_grid("temperature", 8, 0, 300.0f);
  write({temperature, cube_grid("density", 8, 0)});
  EXPECT_TRUE(contains(view().text, "grid = \"density\""));
  EXPECT_TRUE(contains(view({.grid = "temperature"}).text, "grid = \"temperature\""));
  write({cube_grid("smoke", 8, 0)});
  EXPECT_TRUE(contains(view().text, "grid = \"smoke\""));
  write({cube_grid("", 8, 0)});
  EXPECT_EQ(job_of().scene.media.size(), 1u);
}

TEST_F(ViewOfGrid, RefusesWhereSeveralGridsOrNoneCouldBeMeant) {
  write({cube_grid("smoke", 8, 0), cube_grid("dust", 8, 0)});
  EXPECT_TRUE(contains(refusal_of(), "several grids could be meant; name one with --grid"));
  EXPECT_TRUE(contains(refusal_of(), "smoke (float, fog volume), dust (float, fog volume)"));
  EXPECT_TRUE(contains(refusal_of({.grid = "fog"}), "there is no grid 'fog'; there are: smoke"));
  auto vectors = new_grid<openvdb::Vec3SGrid>();
  vectors->setName("Cd");
  write({vectors});
  EXPECT_TRUE(contains(refusal_of(), "no grid can be a density"));
  write({cube_grid("density", 8, 0, 0.0f)});
  EXPECT_TRUE(contains(refusal_of(), "0 everywhere"));
}

TEST_F(ViewOfGrid, ReadsNegativeNoiseAsNothingAndSaysSo) {
  auto grid = cube_grid("density", 16, 2);
  grid->getAccessor().setValueOn(openvdb::Coord(-2), -0.01f);
  write({grid});
  EXPECT_TRUE(contains(view().text, "clamp_negative = true"));
  EXPECT_EQ(job_of().clamped_density_values, 1u);
}

TEST_F(ViewOfGrid, EndsABackgroundAtTheBoxOfTheVoxels) {
  auto grid = new_grid<openvdb::FloatGrid>();
  grid->tree().root().setBackground(2.0f, true);
  grid->setName("density");
  grid->fill(openvdb::CoordBBox(openvdb::Coord(0), openvdb::Coord(15)), 1.0f);
  write({grid});
  const RenderJob job = job_of();
  EXPECT_EQ(job.scene.shapes.size(), 2u);  // the floor, and the box
  EXPECT_EQ(job.scene.media.at(0).grid->density(Vec3(7.0f)), 1.0f);
  EXPECT_NEAR(job.scene.media.at(0).sigma_t.g * 15.0, 5.0, 0.01);  // from the first voxel's middle to the last one's
}

TEST_F(ViewOfGrid, MakesAFogOfALevelSet) {
  auto sphere = openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(1.0f, openvdb::Vec3f(0.0f), 0.05f);
  sphere->setName("ball");
  write({sphere});
  EXPECT_TRUE(contains(view().notes.at(0), "a level set, as a fog of density 1 inside"));
  const RenderJob job = job_of();
  EXPECT_FLOAT_EQ(job.scene.media.at(0).grid->density(Vec3(0.0f)), 1.0f);
}

/// How the numbers beside a density are read: kelvin, a flame, or neither.
TEST_F(ViewOfGrid, ShowsFireBesideADensity) {
  struct Case {
    std::vector<std::pair<std::string, float>> grids;
    std::string glows;
    double largest;  // K
  };
  for (const Case& c : {Case{{{"temperature", 1800.0f}, {"flame", 0.5f}}, "temperature", 1800.0},
                        Case{{{"Temperature", 1.5f}, {"flame", 0.5f}}, "flame", 2250.0},
                        Case{{{"heat", 20.0f}}, "heat", 2000.0}, Case{{{"flames", 3.0f}}, "flames", 2000.0}}) {
    openvdb::GridPtrVec all{cube_grid("density", 12, 2)};
    for (const auto& [name, value] : c.grids) all.push_back(cube_grid(name, 6, 2, value));
    write(all);
    const RenderJob job = job_of();
    const Medium& medium = job.scene.media.at(0);
    ASSERT_TRUE(medium.emits());
    EXPECT_NEAR(medium.emission->kelvin(double{medium.emission_grid->max_density()}), c.largest, 1e-3 * c.largest);
    EXPECT_TRUE(contains(view().text, "grid = \"" + c.glows + "\"")) << view().text;
    ASSERT_EQ(view().notes.size(), 2u);
    EXPECT_TRUE(contains(view().notes[1], "grid '" + c.glows + "' glows")) << view().notes[1];
  }
  write({cube_grid("density", 12, 2), cube_grid("velocity_x", 12, 2)});
  EXPECT_FALSE(job_of().scene.media.at(0).emits());
}

}  // namespace
}  // namespace vpm
