// Scattering by a guide, one event at a time.
#include "vpm/photon/guided_scatter.h"

#include <gtest/gtest.h>

#include "support/statistics.h"
#include "vpm/medium/make_grid.h"

namespace vpm {
namespace {

/// However wrong the guide.
TEST(GuidedScatter, MakesNoPhotonMuchHeavier) {
  DirectionGuide guide({Vec3(-1.0f), Vec3(1.0f)}, 1);
  guide.add_track({Vec3(0.0f), Vec3(0.0f, 0.0f, 1.0f)}, 1.0f, 1.0f);
  guide.finish();
  const Medium fog = make_medium(nullptr, Rgb(1.0f), 1.0f);
  Moments powers;
  for (uint64_t i = 0; i < 100'000; ++i) {
    Rng rng(1, rng_stream(RngUse::test, 50), i);
    PathState state{{Vec3(0.0f), Vec3(1.0f, 0.0f, 0.0f)}, 0, Rgb(1.0f)};
    ASSERT_TRUE(scatter_in_medium(guide, fog, state, rng));
    EXPECT_LE(state.throughput.g, 1.12f);
    powers.add(state.throughput.g);
  }
  expect_mean(powers, 1.0, 1e-6);
}

}  // namespace
}  // namespace vpm
