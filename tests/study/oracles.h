// The reference numbers in tests/oracles, which come from other programs than ours; its slabs as ours, and the
// comparison of what they reflect and transmit.
#pragma once

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

#include "vpm/study/exact/phase_moments.h"
#include "vpm/study/exact/slab.h"

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

inline Slab slab_of(const nlohmann::json& oracle) {
  const bool diffuse = oracle.at("incidence") == "diffuse";
  return {oracle.at("tau"), oracle.at("albedo"), oracle_phase(oracle),
          diffuse ? Incidence::diffuse : Incidence::collimated_normal};
}

inline void expect_slab_oracle(const nlohmann::json& oracle) {
  SCOPED_TRACE(oracle.at("id"));
  const SlabSolution ours = solve_slab(slab_of(oracle));
  // Its errors of R and T are estimates: at albedo 1, its R + T shows that either can be as large as the other's.
  const double error = std::max(oracle.at("abs_err_R").get<double>(), oracle.at("abs_err_T").get<double>());
  EXPECT_NEAR(ours.reflected.value, oracle.at("R"), error + ours.reflected.error);
  EXPECT_NEAR(ours.transmitted.value, oracle.at("T_total"), error + ours.transmitted.error);
  EXPECT_NEAR(ours.unscattered, oracle.at("T_unscattered"), 2e-15);
  EXPECT_LT(ours.reflected.error, 3e-11);
  EXPECT_LT(ours.transmitted.error, 3e-11);
}

}  // namespace vpm::exact
