// The plan of estimators: light that two of them find is refused, and photons are stored along flights where they may.
#include "vpm/integrators/photon_map/plan.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "support/scenes.h"

namespace vpm {
namespace {

/// Finds what it is told to.
class Finds final : public VolumeEstimator {
 public:
  explicit Finds(const ScatteredLight& light) : light_(light) {}
  ScatteredLight finds() const override { return light_; }
  KernelEstimate along(const EyeSegment&, EyeWork&) const override { return {}; }

 private:
  ScatteredLight light_;
};

TEST(Plan, RefusesToCountLightTwice) {
  const ScatteredLight once{.once = true}, more{.more = true}, all{true, true};
  const auto apart = [](const std::vector<ScatteredLight>& lights) {
    std::vector<std::unique_ptr<VolumeEstimator>> estimators;
    for (const ScatteredLight& light : lights) estimators.push_back(std::make_unique<Finds>(light));
    check_apart(estimators);
  };
  EXPECT_NO_THROW(apart({once, more}));
  EXPECT_NO_THROW(apart({all}));
  EXPECT_THROW(apart({once, all}), std::logic_error);
  EXPECT_THROW(apart({more, once, more}), std::logic_error);
}

TEST(Plan, StoresPhotonsAlongFlightsThatAreDrawnByTheMedium) {
  const auto grid = make_grid(centered_frame(4, 0.25), [](int x, int y, int z) { return lattice_noise(x, y, z); });
  const Scene cloud = boxed_medium(make_medium(grid, Rgb(1.0f)), PointLight{});
  const Scene fog = boxed_medium(make_medium(nullptr, Rgb(1.0f)), PointLight{});
  const auto along_flights = [](const Scene& scene, const RenderSettings& settings) {
    return plan_estimators(scene, settings, 0).recorders().at(0)->needs().flights;
  };
  RenderSettings settings;
  for (const StrategyInfo& info : distance_strategies()) {
    settings.distance.strategy = info.name;
    EXPECT_EQ(along_flights(cloud, settings), info.bounded_weight) << info.name;
    EXPECT_FALSE(along_flights(fog, settings)) << info.name;
  }
  settings = {};
  settings.volume.form = VolumeForm::density_at_photon;
  EXPECT_FALSE(along_flights(cloud, settings));
  settings = {};
  settings.volume.density_floor = 0.0f;
  EXPECT_FALSE(along_flights(cloud, settings));
}

}  // namespace
}  // namespace vpm
