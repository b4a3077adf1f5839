// Integrals over the lobes of rough materials, and draws from them.
#include "vpm/study/validate/scenes/lobes.h"

#include <algorithm>

#include "vpm/base/warp.h"
#include "vpm/study/sample_moments.h"
#include "vpm/study/validate/scenes/directions.h"

namespace vpm {

namespace {

constexpr size_t kLobeRings = 16, kLobeCells = kLobeRings * kSectors;  // on a side
constexpr int kPoints = 48;                                            // in a cell, both ways

/// The scale of the material's narrowest lobe, as an angle squared.
double narrowest(const Material& material) {
  if (const auto* m = std::get_if<RoughConductor>(&material)) return 0.25 * m->roughness * m->roughness;
  if (const auto* m = std::get_if<Phong>(&material)) return 0.25 / (m->exponent + 1.0);
  if (const auto* m = std::get_if<RoughDielectric>(&material))
    return 0.25 * std::pow(m->roughness * std::min(1.0f, std::fabs(m->ior - 1.0f)), 2);
  return 1.0;
}

/// Where a smooth dielectric would refract to; beyond the critical angle along the surface.
Vec3 refracted(const RoughIncidence& incidence) {
  const auto* rough = std::get_if<RoughDielectric>(&incidence.material);
  if (!rough) return incidence.travel;
  const Scatter smooth =
      sample_scatter(Dielectric{rough->ior}, incidence.normal, incidence.travel, std::nextafter(1.0f, 0.0f), {});
  if (smooth.transmitted) return smooth.direction;
  return glm::normalize(incidence.travel - glm::dot(incidence.travel, incidence.normal) * incidence.normal);
}

}  // namespace

LobeCells::LobeCells(const RoughIncidence& incidence)
    : incidence_(incidence),
      width_(narrowest(incidence.material)),
      near_axis_(glm::reflect(incidence.travel, incidence.normal)),
      far_axis_(refracted(incidence)) {}

size_t LobeCells::count() const { return 2 * kLobeCells; }

size_t LobeCells::cell_of(const Vec3& direction) const {
  const bool far = on_far_side(incidence_, direction);
  const Vec3& axis = far ? far_axis_ : near_axis_;
  const double ring = std::log1p(away_from(axis, direction) / width_) / std::log1p(2.0 / width_);
  return (far ? kLobeCells : 0) + vpm::cell_of(ring, kLobeRings) * kSectors + sector_about(axis, direction);
}

/// A midpoint rule in each cell, whose edges are those of the rule's azimuths, too; what lies beyond the horizon
/// belongs to the other side.
LobeCells::Integrals LobeCells::integrate() const {
  Integrals result{std::vector<double>(count(), 0.0)};
  const double span = std::log1p(2.0 / width_), rings = kLobeRings * kPoints, turns = kSectors * kPoints;
  for (const bool far : {false, true}) {
    if (far && !scatters_through(incidence_.material)) continue;
    for (double i = 0.5; i < rings; i += 1.0)
      for (double j = 0.5; j < turns; j += 1.0) {
        const double away = width_ * std::expm1(span * i / rings), turn = 2.0 * kPiD * j / turns;
        const Vec3 direction =
            direction_about(far ? far_axis_ : near_axis_, static_cast<float>(away), static_cast<float>(turn));
        if (on_far_side(incidence_, direction) != far) continue;
        const ScatterValue v = scatter_value(incidence_.material, incidence_.normal, incidence_.travel, direction);
        const double solid_angle = (away + width_) * span / rings * 2.0 * kPiD / turns;
        result.pdf[cell_of(direction)] += v.pdf * solid_angle;
        (far ? result.far : result.near) += v.value.g * solid_angle;
      }
  }
  return result;
}

bool on_far_side(const RoughIncidence& incidence, const Vec3& direction) {
  return (glm::dot(incidence.normal, direction) < 0.0f) == (glm::dot(incidence.normal, incidence.travel) < 0.0f);
}

namespace {

/// Relative difference between a rough material's BSDF over the square of the index where it scatters to, and that of
/// the way back: 0 by reciprocity.
double one_way_excess(const RoughIncidence& in, const Vec3& direction) {
  const ScatterValue there = scatter_value(in.material, in.normal, in.travel, direction);
  const ScatterValue back = scatter_value(in.material, in.normal, -direction, -in.travel);
  const double one = double{there.value.g} * there.radiance_scale / std::fabs(glm::dot(in.normal, direction));
  const double other = double{back.value.g} / std::fabs(glm::dot(in.normal, in.travel));
  return std::fabs(one - other) / (one + other);
}

}  // namespace

std::vector<Check> check_lobes(const std::string& name, const RoughIncidence& in, uint64_t count,
                               const Effort& effort) {
  const LobeCells cells(in);
  const LobeCells::Integrals exact = cells.integrate();
  const size_t n = cells.count();
  enum { kNear, kFar, kAbsorbed, kReciprocity, kOthers };
  const auto samples = sample_moments(n + kOthers, count, effort.seed_of(name), [&](Rng& rng, double* out) {
    const Scatter s = sample_scatter(in.material, in.normal, in.travel, rng.uniform(), rng.uniform2());
    const bool gone = is_black(s.weight);
    out[n + kAbsorbed] = gone;
    if (gone) return;
    out[cells.cell_of(s.direction)] = 1.0;
    out[n + (s.transmitted ? kFar : kNear)] = s.weight.g;
    out[n + kReciprocity] = one_way_excess(in, s.direction);
  });
  double scattered = 0.0;
  for (const double p : exact.pdf) scattered += p;
  // The last cell holds those of which the quadrature knows little but that they are rare.
  std::vector<double> counts(n + 1, 0.0), probabilities(n + 1, 0.0);
  for (size_t i = 0; i < n; ++i) {
    const size_t cell = exact.pdf[i] < LobeCells::kError ? n : i;
    counts[cell] += std::round(samples[i].mean() * static_cast<double>(samples[i].count()));
    probabilities[cell] += exact.pdf[i] / scattered;
  }
  return {check_distribution(name + ", directions", counts, probabilities),
          check_mean(name + ", absorbed", samples[n + kAbsorbed], 1.0 - scattered, LobeCells::kError),
          check_mean(name + ", weight on the near side", samples[n + kNear], exact.near, LobeCells::kError),
          check_mean(name + ", weight on the far side", samples[n + kFar], exact.far, LobeCells::kError),
          check_bound(name + ", off reciprocity", samples[n + kReciprocity].mean(), 0.0, 1e-3)};
}

}  // namespace vpm
