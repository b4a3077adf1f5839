// Slabs of strong forward scattering against reference numbers.
#include <gtest/gtest.h>

#include "study/oracles.h"

namespace vpm::exact {
namespace {

TEST(ExactSlab, ForwardScatteringReflectsAndTransmitsAsTheOracleSays) {
  int compared = 0;
  for (const auto& oracle : oracle_cases("s4_slab_RT")) {
    if (oracle.at("g") < 0.9) continue;
    expect_slab_oracle(oracle);
    ++compared;
  }
  EXPECT_EQ(compared, 60);
}

}  // namespace
}  // namespace vpm::exact
