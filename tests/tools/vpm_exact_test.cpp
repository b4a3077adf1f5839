// vpm exact as its users meet it.
#include <gtest/gtest.h>

#include <cmath>

#include "tools/vpm_binary.h"

namespace vpm {
namespace {

class VpmExact : public VpmBinary {
 protected:
  nlohmann::json solve(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "exact");
    arguments.emplace_back("--json");
    return nlohmann::json::parse(vpm_succeeds(arguments).out);
  }
  static nlohmann::json quantity(const nlohmann::json& report, const std::string& name) {
    for (const auto& entry : report.at("quantities"))
      if (entry.at("name") == name) return entry;
    ADD_FAILURE() << "no quantity " << name << " in " << report;
    return {};
  }
  static void expect(const nlohmann::json& report, const std::string& name, double truth) {
    const nlohmann::json entry = quantity(report, name);
    const double error = entry.at("errors")[0];
    EXPECT_NEAR(entry.at("values")[0], truth, error) << name;
    EXPECT_LT(error, 1e-9 * std::abs(truth)) << name;
  }
};

TEST_F(VpmExact, ListsProblemsWithTheirKeys) {
  const std::string text = vpm_succeeds({"exact"}).out;
  for (const char* word : {"slab:", "half-space:", "point-source:", "airlight:", "transmittance:", "sphere:", "tau",
                           "albedo", "distances", "profile", "[required]"})
    EXPECT_NE(text.find(word), std::string::npos) << word;
}

// Mostly pure absorbers, whose closed forms take a line.
TEST_F(VpmExact, SolvesEachProblem) {
  const nlohmann::json slab = solve({"slab", "tau=2", "albedo=0", "incidence=collimated", "depths=0.5,2", "mus=1",
                                     "mu_edges=0,0.5,1", "phase=rayleigh"});
  EXPECT_EQ(slab.at("problem"), "slab");
  EXPECT_EQ(slab.at("arguments").at("tau"), "2");
  expect(slab, "transmitted", std::exp(-2.0));
  expect(slab, "fluence", std::exp(-0.5));
  EXPECT_EQ(quantity(slab, "fluence").at("places"), nlohmann::json({0.5, 2.0}));
  EXPECT_EQ(quantity(slab, "reflected flux").at("values").size(), 2u);

  expect(solve({"half-space", "albedo=0", "depths=3"}), "net flux", std::exp(-3.0));
  const nlohmann::json source = solve({"point-source", "distances=0.25", "sigma_t=2", "power=3", "albedo=0"});
  expect(source, "fluence", 3.0 * std::exp(-0.5) / (4.0 * M_PI * 0.0625));
  expect(source, "collisions within", 1.0 - std::exp(-0.5));
  const nlohmann::json airlight = solve({"airlight", "distance=1", "intensity=5"});  // case S3-26 of tests/oracles
  EXPECT_NEAR(quantity(airlight, "radiance").at("values")[0], 5.0 * 0.01538272010935302, 1e-13);
  expect(solve({"sphere", "radius=1", "albedo=0", "impacts=0"}), "image radiance", std::exp(-2.0));
}

TEST_F(VpmExact, SolvesEveryProfile) {
  const auto through = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "transmittance");
    return solve(arguments);
  };
  expect(through({"sigma_t=3", "length=0.5"}), "optical thickness", 1.5);
  expect(through({"profile=ramp", "sigma_t=1", "end=3", "length=2"}), "optical thickness", 4.0);
  expect(through({"profile=exponential", "rate=2"}), "optical thickness", 0.5 * (1.0 - std::exp(-2.0)));
  expect(through({"profile=gaussian", "width=0.5"}), "optical thickness",
         0.5 * std::sqrt(M_PI / 2.0) * std::erf(std::sqrt(2.0)));
  expect(through({"profile=layers", "ends=1,3", "values=2,0.5"}), "optical thickness", 3.0);
  expect(through({"profile=voxel", "corners=0,0,0,0,0,0,0,1", "sigma_t=4"}), "optical thickness", std::sqrt(3.0));
  const nlohmann::json quantiles = quantity(through({"sigma_t=1", "u=0.5,0.9"}), "flight quantile").at("values");
  EXPECT_NEAR(quantiles[0], std::log(2.0), 1e-15);
  EXPECT_TRUE(quantiles[1].is_null());
}

