// Sampling of the phase functions.
#include "vpm/medium/phase/phase.h"

#include <utility>

#include "vpm/base/warp.h"

namespace vpm {

Vec3 Isotropic::sample(const Vec3&, const Vec2& u) const { return uniform_sphere(u); }

Vec3 HenyeyGreenstein::sample(const Vec3& travel, const Vec2& u) const {
  // Inversion of the cumulative distribution [Henyey1941]. With a = |g| and s = 1 - a + 2 a u, in a form that does not
  // cancel for a near 1 and needs no special case at a = 0: 1 - cos = 2 (1 - u) (1 + a u) ((1 - a) / s)^2.
  const float a = std::abs(g);
  const float ratio = (1.0f - a) / (1.0f - a + 2.0f * a * u.x);
  const float away = 2.0f * (1.0f - u.x) * (1.0f + a * u.x) * ratio * ratio;
  return direction_about(g < 0.0f ? -travel : travel, away, 2.0f * kPi * u.y);
}

Vec3 Rayleigh::sample(const Vec3& travel, const Vec2& u) const {
  // The cumulative distribution is a cubic, cos^3 + 3 cos + 4 - 8 u = 0, with one real root by Cardano's formula.
  const double q = 4.0 * u.x - 2.0;
  const double c = std::cbrt(q + std::sqrt(q * q + 1.0));
  return direction_about(travel, static_cast<float>(1.0 - c + 1.0 / c), 2.0f * kPi * u.y);
}

namespace {

/// Where a function that rises from below `target` at `lo` to above it at `hi` reaches it: Newton's method within a
/// bracket. value_and_slope(x) returns both.
template <class Function>
double invert(double lo, double hi, double x, double target, Function&& value_and_slope) {
  for (int step = 0; step < 100; ++step) {
    const auto [value, slope] = value_and_slope(x);
    (value > target ? hi : lo) = x;
    double next = x - (value - target) / slope;
    if (!(next > lo && next < hi)) next = 0.5 * (lo + hi);
    if (std::abs(next - x) <= 1e-15 * hi) return next;
    x = next;
  }
  return x;
}

/// 1 - cos to the peak of Draine's function with g = a > 0, by its cumulative distribution in t = (1 + a^2 - 2 a
/// cos)^(1/2): a polynomial in t and 1/t.
double away_by_root(double a, double alpha, double u) {
  const double b = 1.0 + a * a, q = alpha / (4.0 * a * a), least = 1.0 - a;
  const auto integral = [&](double t) { return t * (q * t * t / 3.0 - 2.0 * q * b) - (1.0 + q * b * b) / t; };
  const double scale = (1.0 - a * a) / (2.0 * a * (1.0 + alpha * (1.0 + 2.0 * a * a) / 3.0)), begin = integral(least);
  const auto value_and_slope = [&](double t) {
    const double cosine = (b - t * t) / (2.0 * a);
    return std::pair(scale * (integral(t) - begin), scale * (1.0 + alpha * cosine * cosine) / (t * t));
  };
  const double without = least / (1.0 - 2.0 * a * u / (1.0 + a));  // were alpha 0
  const double t = invert(least, 1.0 + a, without, u, value_and_slope);
  return (t - least) * (t + least) / (2.0 * a);
}

/// The same for small a, where that form cancels: by the function's first Legendre polynomials.
double away_by_series(double a, double alpha, double u) {
  const std::array<double, 4> of_a{1.0 - 2.5 * a * a, 3.0 * a - 10.5 * a * a * a, 7.5 * a * a, 17.5 * a * a * a};
  std::array<double, 6> terms{};  // of the density, by powers of the cosine
  for (size_t k = 0; k < 4; ++k) {
    terms[k] += of_a[k];
    terms[k + 2] += alpha * of_a[k];
  }
  const double total = 2.0 * (1.0 + alpha * (1.0 + 2.0 * a * a) / 3.0);
  // From the peak downwards, so that what is inverted rises with `away`.
  const auto value_and_slope = [&](double away) {
    const double cosine = 1.0 - away;
    double below = 0.0, density = 0.0, power = 1.0;
    for (size_t k = 0; k < 6; ++k, power *= cosine) {
      density += terms[k] * power;
      below += terms[k] * (1.0 - power * cosine) / static_cast<double>(k + 1);
    }
    return std::pair(below / total, density / total);
  };
  return invert(0.0, 2.0, 2.0 * u, u, value_and_slope);
}

}  // namespace

Vec3 Draine::sample(const Vec3& travel, const Vec2& u) const {
  constexpr double kSmall = 0.01;  // the series leaves out 9 a^4
  const double a = std::abs(double{g}), share = double{u.x};
  const double away = a < kSmall ? away_by_series(a, alpha, share) : away_by_root(a, alpha, share);
  return direction_about(g < 0.0f ? -travel : travel, static_cast<float>(std::clamp(away, 0.0, 2.0)), 2.0f * kPi * u.y);
}

Vec3 Tabulated::sample(const Vec3& travel, const Vec2& u) const {
  return direction_about(travel, static_cast<float>(table->away_within(double{u.x})), 2.0f * kPi * u.y);
}

void Droplets::fit() {
  // The fits of [Jendersie2023] to Mie's solution for water.
  const double d = diameter;
  a.g = static_cast<float>(std::exp(-0.0990567 / (d - 1.67154)));
  b.g = static_cast<float>(std::exp(-2.20679 / (d + 3.91029) - 0.428934));
  b.alpha = static_cast<float>(std::exp(3.62489 - 8.29288 / (d + 5.52825)));
  first = static_cast<float>(1.0 - std::exp(-0.599085 / (d - 0.641583) - 0.665888));
}

float phase_value(const Phase& phase, float cosine) {
  return std::visit([&](const auto& p) { return p.value(cosine); }, phase);
}
float phase_value(const Phase& phase, const Vec3& before, const Vec3& after) {
  return std::visit([&](const auto& p) { return p.value(before, after); }, phase);
}
Vec3 phase_sample(const Phase& phase, const Vec3& travel, const Vec2& u) {
  return std::visit([&](const auto& p) { return p.sample(travel, u); }, phase);
}

}  // namespace vpm
