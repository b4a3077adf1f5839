// Phase functions: how a medium scatters. Each offers value, sample, mean cosine and mean square of the cosine, and
// says its name in scene files and its numbers; all are normalised over the sphere.
//
// Convention: `cosine` is the dot product of the directions of TRAVEL before and after scattering, so g > 0 is forward.
#pragma once

#include <array>
#include <string_view>
#include <variant>

#include "vpm/base/settings/range.h"
#include "vpm/base/vec.h"

namespace vpm {

/// A number of a phase function.
template <class Function>
struct PhaseNumber {
  std::string_view name;
  float Function::*member;
  Range range;
};

/// Scatters equally into all directions.
struct Isotropic {
  static constexpr std::string_view kName = "isotropic";
  static constexpr std::array<PhaseNumber<Isotropic>, 0> numbers() { return {}; }

  /// Density per solid angle, 1/sr, at a cosine.
  float value(float) const { return 1.0f / (4.0f * kPi); }
  /// The same from one direction of travel to the next (unit). Either may be a Floats3: many of them side by side.
  template <class Before, class After>
  auto value(const Before& before, const After& after) const {
    return decltype(before.x + after.x)(1.0f / (4.0f * kPi));
  }
  /// A direction of travel after scattering, distributed as value().
  Vec3 sample(const Vec3& travel, const Vec2& u) const;
  float mean_cosine() const { return 0.0f; }
  float mean_square_cosine() const { return 1.0f / 3.0f; }
};

/// The one-parameter phase function of [Henyey1941]; mean cosine g in (-1, 1).
struct HenyeyGreenstein {
  static constexpr std::string_view kName = "henyey-greenstein";
  static constexpr auto numbers() {
    return std::array{PhaseNumber<HenyeyGreenstein>{"g", &HenyeyGreenstein::g, {-1.0, 1.0, true, true}}};
  }

  float g = 0.0f;

  /// (1 - g^2) / (4 pi (1 + g^2 - 2 g cos)^1.5), 1/sr.
  float value(float cosine) const { return value_away(1.0f - (g < 0.0f ? -cosine : cosine)); }
  /// The same between unit vectors. 1 - cos is half the square of their difference, which keeps its digits where the
  /// cosine has lost them: the peak of g = 0.9999 is 1e-4 rad wide.
  template <class Before, class After>
  auto value(const Before& before, const After& after) const {
    const auto apart = g < 0.0f ? after + before : after - before;
    return value_away(0.5f * dot(apart, apart));
  }
  Vec3 sample(const Vec3& travel, const Vec2& u) const;
  float mean_cosine() const { return g; }
  float mean_square_cosine() const { return (1.0f + 2.0f * g * g) / 3.0f; }

 private:
  /// By `away` = 1 - sign(g) cos. The bracket is computed as (1 - |g|)^2 + 2 |g| away, because the printed form cancels
  /// for |g| near 1.
  template <class Real>
  Real value_away(const Real& away) const {
    using std::max, std::sqrt;
    const float a = std::abs(g);
    const Real b = (1.0f - a) * (1.0f - a) + 2.0f * a * max(Real(0.0f), away);
    return (1.0f - a) * (1.0f + a) / (4.0f * kPi * b * sqrt(b));
  }
};

/// Scattering by particles much smaller than the wavelength, unpolarised: 3 (1 + cos^2) / (16 pi).
struct Rayleigh {
  static constexpr std::string_view kName = "rayleigh";
  static constexpr std::array<PhaseNumber<Rayleigh>, 0> numbers() { return {}; }

  template <class Real>
  Real value(const Real& cosine) const {
    return 3.0f / (16.0f * kPi) * (1.0f + cosine * cosine);
  }
  template <class Before, class After>
  auto value(const Before& before, const After& after) const {
    return value(dot(before, after));
  }
  Vec3 sample(const Vec3& travel, const Vec2& u) const;
  float mean_cosine() const { return 0.0f; }
  float mean_square_cosine() const { return 0.4f; }
};

using Phase = std::variant<Isotropic, HenyeyGreenstein, Rayleigh>;
/// Calls visit() with each of these, its numbers being their defaults.
template <class Visit>
void for_each_phase(Visit&& visit) {
  [&]<class... Function>(const std::variant<Function...>*) { (visit(Function{}), ...); }(static_cast<Phase*>(nullptr));
}

/// Density per solid angle at `cosine`, 1/sr.
inline float phase_value(const Phase& phase, float cosine) {
  return std::visit([&](const auto& p) { return p.value(cosine); }, phase);
}
/// The same between directions of travel before and after, unit.
inline float phase_value(const Phase& phase, const Vec3& before, const Vec3& after) {
  return std::visit([&](const auto& p) { return p.value(before, after); }, phase);
}
/// A direction of travel after scattering from `travel`; its density is phase_value(), so no weight is due.
inline Vec3 phase_sample(const Phase& phase, const Vec3& travel, const Vec2& u) {
  return std::visit([&](const auto& p) { return p.sample(travel, u); }, phase);
}

}  // namespace vpm
