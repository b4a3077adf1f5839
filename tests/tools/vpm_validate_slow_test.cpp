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
}

TEST_F(VpmValidate, EveryCheckHasANameOfItsOwn) {
  vpm_succeeds({"validate", "--level", "0", "--json", "0.json"}, 300.0);
  vpm_succeeds({"validate", "--level", "1", "--json", "1.json"}, 300.0);
  std::set<std::string> names;
  size_t count = 0;
  for (const char* file : {"0.json", "1.json"})
    for (const Json& check : report(file)["checks"]) {
      names.insert(check["experiment"].get<std::string>() + ": " + check["name"].get<std::string>());
      ++count;
    }
  EXPECT_GT(count, 150u);
  EXPECT_EQ(names.size(), count);
}

}  // namespace
}  // namespace vpm
