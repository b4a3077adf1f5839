// The lobes of rough materials: what their values and densities say, by quadrature, against drawn directions.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "vpm/study/validate/ladder.h"
#include "vpm/surface/material/material.h"

namespace vpm {

/// A path along `travel` that meets a rough surface of normal `normal`.
struct RoughIncidence {
  Material material;
  Vec3 normal{0.0f}, travel{0.0f};  // unit
};

/// Cells of directions: on the near side rings and sectors about the mirror's direction, on the far side about Snell's.
/// Rings widen in proportion to 1 - cos, so that both narrow lobes and wide ones fill several.
class LobeCells {
 public:
  explicit LobeCells(const RoughIncidence& incidence);

  size_t count() const;
  size_t cell_of(const Vec3& direction) const;

  /// Integrals of scatter_value(), right to kError.
  struct Integrals {
    std::vector<double> pdf;       // over each cell; what is absorbed is missing from their sum
    double near = 0.0, far = 0.0;  // of the value's green channel: flux to either side over what arrives
  };
  Integrals integrate() const;
  static constexpr double kError = 3e-4;

 private:
  RoughIncidence incidence_;
  double width_;  // 1 - cos of the innermost rings
  Vec3 near_axis_, far_axis_;
};

/// Is `direction` on the side of the surface from which the path does not come?
bool on_far_side(const RoughIncidence& incidence, const Vec3& direction);

/// `count` drawn directions against the density, in cells fitted to the lobes, and their weights against the integrals
/// of the value; and that light goes the way back as well.
std::vector<Check> check_lobes(const std::string& name, const RoughIncidence& in, uint64_t count, const Effort& effort);

}  // namespace vpm
