// The reference numbers in tests/oracles, which come from other programs than ours.
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "vpm/study/exact/phase_moments.h"

namespace vpm::exact {

/// The list of cases in tests/oracles/NAME.json.
inline nlohmann::json oracle_cases(const std::string& name) {
  std::ifstream file(std::string(VPM_SOURCE_DIR) + "/tests/oracles/" + name + ".json");
  EXPECT_TRUE(file) << "no oracle " << name;
  const nlohmann::json cases = nlohmann::json::parse(file).at("cases");
  EXPECT_FALSE(cases.empty());
  return cases;
}

inline PhaseMoments oracle_phase(const nlohmann::json& oracle) {
  const double g = oracle.at("g");
  return g == 0.0 ? isotropic_moments() : henyey_greenstein_moments(g);
}

/// Each of `ours` is within `tolerance` of the oracle's list.
inline void expect_all_near(const std::vector<double>& ours, const nlohmann::json& oracle, double tolerance) {
  ASSERT_EQ(ours.size(), oracle.size());
  for (size_t i = 0; i < ours.size(); ++i) EXPECT_NEAR(ours[i], oracle[i].get<double>(), tolerance) << "at " << i;
}

}  // namespace vpm::exact
