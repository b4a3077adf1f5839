// What the program itself reads beside scenes, reports and reference numbers: refused where it is damaged.
#include "tools/rendered_fog.h"

namespace vpm {
namespace {

using nlohmann::json;

using VpmReport = RenderedFog;

TEST_F(VpmReport, RefusesWhatIsNoReport) {
  vpm_refuses({"report", "none.json"}, {"none.json", "cannot be read"});
  vpm_refuses({"report", "fog.exr"}, {"fog.exr", ".json"});
  vpm_refuses({"report", "fog.json", "-o", "fog.exr"}, {"fog.exr", "must end in .html"});
  write("text.json", "{");
  vpm_refuses({"report", "text.json"}, {"text.json", "is not JSON"});
  for (const char* other : {"[]", "{}", "{\"program\": 3}", "{\"program\": \"pbrt 4\"}"}) {
    write("other.json", other);
    vpm_refuses({"report", "other.json"}, {"other.json", "is no report of vpm"});
  }
  json map = report("fog.json");
  map["light_map"] = json::object();
  write("map.json", map.dump());
  vpm_refuses({"report", "map.json"}, {"map.json", "light map"});
  json part = report("fog.json");
  part.erase("energy");
  write("part.json", part.dump());
  vpm_refuses({"report", "part.json"}, {"part.json", "has no 'energy'", "render again"});
  json damaged = report("fog.json");
  damaged["chosen"] = 3;
  write("fog.json", damaged.dump());
  vpm_refuses({"report", "fog.json"}, {"fog.json", "damaged"});
}

class VpmOracles : public VpmBinary {
 protected:
  /// Refuses a folder that holds one file.
  void refuses(const std::string& file, const std::string& text, const std::vector<std::string>& words) const {
    std::filesystem::remove_all(folder_ / "oracles");
    std::filesystem::create_directories(folder_ / "oracles");
    write("oracles/" + file, text);
    vpm_refuses({"validate", "--oracles", "oracles"}, words);
  }
};

TEST_F(VpmOracles, RefusesMalformedFiles) {
  vpm_refuses({"validate", "--oracles", "nowhere"}, {"nowhere", "folder"});
  vpm_refuses({"validate", "--oracles", ".", "--level", "2"}, {"--level"});
  refuses("README.md", "", {"oracles", "no .json"});
  refuses("s4_slab.json", R"({"cases": [{"id")", {"s4_slab.json", "no JSON"});
  refuses("s4_slab.json", R"({"definition": {}})", {"s4_slab.json", "no list of cases"});
  refuses("s4_slab.json", R"({"cases": [1, 2]})", {"s4_slab.json", "cases, number 0", "no object"});
  refuses("s4_slab.csv", "id,R\nhulst\n", {"s4_slab.csv", "row 1 has 1 cells"});
}

}  // namespace
}  // namespace vpm
