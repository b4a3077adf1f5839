// Phase functions: how a medium scatters. Each offers value, sample, mean cosine and mean square of the cosine, and
// says its name in scene files and its numbers; all are normalised over the sphere.
//
// Convention: `cosine` is the dot product of the directions of TRAVEL before and after scattering, so g > 0 is forward.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string_view>
#include <type_traits>
#include <variant>

#include "vpm/base/settings/range.h"
#include "vpm/base/vec.h"
#include "vpm/medium/phase/phase_table.h"

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

/// Henyey and Greenstein's function times 1 + alpha cos^2 [Draine2003]: alpha = 0 is that function, alpha = 1 with g =
/// 0 is Rayleigh's.
struct Draine {
  static constexpr std::string_view kName = "draine";
  static constexpr auto numbers() {
    return std::array{PhaseNumber<Draine>{"g", &Draine::g, {-1.0, 1.0, true, true}},
                      PhaseNumber<Draine>{"alpha", &Draine::alpha, {0.0, 1e4, false, false}}};
  }

  float g = 0.0f;      // in (-1, 1); the mean cosine is another
  float alpha = 0.0f;  // >= 0

  [[gnu::always_inline]] float value(float cosine) const { return HenyeyGreenstein{g}.value(cosine) * times(cosine); }
  template <class Before, class After>
  [[gnu::always_inline]] auto value(const Before& before, const After& after) const {
    return HenyeyGreenstein{g}.value(before, after) * times(dot(before, after));
  }
  Vec3 sample(const Vec3& travel, const Vec2& u) const;
  [[gnu::always_inline]] float mean_cosine() const {
    return g * (1.0f + alpha * (3.0f + 2.0f * g * g) / 5.0f) / total();
  }
  [[gnu::always_inline]] float mean_square_cosine() const {
    const float gg = g * g;
    return ((1.0f + 2.0f * gg) / 3.0f + alpha * (7.0f + 20.0f * gg + 8.0f * gg * gg) / 35.0f) / total();
  }

 private:
  /// The mean of 1 + alpha cos^2 over Henyey and Greenstein's function.
  [[gnu::always_inline]] float total() const { return 1.0f + alpha * (1.0f + 2.0f * g * g) / 3.0f; }
  template <class Real>
  [[gnu::always_inline]] Real times(const Real& cosine) const {
    return (1.0f / total()) * (1.0f + alpha * cosine * cosine);
  }
};

/// Two phase functions, of which the first scatters the share `first`.
template <class A, class B>
struct TwoPhases {
  A a{};
  B b{};
  float first = 0.5f;  // in [0, 1]

  [[gnu::always_inline]] float value(float cosine) const {
    return first * a.value(cosine) + (1.0f - first) * b.value(cosine);
  }
  template <class Before, class After>
  [[gnu::always_inline]] auto value(const Before& before, const After& after) const {
    return first * a.value(before, after) + (1.0f - first) * b.value(before, after);
  }
  /// What is left of the first number, once it has chosen, is one of its own.
  [[gnu::always_inline]] Vec3 sample(const Vec3& travel, const Vec2& u) const {
    return u.x < first ? a.sample(travel, {u.x / first, u.y})
                       : b.sample(travel, {std::min((u.x - first) / (1.0f - first), 0x1.fffffep-1f), u.y});
  }
  [[gnu::always_inline]] float mean_cosine() const {
    return first * a.mean_cosine() + (1.0f - first) * b.mean_cosine();
  }
  [[gnu::always_inline]] float mean_square_cosine() const {
    return first * a.mean_square_cosine() + (1.0f - first) * b.mean_square_cosine();
  }
};

/// Two lobes of Henyey and Greenstein: as of dust and tissue, forward and back.
struct TwoLobes : TwoPhases<HenyeyGreenstein, HenyeyGreenstein> {
  static constexpr std::string_view kName = "two-lobes";
  static constexpr auto numbers() {
    return std::array{PhaseNumber<TwoLobes>{"g1", &TwoLobes::g1, {-1.0, 1.0, true, true}},
                      PhaseNumber<TwoLobes>{"g2", &TwoLobes::g2, {-1.0, 1.0, true, true}},
                      PhaseNumber<TwoLobes>{"share", &TwoLobes::share, {0.0, 1.0, false, false}}};
  }

  TwoLobes() { fit(); }
  /// Of the first lobe's mean cosine and share, and the second's mean cosine.
  TwoLobes(float of_first, float of_second, float share_of_first) : g1(of_first), g2(of_second), share(share_of_first) {
    fit();
  }
  /// After these have changed.
  void fit() {
    a.g = g1;
    b.g = g2;
    first = share;
  }

  float g1 = 0.0f, g2 = 0.0f;  // mean cosines, in (-1, 1)
  float share = 0.5f;          // of what the first lobe scatters
};

/// Droplets of water in fog and clouds, by their diameter [Jendersie2023]: a narrow lobe of Henyey and Greenstein, and
/// one of Draine. Bows and glory are not in it.
struct Droplets : TwoPhases<HenyeyGreenstein, Draine> {
  static constexpr std::string_view kName = "droplets";
  static constexpr auto numbers() {
    return std::array{PhaseNumber<Droplets>{"diameter", &Droplets::diameter, {5.0, 50.0, false, false}}};
  }

  explicit Droplets(float of_diameter = 10.0f) : diameter(of_diameter) { fit(); }
  /// After the diameter has changed.
  void fit();

  float diameter;  // micrometres, 5 to 50
};

/// What a table says.
struct Tabulated {
  static constexpr std::string_view kName = "table";
  static constexpr std::array<PhaseNumber<Tabulated>, 0> numbers() { return {}; }

  std::shared_ptr<const PhaseTable> table{};  // not null where it is used

  [[gnu::always_inline]] float value(float cosine) const {
    return table->value(std::sqrt(std::max(0.0f, 0.5f - 0.5f * cosine)));
  }
  template <class Before, class After>
  [[gnu::always_inline]] auto value(const Before& before, const After& after) const {
    using std::sqrt;
    const auto apart = after - before;
    const auto s = sqrt(0.25f * dot(apart, apart));
    using Real = std::remove_const_t<decltype(s)>;
    if constexpr (std::is_same_v<Real, float>) {
      return table->value(s);
    } else {
      Real values;
      for (size_t lane = 0; lane < Real::kWidth * Real::kRegisters; ++lane) values.set(lane, table->value(s[lane]));
      return values;
    }
  }
  Vec3 sample(const Vec3& travel, const Vec2& u) const;
  [[gnu::always_inline]] float mean_cosine() const { return static_cast<float>(table->mean_cosine()); }
  [[gnu::always_inline]] float mean_square_cosine() const { return static_cast<float>(table->mean_square_cosine()); }
};

using Phase = std::variant<Isotropic, HenyeyGreenstein, Rayleigh, Draine, TwoLobes, Droplets, Tabulated>;
/// Calls visit() with each of these, its numbers being their defaults.
template <class Visit>
void for_each_phase(Visit&& visit) {
  [&]<class... Function>(const std::variant<Function...>*) { (visit(Function{}), ...); }(static_cast<Phase*>(nullptr));
}

/// Density per solid angle at `cosine`, 1/sr.
float phase_value(const Phase& phase, float cosine);
/// The same between directions of travel before and after, unit.
float phase_value(const Phase& phase, const Vec3& before, const Vec3& after);
/// A direction of travel after scattering from `travel`; its density is phase_value(), so no weight is due.
Vec3 phase_sample(const Phase& phase, const Vec3& travel, const Vec2& u);

}  // namespace vpm
