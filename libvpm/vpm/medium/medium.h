// A participating medium: coefficients per unit density, a density field and a phase function. It provides coefficients
// and bounds; tracking algorithms are elsewhere.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "vpm/base/vec.h"
#include "vpm/medium/emission.h"
#include "vpm/medium/grid/density_grid.h"
#include "vpm/medium/phase/phase.h"

namespace vpm {

/// The density at places of one ray, in any order. Computations that depend on the ray alone are done once. It refers
/// to the grid, which must live as long.
class DensityAlong {
 public:
  /// `grid` null: density 1.
  [[gnu::always_inline]] DensityAlong(const DensityGrid* grid, const Ray& ray) : grid_(grid) {
    if (grid) ray_ = grid->lattice_ray(ray);
  }
  /// The density at the distance t, m.
  [[gnu::always_inline]] float at(double t) const { return grid_ ? grid_->density(ray_, t) : 1.0f; }
  /// The densities at up to kAtOnce distances: t, t + step, ... (m). This is quicker than one by one.
  void at(double t, double step, std::span<float> densities) const {
    if (grid_)
      grid_->densities(ray_, t, step, densities);
    else
      std::fill(densities.begin(), densities.end(), 1.0f);
  }
  static constexpr size_t kAtOnce = DensityGrid::kAtOnce;

 private:
  const DensityGrid* grid_;
  DensityGrid::LatticeRay ray_{};
};

/// What a medium does to light at a place, at density 1.
struct MediumProperties {
  Rgb sigma_s{0.0f}, sigma_t{0.0f};  // 1/m; see Medium
  const Phase& phase;

  Rgb sigma_a() const { return sigma_t - sigma_s; }
  /// sigma_s / sigma_t per channel; 0 where sigma_t is 0.
  Rgb albedo() const {
    return {sigma_t.r > 0 ? sigma_s.r / sigma_t.r : 0.0f, sigma_t.g > 0 ? sigma_s.g / sigma_t.g : 0.0f,
            sigma_t.b > 0 ? sigma_s.b / sigma_t.b : 0.0f};
  }
};

struct Medium {
  std::string name;
  Rgb sigma_s{0.0f};  // scattering coefficient at density 1, 1/m
  Rgb sigma_t{0.0f};  // extinction coefficient at density 1, 1/m; >= sigma_s
  Phase phase;
  std::shared_ptr<const DensityGrid> grid;  // null: density 1 everywhere
  std::optional<MediumEmission> emission{};
  std::shared_ptr<const DensityGrid> emission_grid{};  // of its source; null: 1 everywhere

  /// Does the medium scatter light?
  bool scatters() const { return sigma_s != Rgb(0.0f); }
  bool emits() const { return emission.has_value(); }
  bool homogeneous() const { return grid == nullptr; }
  float density(const Vec3& p) const { return grid ? grid->density(p) : 1.0f; }
  [[gnu::always_inline]] DensityAlong density_along(const Ray& ray) const { return {grid.get(), ray}; }
  /// The mean density over the grid's support, empty voxels included.
  double mean_density() const { return grid ? grid->mean_density() : 1.0; }
  /// The same where the grid holds anything.
  double mean_of_stored() const { return grid ? grid->mean_of_stored() : 1.0; }
  float max_density() const { return grid ? grid->max_density() : 1.0f; }
  /// The largest extinction coefficient anywhere, 1/m.
  Rgb majorant() const { return sigma_t * max_density(); }
  /// The shortest distance between voxels, m; infinite in a homogeneous medium.
  float voxel_size() const { return grid ? grid->voxel_size() : kInfinity; }
  /// Of its grids.
  size_t memory_bytes() const {
    return (grid ? grid->memory_bytes() : 0) + (emission_grid ? emission_grid->memory_bytes() : 0);
  }
  /// The part of the interval in which the density may differ from zero.
  Interval clip(const Ray& ray, const Interval& interval) const { return grid ? grid->clip(ray, interval) : interval; }
  /// Those at a place of the world: what is asked at collisions. Grids hold densities alone, so that they are the same
  /// everywhere.
  MediumProperties properties(const Vec3& /*place*/) const { return {sigma_s, sigma_t, phase}; }
  Rgb albedo() const { return MediumProperties{sigma_s, sigma_t, phase}.albedo(); }
  bool grey() const { return is_grey(sigma_s) && is_grey(sigma_t); }  // by itself; see is_grey(Light) of its emission

  /// Calls visit(const DensityPiece&) along the ray until it returns false. Returns the number of look-ups.
  template <class Visit>
  uint32_t visit_pieces(const Ray& ray, const Interval& interval, Visit&& visit) const {
    if (grid) return grid->visit_pieces(ray, interval, visit);
    visit(DensityPiece{interval.t0, interval.t1, 1.0, 0.0, 0.0, 0.0});
    return 0;
  }
  /// Calls visit(const DensityStretch&) along the ray until it returns false. Returns the number of bricks whose bounds
  /// were read.
  template <class Visit>
  uint32_t visit_majorants(const Ray& ray, const Interval& interval, Visit&& visit) const {
    if (grid) return grid->visit_majorants(ray, interval, visit);
    visit(DensityStretch{interval.t0, interval.t1, 1.0f, 1.0f});
    return 0;
  }
  /// The same, but skips segments for which passes(length, max) is true.
  template <class Pass, class Visit>
  uint32_t visit_majorants(const Ray& ray, const Interval& interval, Pass&& passes, Visit&& visit) const {
    if (grid) return grid->visit_majorants(ray, interval, passes, visit);
    if (!passes(double{interval.t1} - interval.t0, 1.0f)) visit(DensityStretch{interval.t0, interval.t1, 1.0f, 1.0f});
    return 0;
  }
};

/// What the values of a grid are to its medium, and the member that holds it.
struct GridRole {
  std::string_view name;
  std::shared_ptr<const DensityGrid> Medium::*grid;
};
inline constexpr std::array kGridRoles{GridRole{"density", &Medium::grid},
                                       GridRole{"emission", &Medium::emission_grid}};

/// Names a grid of a scene: a medium has at most one of each role.
struct GridName {
  std::string medium;
  std::string role;  // of kGridRoles

  auto operator<=>(const GridName&) const = default;
};

/// The density integral along a segment of a ray, m, and the number of look-ups. Times sigma_t it is the optical depth.
struct DensityIntegral {
  double value = 0.0;
  uint32_t lookups = 0;
};
/// Exact for homogeneous, trilinear and nearest fields: regular tracking [Novak2018, sec. 4.1].
DensityIntegral density_integral(const Medium& medium, const Ray& ray, const Interval& interval);

/// exp(-sigma_t integral) per channel, with the density integral in m. It is 1 if sigma_t is 0, even if the integral is
/// infinite.
[[gnu::always_inline]] inline Rgb transmittance(const Medium& medium, double integral) {
  Rgb result(1.0f);
  for (int c = 0; c < 3; ++c) {
    if (c > 0 && medium.sigma_t[c] == medium.sigma_t[c - 1])
      result[c] = result[c - 1];  // most media are grey, and exponentials dear
    else if (medium.sigma_t[c] > 0.0f)
      result[c] = static_cast<float>(std::exp(-medium.sigma_t[c] * integral));
  }
  return result;
}

/// The first number of a medium that is out of its range, and that range, as a clause: "its g must be in (-1, 1)"; ""
/// where there is none. Of its grid nothing is asked.
std::string problem_of(const Medium& medium);

}  // namespace vpm
