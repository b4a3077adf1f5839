// The plan of estimators: light that two of them find is refused.
#include "vpm/render/plan.h"

#include <gtest/gtest.h>

#include <stdexcept>

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

}  // namespace
}  // namespace vpm
