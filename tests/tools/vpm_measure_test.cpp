// What vpm measure prints and writes, and slices of fields. What detectors count, tests/python/measure_test.py says.
#include <nlohmann/json.hpp>

#include "tools/vpm_binary.h"

namespace vpm {
namespace {

constexpr const char* kSlab = R"(
[camera]
position = [0, 5, 0]
target = [0, 0, 0.1]
[media.mist]
type = "homogeneous"
sigma_t = 2
albedo = 0.9
[[shapes]]
type = "box"
material = { type = "boundary" }
min = [-100, 0, -100]
max = [100, 1, 100]
inside = "mist"
[[lights]]
type = "beam"
position = [0, 2, 0]
direction = [0, -1, 0]
radius = 0.01
power = 1
[[detectors]]
name = "top"
type = "plane"
point = [0, 1, 0]
normal = [0, 1, 0]
angles = 2
[integrator.photons]
emitted = 1_000
)";

class VpmMeasure : public VpmBinary {
 protected:
  void SetUp() override { write("slab.toml", kSlab); }
};

TEST_F(VpmMeasure, PrintsSharesBesideExactOnes) {
  const std::string said = vpm_succeeds({"measure", "slab.toml", "--passes", "4"}).out;
  EXPECT_NE(said.find("4 passes, 4000 photons\n  top\n    forward "), std::string::npos) << said;
  EXPECT_NE(said.find("    backward  1 +- 0 W, 4000 photons\n"), std::string::npos) << said;
  for (const char* share : {"  reflected    0.", "  transmitted  0.", "  absorbed     0."})
    EXPECT_NE(said.find(share), std::string::npos) << said;
  EXPECT_EQ(vpm_succeeds({"measure", "slab.toml", "--passes", "4", "--threads", "3"}).out, said);
}

TEST_F(VpmMeasure, WritesJsonAndAPage) {
  const std::string printed = vpm_succeeds({"measure", "slab.toml", "--json", "-o", "a.json", "--passes", "2"}).out;
  EXPECT_EQ(read("a.json"), printed);
  const auto json = nlohmann::json::parse(printed);
  EXPECT_EQ(json["photons"], 2000);
  const auto& forward = json["detectors"][0]["forward"];
  ASSERT_EQ(forward["parts"].size(), 2u);
  EXPECT_EQ(forward["parts"][0]["cosines"], nlohmann::json({0.5, 1.0}));
  EXPECT_EQ(forward["parts"][0]["count"].get<int>() + forward["parts"][1]["count"].get<int>(), forward["count"]);
  EXPECT_NEAR(json["slab"]["reflected"]["share"][0].get<double>(), forward["power_W"][0].get<double>(), 1e-12);
  vpm_succeeds({"measure", "slab.toml", "-o", "a.html", "--passes", "1"});
  const std::string page = read("a.html");
  EXPECT_NE(page.find("\"standard_error_W\":[null,null,null]"), std::string::npos);
  EXPECT_EQ(page.find("http"), page.find("http-equiv")) << "nothing is fetched";
}

TEST_F(VpmMeasure, WrongWishesAreRefused) {
  vpm_refuses({"measure", "slab.toml", "-o", "a.csv"}, {"a.csv: measurements are written as .json"});
  vpm_refuses({"measure", "slab.toml", "--time", "1", "--passes", "2"}, {"--time"});
  vpm_refuses({"measure", "slab.toml", "--checkpoint"}, {"--checkpoint"});
  vpm_refuses({"measure", "slab.toml", "--set", "integrator.distance.type=local-extinction"},
              {"do not end as the transmittance"});
  vpm_refuses({"measure", "slab.toml", "--set", "integrator.distance.type=progressive-null"},
              {"of another law in each"});
  vpm_refuses({"measure", "slab.toml", "--set", "detectors.0.radius=1"}, {"radius"});
  vpm_refuses({"render", "slab.toml", "--set", "world.cyclic=[\"x\"]"}, {"makes no picture", "vpm measure"});
}

TEST_F(VpmMeasure, FieldsBecomeGridsAndDrawings) {
  vpm_succeeds({"fluence", "slab.toml", "-o", "a.vdb", "--box", "-1", "0", "-1", "1", "1", "1", "--resolution", "8",
                "--flux", "--time", "0.2"});
  const std::string listed = vpm_succeeds({"info", "a.vdb"}).out;
  for (const char* grid :
       {"grid fluence: float", "grid absorbed_error: float", "grid flux: vec3s", "voxel size (0.25, 0.25, 0.25)"})
    EXPECT_NE(listed.find(grid), std::string::npos) << listed;
  vpm_succeeds({"fluence", "slab.toml", "-o", "c.vdb", "--resolution", "8", "--passes", "1", "--set",
                "media.mist.sigma_t=[1, 2, 3]"});
  EXPECT_NE(vpm_succeeds({"info", "c.vdb"}).out.find("grid absorbed_b: float"), std::string::npos);
  EXPECT_EQ(vpm_succeeds({"view", "a.vdb", "--grid", "absorbed", "--slice", "z=0.1"}).out, "a.svg\n");
  const std::string drawing = read("a.svg");
  for (const char* part : {"absorbed of a.vdb, z = 0.1 m", "W/m^3</text>", "data:image/png;base64,", "x = -1 m"})
    EXPECT_NE(drawing.find(part), std::string::npos) << part;
  vpm_refuses({"view", "a.vdb", "--grid", "absorbed", "--slice", "z=2"}, {"the grid goes from -1 to 1 m"});
  vpm_succeeds({"view", "a.vdb", "--grid", "fluence", "--slice", "z=1"});  // a face belongs to the grid
  vpm_refuses({"view", "a.vdb", "--slice", "y", "--exposure", "1"}, {"--exposure"});
  vpm_refuses({"view", "a.vdb", "--slice", "w"}, {"w is no slice"});
  vpm_refuses({"view", "a.vdb", "--grid", "flux", "--slice", "z"}, {"flux", "vec3s"});
}

}  // namespace
}  // namespace vpm
