// Paths from the eye that go on to both sides of smooth glass, and not to one that is drawn.
#pragma once

#include <cstddef>
#include <optional>

#include "vpm/base/rng.h"
#include "vpm/surface/geometry.h"
#include "vpm/surface/material/material.h"

namespace vpm {

/// Both sides are followed where the weaker one has at least this part of the path's start. The parts of all branches
/// together are at most 1, so there are at most 256 of them.
inline constexpr float kLeastBranch = 0x1p-8f;
/// The most branches that wait at a time. The stronger side waits while the weaker one is followed, which has at most
/// half of what there was: that happens eight times at the most.
inline constexpr size_t kMostWaiting = 8;

/// What a path meets at smooth glass.
struct BothSides {
  Scatter back, beyond;
  float reflected = 0.0f;  // the fraction of the light that goes back, in (0, 1)

  bool mostly_beyond() const { return reflected < 0.5f; }
};
/// Both sides, of a path that has `part` of its start; nothing where the weaker side is not worth it, or at no glass.
std::optional<BothSides> both_sides(const Material& material, const Hit& hit, const Vec3& travel, float part);

/// A side that gets a smaller fraction of the light than a half asks estimators, which take nearly all of the time and
/// whose results vary little, only with a probability: that fraction over a half. Returns the weight of what they find;
/// 0: they are not asked. Lamps, which make the noise, are seen on all sides.
float asks_with(float fraction, Rng& rng);

}  // namespace vpm
