// The ladder of validation, climbed by the program: everything passes, the same on any number of threads.
#include <set>

#include "tools/vpm_binary.h"

namespace vpm {
namespace {

using Json = nlohmann::json;

class VpmValidate : public VpmBinary {
 protected:
  Json climb(const std::vector<std::string>& options) {
    std::vector<std::string> arguments{"validate", "--quick", "--seed", "1", "--json", "report.json"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    out_ = vpm_succeeds(arguments, 600.0).out;
    return report("report.json");
  }

  std::string out_;  // of the last climb
};

/// The checks of an experiment without their verdicts, which depend on how many there are in the run.
Json checks_of(const Json& run, const std::string& experiment) {
  Json found = Json::array();
  for (Json check : run["checks"]) {
    if (check["experiment"] != experiment) continue;
    check.erase("verdict");
    found.push_back(std::move(check));
  }
  return found;
}

// The levels of agreement and convergence are renders: VpmSameSeed has those.
TEST_F(VpmValidate, PassesAndIsTheSameOnAnyNumberOfThreads) {
  const Json all = climb({"--threads", "2"});
  EXPECT_EQ(all["failed"], 0);
  // Each level is told of when it is done, which is before the verdicts.
  size_t told = 0;
  for (const char level : {'0', '1', '2', '3', '4'}) {
    const size_t at = out_.find(std::string("level ") + level + " done: ");
    ASSERT_NE(at, std::string::npos) << level;
    EXPECT_GE(at, told);
    told = at;
  }
  EXPECT_LT(told, out_.find("Level 0: "));
  // Of each kind of work that threads share the least: draws, photons, maps.
  for (const std::string experiment :
       {"free flights, delta-local", "furnaces about surfaces", "half spaces", "point sources in endless media"}) {
    const Json on_one_thread = checks_of(climb({"--threads", "1", "--only", experiment}), experiment);
    EXPECT_FALSE(on_one_thread.empty());
    EXPECT_EQ(on_one_thread, checks_of(all, experiment));
  }
  vpm_refuses({"validate", "--only", "no such experiment"}, {"--only", "no such experiment"});

  std::set<std::string> names;
  for (const Json& check : all["checks"])
    names.insert(check["experiment"].get<std::string>() + ": " + check["name"].get<std::string>());
  EXPECT_GT(names.size(), 300u);
  EXPECT_EQ(names.size(), all["checks"].size()) << "two checks have one name";
}

}  // namespace
}  // namespace vpm
