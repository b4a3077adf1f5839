// The oracles' slabs as ours, and the comparison of what they reflect and transmit.
#pragma once

#include <algorithm>

#include "study/oracles.h"
#include "vpm/study/exact/slab.h"

namespace vpm::exact {

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
