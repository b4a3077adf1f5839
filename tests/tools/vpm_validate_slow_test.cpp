// The ladder of validation, climbed by the program: everything passes, the same on any number of threads.
#include <set>

#include "tools/vpm_binary.h"

namespace vpm {
namespace {

using Json = nlohmann::json;

class VpmValidate : public VpmBinary {
 protected:
  Json climb(const std::string& threads, const std::string& file) const {
    vpm_succeeds({"validate", "--quick", "--seed", "1", "--threads", threads, "--json", file}, 600.0);
    return report(file);
  }
};

TEST_F(VpmValidate, PassesAndIsTheSameOnAnyNumberOfThreads) {
  Json one = climb("1", "one.json"), two = climb("2", "two.json");
  EXPECT_EQ(one["failed"], 0);
  for (Json* run : {&one, &two}) {
    run->erase("seconds");
    run->erase("threads");
  }
  EXPECT_EQ(one, two);

  std::set<std::string> names;
  for (const Json& check : one["checks"])
    names.insert(check["experiment"].get<std::string>() + ": " + check["name"].get<std::string>());
  EXPECT_GT(names.size(), 300u);
  EXPECT_EQ(names.size(), one["checks"].size()) << "two checks have one name";
}

}  // namespace
}  // namespace vpm
