// Grids that the ranks of one machine share.
#include "vpm/ranks/machine_grids.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <future>
#include <system_error>

#include "ranks/machine_in_memory.h"
#include "vpm/medium/make_grid.h"

namespace vpm {
namespace {

Scene scene_of_two_clouds() {
  const auto cloud = [](const std::string& name, float density) {
    Medium medium =
        make_medium(make_grid(centred_frame(9, 0.1),
                              [=](int x, int, int z) { return density * static_cast<float>(x * x + z * z); }),
                    Rgb(1.0f));
    medium.name = name;
    return medium;
  };
  Scene scene;
  scene.media = {cloud("mist", 0.5f), make_medium(nullptr, Rgb(2.0f)), cloud("fog", 3.0f)};
  scene.media[1].name = "even";
  return scene;
}

constexpr Vec3 kPlace(0.31f, -0.22f, 0.17f);

/// How many mappings this process has of memory that is shared.
int mappings() {
  std::ifstream maps("/proc/self/maps");
  int count = 0;
  for (std::string line; std::getline(maps, line);) count += line.find("memfd:vpm") != std::string::npos;
  return count;
}

TEST(MachineGrids, AreThoseOfTheFirstRank) {
  Post post(3);
  MachineInMemory first(post, 0), second(post, 1), third(post, 2);
  const Scene own = scene_of_two_clouds();
  Scene scene = scene_of_two_clouds();
  share_grids(first, scene);
  EXPECT_FALSE(scene.media[1].grid);
  for (MachineInMemory* other : {&second, &third}) {
    const std::optional<GridsOfMedia> grids = shared_grids(*other);
    ASSERT_TRUE(grids);
    ASSERT_EQ(grids->size(), 2u);
    for (const int medium : {0, 2}) {
      const float density = own.media[medium].grid->density(kPlace);
      EXPECT_GT(density, 0.0f);
      EXPECT_EQ(scene.media[medium].grid->density(kPlace), density);
      EXPECT_EQ(grids->at(own.media[medium].name)->density(kPlace), density);
    }
  }
}

TEST(MachineGrids, AreNowhereElseAndStayAsLongAsOneIsLeft) {
  Post post(2);
  MachineInMemory first(post, 0), second(post, 1);
  Scene scene = scene_of_two_clouds();
  const std::weak_ptr<const DensityGrid> own = scene.media[0].grid;
  share_grids(first, scene);
  EXPECT_TRUE(own.expired());
  std::optional<GridsOfMedia> grids = shared_grids(second);
  EXPECT_EQ(mappings(), 2);
  const float density = scene.media[2].density(kPlace);
  scene = {};
  EXPECT_EQ(mappings(), 1);
  const std::shared_ptr<const DensityGrid> last = grids->at("fog");
  grids.reset();
  EXPECT_EQ(last->density(kPlace), density);
  EXPECT_EQ(mappings(), 1);
}

TEST(MachineGrids, OthersWaitForThem) {
  Post post(2);
  MachineInMemory first(post, 0), second(post, 1);
  auto waiting = std::async(std::launch::async, [&] { return shared_grids(second); });
  EXPECT_EQ(waiting.wait_for(std::chrono::milliseconds(50)), std::future_status::timeout);
  Scene scene = scene_of_two_clouds();
  share_grids(first, scene);
  EXPECT_EQ(waiting.get()->at("fog")->density(kPlace), scene.media[2].density(kPlace));
}

TEST(MachineGrids, AreNoneForAnotherProgramAndRefusedWhereTheyAreGone) {
  Post post(2);
  MachineInMemory first(post, 0), second(post, 1);
  first.tell("another program\n/proc/self/fd/0");
  EXPECT_FALSE(shared_grids(second));
  {
    Scene scene = scene_of_two_clouds();
    share_grids(first, scene);
  }
  EXPECT_THROW(shared_grids(second), std::system_error);
}

TEST(MachineGrids, StayWhereTheyAreWhereThereIsNoRoom) {
  Post post(2);
  MachineInMemory first(post, 0), second(post, 1);
  Scene scene = scene_of_two_clouds();
  const std::shared_ptr<const DensityGrid> mist = scene.media[0].grid, fog = scene.media[2].grid;
  rlimit usual{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &usual), 0);
  const auto before = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit little{1000, usual.rlim_max};
  setrlimit(RLIMIT_FSIZE, &little);
  EXPECT_THROW(share_grids(first, scene), std::system_error);
  setrlimit(RLIMIT_FSIZE, &usual);
  std::signal(SIGXFSZ, before);
  EXPECT_EQ(scene.media[0].grid, mist);
  EXPECT_EQ(scene.media[2].grid, fog);
  EXPECT_FALSE(shared_grids(second));
}

TEST(MachineGrids, MayBeOfASceneWithoutAny) {
  Post post(2);
  MachineInMemory first(post, 0), second(post, 1);
  Scene scene;
  scene.media = {make_medium(nullptr, Rgb(2.0f))};
  share_grids(first, scene);
  const std::optional<GridsOfMedia> grids = shared_grids(second);
  ASSERT_TRUE(grids);
  EXPECT_TRUE(grids->empty());
}

}  // namespace
}  // namespace vpm
