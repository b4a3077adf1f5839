// The ladder of validation, climbed by the program: everything passes, the same on any number of threads.
#include <set>

#include "tools/vpm_binary.h"

namespace vpm {
namespace {

using Json = nlohmann::json;

class VpmValidate : public VpmBinary {
 protected:
  Json climb(const std::vector<std::string>& options) const {
    std::vector<std::string> arguments{"validate", "--quick", "--seed", "1", "--json", "report.json"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    vpm_succeeds(arguments, 600.0);
    return report("report.json");
  }
};

/// The checks of a level without their verdicts, which depend on how many there are in the run.
Json checks_of(const Json& run, int level) {
  Json found = Json::array();
  for (Json check : run["checks"]) {
    if (check["level"] != level) continue;
    check.erase("verdict");
    found.push_back(std::move(check));
  }
  return found;
}

// The levels of agreement and convergence are renders: VpmSameSeed has those.
TEST_F(VpmValidate, PassesAndIsTheSameOnAnyNumberOfThreads) {
  const Json all = climb({"--threads", "2"});
  EXPECT_EQ(all["failed"], 0);
  for (const int level : {0, 1, 2})
    EXPECT_EQ(checks_of(climb({"--threads", "1", "--level", std::to_string(level)}), level), checks_of(all, level));

  std::set<std::string> names;
  for (const Json& check : all["checks"])
    names.insert(check["experiment"].get<std::string>() + ": " + check["name"].get<std::string>());
  EXPECT_GT(names.size(), 300u);
  EXPECT_EQ(names.size(), all["checks"].size()) << "two checks have one name";
}

}  // namespace
}  // namespace vpm
