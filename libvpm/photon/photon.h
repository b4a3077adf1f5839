// The photon record, and directions in four bytes.
#pragma once

#include <cstdint>

#include "base/vec.h"

namespace vpm {

/// A unit vector in four bytes: octahedral coordinates of 16 bits each [Cigolle2014]; off by at most 7e-5 rad.
class PackedDirection {
 public:
  PackedDirection() = default;
  explicit PackedDirection(const Vec3& d) {
    const float scale = 1.0f / (std::abs(d.x) + std::abs(d.y) + std::abs(d.z));
    Vec2 p(d.x * scale, d.y * scale);
    if (d.z < 0.0f) p = fold(p);
    u_ = static_cast<int16_t>(std::lround(p.x * kSteps));
    v_ = static_cast<int16_t>(std::lround(p.y * kSteps));
  }
  /// The direction, unit.
  Vec3 unpack() const {
    Vec2 p(static_cast<float>(u_) / kSteps, static_cast<float>(v_) / kSteps);
    const float z = 1.0f - std::abs(p.x) - std::abs(p.y);
    if (z < 0.0f) p = fold(p);
    return glm::normalize(Vec3(p.x, p.y, z));
  }

 private:
  static constexpr float kSteps = 32767.0f;
  /// Maps the octahedron's lower half to the square's corners, and back.
  static Vec2 fold(const Vec2& p) {
    return {std::copysign(1.0f - std::abs(p.y), p.x), std::copysign(1.0f - std::abs(p.x), p.y)};
  }

  int16_t u_ = 0, v_ = 0;
};

/// The two ways to use the volumetric radiance estimate in a heterogeneous medium: with the density where the ray is,
/// or where the photon is. They agree as the radius goes to 0.
enum class VolumeForm { density_at_query, density_at_photon };

/// A photon as a map stores it.
struct Photon {
  Vec3 position{0.0f};     // m
  PackedDirection travel;  // direction of travel when it arrived
  Rgb power{0.0f};         // W; or W over the density as a share of the medium's largest, see VolumeForm
};

static_assert(sizeof(Photon) == 28);

/// A place on a surface that a photon found, seen from the side on which it arrived.
struct SurfaceSite {
  Vec3 position{0.0f};             // m
  PackedDirection normal;          // geometric, to that side
  PackedDirection shading_normal;  // the same, for shading
};

}  // namespace vpm
