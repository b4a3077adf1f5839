// Grids that the ranks of one machine share.
#include "vpm/ranks/machine_grids.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <chrono>
#include <csignal>
#include <cstdint>
#include <fstream>
#include <future>
#include <sstream>
#include <system_error>

#include "ranks/ranks_in_memory.h"
#include "vpm/base/error.h"
#include "vpm/medium/grid/make_grid.h"

namespace vpm {
namespace {

Scene scene_of_two_clouds() {
  const auto cloud = [](const std::string& name, float density) {
    Medium medium =
        make_medium(make_grid(centered_frame(9, 0.1),
                              [=](int x, int, int z) { return density * static_cast<float>(x * x + z * z); }),
                    Rgb(1.0f));
    medium.name = name;
    return medium;
  };
  Scene scene;
  scene.media = {cloud("mist", 0.5f), make_medium(nullptr, Rgb(2.0f)), cloud("", 3.0f)};
  scene.media[1].name = "even";
  return scene;
}

constexpr Vec3 kPlace(0.31f, -0.22f, 0.17f);

/// How many bytes of shared memory this process has mapped. The system may split a mapping.
uint64_t mapped() {
  std::ifstream maps("/proc/self/maps");
  uint64_t bytes = 0;
  for (std::string line; std::getline(maps, line);) {
    if (line.find("memfd:vpm") == std::string::npos) continue;
    uint64_t from = 0, to = 0;
    char dash = 0;
    std::istringstream(line) >> std::hex >> from >> dash >> to;
    bytes += to - from;
  }
  return bytes;
}

TEST(MachineGrids, AreThoseOfTheFirstRank) {
  Post post(3);
  RankInMemory first(post, 0), second(post, 1), third(post, 2);
  const Scene own = scene_of_two_clouds();
  Scene scene = scene_of_two_clouds();
  EXPECT_FALSE(share_grids(first, scene));  // no error
  EXPECT_FALSE(scene.media[1].grid);
  for (RankInMemory* other : {&second, &third}) {
    const std::optional<GridsOfScene> grids = shared_grids(*other);
    ASSERT_TRUE(grids);
    ASSERT_EQ(grids->size(), 2u);
    for (const int medium : {0, 2}) {
      const float density = own.media[medium].grid->density(kPlace);
      EXPECT_GT(density, 0.0f);
      EXPECT_EQ(scene.media[medium].grid->density(kPlace), density);
      EXPECT_EQ(grids->at({own.media[medium].name, "density"})->density(kPlace), density);
    }
  }
}

TEST(MachineGrids, AreNowhereElseAndStayAsLongAsOneIsLeft) {
  Post post(2);
  RankInMemory first(post, 0), second(post, 1);
  Scene scene = scene_of_two_clouds();
  const std::weak_ptr<const DensityGrid> own = scene.media[0].grid;
  share_grids(first, scene);
  EXPECT_TRUE(own.expired());
  const uint64_t once = mapped();
  EXPECT_GE(once, scene.media[0].grid->memory_bytes() - sizeof(DensityGrid));
  std::optional<GridsOfScene> grids = shared_grids(second);
  EXPECT_EQ(mapped(), 2 * once);
  const float density = scene.media[2].density(kPlace);
  scene = {};
  EXPECT_EQ(mapped(), once);
  const std::shared_ptr<const DensityGrid> last = grids->at({"", "density"});
  grids.reset();
  EXPECT_EQ(last->density(kPlace), density);
  EXPECT_EQ(mapped(), once);
}

TEST(MachineGrids, OthersWaitForThem) {
  Post post(2);
  RankInMemory first(post, 0), second(post, 1);
  auto waiting = std::async(std::launch::async, [&] { return shared_grids(second); });
  EXPECT_EQ(waiting.wait_for(std::chrono::milliseconds(50)), std::future_status::timeout);
  Scene scene = scene_of_two_clouds();
  share_grids(first, scene);
  EXPECT_EQ(waiting.get()->at({"", "density"})->density(kPlace), scene.media[2].density(kPlace));
}

TEST(MachineGrids, OfAnotherProgramAreRefused) {
  Post post(2);
  RankInMemory first(post, 0), second(post, 1);
  first.send(1, "another vpm\n/proc/self/fd/0#1");
  EXPECT_THROW(shared_grids(second), InputError);
}

TEST(MachineGrids, ThatAreGoneAreRefused) {
  Post post(2);
  RankInMemory first(post, 0), second(post, 1);
  {
    Scene scene = scene_of_two_clouds();
    share_grids(first, scene);
  }
  EXPECT_THROW(shared_grids(second), std::system_error);
}

TEST(MachineGrids, StayWhereTheyAreWhereTheSystemRefusesTheMemory) {
  Post post(2);
  RankInMemory first(post, 0), second(post, 1);
  Scene scene = scene_of_two_clouds();
  const std::shared_ptr<const DensityGrid> mist = scene.media[0].grid, fog = scene.media[2].grid;
  rlimit usual{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &usual), 0);
  const auto before = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit little{1000, usual.rlim_max};
  setrlimit(RLIMIT_FSIZE, &little);
  const std::error_code why = share_grids(first, scene);
  setrlimit(RLIMIT_FSIZE, &usual);
  std::signal(SIGXFSZ, before);
  EXPECT_EQ(why, std::errc::file_too_large);
  EXPECT_EQ(scene.media[0].grid, mist);
  EXPECT_EQ(scene.media[2].grid, fog);
  EXPECT_FALSE(shared_grids(second));
}

TEST(MachineGrids, MayBeOfASceneWithoutAny) {
  Post post(2);
  RankInMemory first(post, 0), second(post, 1);
  Scene scene;
  scene.media = {make_medium(nullptr, Rgb(2.0f))};
  share_grids(first, scene);
  const std::optional<GridsOfScene> grids = shared_grids(second);
  ASSERT_TRUE(grids);
  EXPECT_TRUE(grids->empty());
}

}  // namespace
}  // namespace vpm
