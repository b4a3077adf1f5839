// vpm validate --oracles with small folders: what it says it did not check, and that it sees wrong numbers.
#include "tools/vpm_binary.h"

namespace vpm {
namespace {

class VpmOracles : public VpmBinary {
 protected:
  /// A folder that holds one file.
  void oracle(const std::string& file, const std::string& text) const {
    std::filesystem::create_directories(folder_ / "oracles");
    write("oracles/" + file, text);
  }
  ProcessResult check() const { return vpm({"validate", "--oracles", "oracles", "--progress", "never"}); }
};

/// A slab whose reflectance [Hulst1980] is 0.09739, as cited in [Wang1995].
std::string slab(const std::string& r) {
  return R"({"cases": [{"id": "hulst", "g": 0.75, "albedo": 0.9, "tau": 2.0, "incidence": "collimated_normal", "R": )" +
         r + R"(, "T_total": 0.66096, "T_unscattered": 0.1353352832366127}]})";
}

TEST_F(VpmOracles, PassesRightNumbers) {
  oracle("s4_slab.json", slab("0.09739"));
  const ProcessResult result = check();
  EXPECT_EQ(result.status, 0) << result.out << result.err;
  EXPECT_NE(result.out.find("1 cases, 0 unchecked;"), std::string::npos) << result.out;
}

TEST_F(VpmOracles, SeesAWrongNumber) {
  oracle("s4_slab.json", slab("0.10739"));
  const ProcessResult result = check();
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.out.find("FAIL"), std::string::npos) << result.out;
}

TEST_F(VpmOracles, SeesAWrongNumberThatHasNoNoise) {
  oracle("s6_density.json", R"({"progressive": [{"id": "p", "dimension": 3, "alpha": 0.5714285714285714,
    "pass_index_1_based": 2, "measure_ratio": 0.79, "radius_ratio": 0.9226, "mean_inverse_measure": 1.13}]})");
  const ProcessResult result = check();
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.out.find("measure_ratio"), std::string::npos) << result.out;
}

/// A thousand photons on a line, by the kernel of order 4 of radius 0.1: its m2 is 5/2, V is 0.2.
TEST_F(VpmOracles, ChecksDensitiesOfPhotonsOnALine) {
  const auto line = [](const std::string& variance) {
    return R"({"fixed_radius": [{"id": "line", "dimension": 1, "kernel": "order-4", "N": 1000, "h": 0.1, "mean": 1.0,
      "variance_binomial": )" +
           variance + R"(, "expected_photons": 200.0}]})";
  };
  oracle("s6_density.json", line("0.0115"));
  const ProcessResult right = check();
  EXPECT_EQ(right.status, 0) << right.out << right.err;
  EXPECT_NE(right.out.find("1 cases, 0 unchecked;"), std::string::npos) << right.out;
  oracle("s6_density.json", line("0.012"));
  EXPECT_EQ(check().status, 1);
}

TEST_F(VpmOracles, ATableMustRepeatItsCases) {
  oracle("s4_slab.json", slab("0.09739"));
  write("oracles/s4_slab.csv", "id,g,albedo,tau,incidence,R\n\"hulst\",0.75,0.9,2.0,collimated_normal,0.09739\n");
  EXPECT_EQ(check().status, 0);
  write("oracles/s4_slab.csv", "id,g,albedo,tau,incidence,R\n\"hulst\",0.75,0.9,2.0,collimated_normal,0.09738\n");
  const ProcessResult result = check();
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.out.find("the first that does not: hulst"), std::string::npos) << result.out;
}

TEST_F(VpmOracles, ATableAloneIsChecked) {
  oracle("s4_slab.csv", "id,g,albedo,tau,incidence,R\n\"hulst\",0.75,0.9,2.0,collimated_normal,0.10739\n");
  EXPECT_EQ(check().status, 1);
}

TEST_F(VpmOracles, WhatItDoesNotKnowIsNotPassed) {
  for (const auto& [file, text, words] : {
           std::tuple("s99_rainbow.json", R"({"cases": [{"id": "bow"}]})", "no problem of this name is known"),
           std::tuple("s6_density.json", R"({"splats": [{"id": "bow"}]})", "no problem of this name is known"),
           std::tuple("s6_density.json", R"({"kernels": [{"dimension": 2, "kernel": "gaussian"}]})",
                      "the framework has no kernel"),
           std::tuple("s7_surface.json", R"({"irradiance": [{"id": "bow", "light": "laser", "receiver": [0, 0, 0]}]})",
                      "no light of the kind"),
           std::tuple("s1_flight.json",
                      R"({"cases": [{"id": "bow", "kind": "fractal", "params": {}, "L": 1.0, "quantiles": []}]})",
                      "no profile of the kind"),
       }) {
    std::filesystem::remove_all(folder_ / "oracles");
    oracle(file, text);
    const ProcessResult result = check();
    EXPECT_EQ(result.status, 1) << file;
    EXPECT_NE(result.out.find(std::string("unchecked: ") + words), std::string::npos) << result.out;
  }
}

/// A case whose values are none that the framework knows keeps no other from being checked.
TEST_F(VpmOracles, WhatACaseRefusesLeavesItAloneUnchecked) {
  const std::string good = slab("0.09739");
  for (const auto& [other, words] : {
           std::pair(R"({"id": "other", "R": "bright", "incidence": "diffuse", "tau": 1, "albedo": 1, "g": 0})",
                     "\"R\" is \"bright\", it must be a number"),
           std::pair(R"({"id": "other", "R": 0.1, "incidence": "diffuse", "tau": 1, "g": 0})", "\"albedo\" is missing"),
           std::pair(R"({"id": "other", "R": 0.1, "incidence": "diffuse", "tau": 1, "albedo": 1.5, "g": 0})",
                     "\"albedo\" is 1.5, it must be from 0 to 1"),
           std::pair(R"({"id": "other", "R": 0.1, "incidence": "grazing", "tau": 1, "albedo": 1, "g": 0})",
                     "\"incidence\" is \"grazing\""),
       }) {
    oracle("s4_slab.json", good.substr(0, good.size() - 2) + ", " + other + "]}");
    const ProcessResult result = check();
    EXPECT_EQ(result.status, 1) << other;
    EXPECT_NE(result.out.find("unchecked: "), std::string::npos) << result.out;
    EXPECT_NE(result.out.find(words), std::string::npos) << result.out;
    EXPECT_NE(result.out.find("2 cases, 1 unchecked;"), std::string::npos) << result.out;
  }
  oracle("s2_source.json",
         R"({"cases": [{"id": "narrow", "albedo": 0.9, "g": 0.9999, "r_optical": 1, "fluence": 1}]})");
  std::filesystem::remove(folder_ / "oracles" / "s4_slab.json");
  const ProcessResult result = check();
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.out.find("\"g\" is 0.9999"), std::string::npos) << result.out;
  std::filesystem::remove(folder_ / "oracles" / "s2_source.json");
  oracle("s7_surface.json", R"({"irradiance": [{"id": "lamp", "light": "point", "receiver": [0, null, 0]}]})");
  const std::string out = check().out;
  EXPECT_NE(out.find("\"receiver\" holds null, it must hold finite numbers"), std::string::npos) << out;
}

}  // namespace
}  // namespace vpm