TEST_F(VpmExact, PrintsForPeople) {
  const std::string text = vpm_succeeds({"exact", "slab", "tau=2", "albedo=0.9", "g=0.75", "depths=1"}).out;
  for (const char* word : {"slab tau=2 albedo=0.9", "reflected", "0.0973946", "+-", "optical depth 1 "})
    EXPECT_NE(text.find(word), std::string::npos) << word << "\n" << text;
  EXPECT_NE(vpm_succeeds({"exact", "transmittance", "u=0.9"}).out.find("none"), std::string::npos);
}

TEST_F(VpmExact, RefusesWhatItCannotSolve) {
  vpm_refuses({"exact", "cube"}, {"no problem cube", "slab", "half-space", "sphere"});
  vpm_refuses({"exact", "slab"}, {"tau", "missing", "albedo"});
  vpm_refuses({"exact", "slab", "tau=1", "thickness=2"}, {"no key thickness", "tau", "mu_edges"});
  vpm_refuses({"exact", "slab", "tau=1", "g=-0.999"}, {"peak is too narrow"});
  vpm_refuses({"exact", "slab", "tau=1", "phase=droplets", "g=0.5"}, {"g"});
  vpm_refuses({"exact", "slab", "tau"}, {"key=value"});
  vpm_refuses({"exact", "slab", "tau="}, {"key=value"});
  vpm_refuses({"exact", "slab", "tau=1", "tau=2"}, {"tau", "twice"});
  vpm_refuses({"exact", "slab", "tau=1", "phase=isotropic", "g=0.5"}, {"g means nothing"});
  vpm_refuses({"exact", "half-space", "mu_edges=0.5,0.2"}, {"mu_edges", "ascend"});
  vpm_refuses({"exact", "transmittance", "profile=layers", "ends=1,2", "values=1"}, {"values"});
  vpm_refuses({"exact", "transmittance", "profile=voxel", "corners=1,2"}, {"corners", "8"});
  vpm_refuses({"exact", "transmittance", "profile=ramp", "width=2"}, {"width means nothing"});
  vpm_refuses({"exact", "airlight", "distance=1", "t0=2", "t1=1"}, {"t1 is 1", "above 2"});
}

TEST_F(VpmExact, RefusesNumbersOutOfRange) {
  for (const char* bad : {"tau=0", "tau=-1", "tau=inf", "tau=nan", "tau=1e", "tau=1,2"})
    vpm_refuses({"exact", "slab", bad}, {"tau is", "above 0"});
  vpm_refuses({"exact", "slab", "tau=1", "albedo=1.01"}, {"albedo is 1.01", "from 0 to 1"});
  vpm_refuses({"exact", "slab", "tau=1", "g=1"}, {"g is 1", "from -0.999 to 0.999"});
  vpm_refuses({"exact", "airlight", "distance=1", "g=1"}, {"g is 1", "above -1 and below 1"});
  vpm_refuses({"exact", "slab", "tau=1", "depths=0,1.5"}, {"depths is 1.5", "from 0 to 1"});
  vpm_refuses({"exact", "slab", "tau=1", "mus=0"}, {"mus is 0", "above 0"});
  vpm_refuses({"exact", "half-space", "depths=inf"}, {"depths is inf"});
  vpm_refuses({"exact", "sphere", "radius=1", "radii=2"}, {"radii is 2"});
  vpm_refuses({"exact", "point-source", "distances=0"}, {"distances is 0"});
  vpm_refuses({"exact", "transmittance", "u=1"}, {"u is 1"});
}

}  // namespace
}  // namespace vpm
