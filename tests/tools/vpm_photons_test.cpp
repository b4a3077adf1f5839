// Photons as files. What is in them, tests/python/photons_test.py says.
#include <filesystem>

#include "tools/vpm_binary.h"

namespace vpm {
namespace {

constexpr const char* kRoom = R"(
[camera]
position = [0, 0, 0.9]
target = [0, 0, 0]
[media.fog]
type = "homogeneous"
sigma_t = 0.9
albedo = 0.8
[[shapes]]
name = "room"
type = "box"
material = { type = "lambertian", reflectance = 0.5 }
min = [-1, -1, -1]
max = [1, 1, 1]
inside = "fog"
[[lights]]
type = "point"
position = [0, 0, 0]
intensity = 1
[integrator.photons]
emitted = 9_000
)";

class VpmPhotons : public VpmBinary {
 protected:
  void SetUp() override { write("room.toml", kRoom); }
};

TEST_F(VpmPhotons, AreTheSameOnAnyNumberOfThreads) {
  for (const char* name : {"a.ply", "a.csv"}) {
    vpm_succeeds({"photons", "room.toml", "-o", name, "--threads", "1"});
    const std::string one = read(name);
    const std::string said = vpm_succeeds({"photons", "room.toml", "-o", name, "--threads", "3"}).out;
    EXPECT_TRUE(read(name) == one);
    EXPECT_NE(said.find("of 9000 emitted\n  volume map, fog: "), std::string::npos) << said;
    EXPECT_NE(said.find("\n  surface map, room: "), std::string::npos) << said;
  }
  vpm_succeeds({"photons", "room.toml", "-o", "b.csv", "--pass", "1"});
  EXPECT_FALSE(read("b.csv") == read("a.csv"));
}

TEST_F(VpmPhotons, LeaveTheirPaths) {
  const std::string said = vpm_succeeds({"photons", "room.toml", "--paths"}).out;
  EXPECT_NE(said.find("room.ply: "), std::string::npos) << said;
  EXPECT_NE(said.find(" flights of 9000 photons"), std::string::npos) << said;
  EXPECT_NE(read("room.ply").find("element edge "), std::string::npos);
}

TEST_F(VpmPhotons, FillCells) {
  const std::vector<std::string> fluence{"fluence", "room.toml", "-o", "a.npy", "--resolution", "8", "--passes", "2"};
  const std::string said = vpm_succeeds(fluence).out;
  EXPECT_NE(said.find("a.npy: 8 x 8 x 8 cells of the box (-1, -1, -1) to (1, 1, 1) m, 2 passes\n"), std::string::npos)
      << said;
  EXPECT_EQ(read("a.npy").size(), 128u + 8 * 8 * 8 * 4 * 3 * 4);
  vpm_succeeds({"fluence", "room.toml", "-o", "b.npy", "--box", "0", "0", "0", "1", "0.5", "1", "--resolution", "4"});
  EXPECT_EQ(read("b.npy").size(), 128u + 4 * 2 * 4 * 4 * 3 * 4);
  vpm_refuses({"fluence", "room.toml", "-o", "a.txt"}, {"fields are written as .npy or .vdb"});
  vpm_refuses({"fluence", "room.toml", "--box", "0", "0", "0", "1", "0", "1"}, {"--box"});
  vpm_refuses({"fluence", "room.toml", "--resolution", "4096"}, {"cells take", "ask for fewer"});
  vpm_refuses({"fluence", "room.toml", "--set", "integrator.importance.importons=100"},
              {"would be guided to what the camera sees"});
}

TEST_F(VpmPhotons, WrongWishesAreRefused) {
  vpm_refuses({"photons", "room.toml", "-o", "a.obj"}, {"a.obj: photons are written as .ply or .csv"});
  vpm_refuses({"photons", "room.toml", "-o", "nowhere/a.ply"}, {"nowhere"});
  vpm_refuses({"photons", "room.toml", "--set", "integrator.type=path"},
              {"stores no photons in maps", "write type = \"photon-map\""});
  vpm_refuses({"photons", "room.toml", "--set", "integrator.photons.in_cube=4"}, {"sums of photons"});
  vpm_refuses({"photons", "room.toml", "--pass", "-1"}, {"--pass"});
}

}  // namespace
}  // namespace vpm
