// The reference numbers of tests/oracles, checked by the program.
#include "tools/vpm_binary.h"

namespace vpm {
namespace {

class VpmOracles : public VpmBinary {
 protected:
  const std::string oracles_ = std::string(VPM_SOURCE_DIR) + "/tests/oracles";
};

// Right code fails for 1 % of all seeds; the seed is fixed.
TEST_F(VpmOracles, TheFrameworkAgreesWithEveryReferenceNumber) {
  vpm_succeeds({"validate", "--oracles", oracles_, "--json", "report.json"}, 1100.0);
  const nlohmann::json run = report("report.json");
  EXPECT_EQ(run["failed"], 0);
  EXPECT_EQ(run["unchecked"], 0);
  EXPECT_GT(run["cases"], 100);
}

}  // namespace
}  // namespace vpm
