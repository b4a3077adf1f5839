#include "vpm/study/exact/airlight.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "vpm/base/vec.h"
#include "vpm/study/exact/quadrature.h"

namespace vpm::exact {

// L = sigma_s I int p(cos) exp(-sigma_t (t + r)) / r^2 dt, r the distance from the source and cos = (closest - t) / r.
// The path beyond the closest point, l = t + r - closest, turns the exponent into a linear one: it is d tan(psi / 2)
// with cos = cos(psi), and dt / r^2 = dpsi / d [Sun2005]. With v = l / d, the integral is sigma_s I (1 - g^2) / (2 pi
// d) int exp(-sigma_t (closest + d v)) (1 + v^2)^(1/2) / ((1-g)^2 + (1+g)^2 v^2)^(3/2) dv. Its features lie at v = 1,
// (1-g)/(1+g) and 1/(sigma_t d), decades apart: it is done in x = log(v / v0).
AirlightSolution solve_airlight(const Airlight& a) {
  assert(a.sigma_t >= 0.0 && a.distance > 0.0 && a.t0 >= 0.0 && a.t1 > a.t0 && std::fabs(a.g) < 1.0);
  const auto beyond = [&](double t) {  // l, without cancellation
    const double s = t - a.closest, r = std::hypot(a.distance, s);
    return s >= 0.0 ? r + s : a.distance * a.distance / (r - s);
  };
  const double l0 = beyond(a.t0), v0 = l0 / a.distance;
  const double narrow = 1.0 - a.g, wide = 1.0 + a.g;
  const auto integrand = [&](double x) {
    const double v = v0 * std::exp(x), peak = narrow * narrow + wide * wide * v * v;
    return std::exp(-a.sigma_t * l0 * std::expm1(x)) * v * std::sqrt(1.0 + v * v) / (peak * std::sqrt(peak));
  };
  // Where the medium ends, or where what is left is below rounding: by extinction, or by distance.
  const double dark = std::log1p(745.0 / (a.sigma_t * l0));
  const double far = 45.0 + std::max(0.0, std::log(std::max(1.0, narrow / wide) / v0));
  const double end = std::isinf(a.t1) ? far : std::log(beyond(a.t1) / l0);
  const Bounded integral = integrate(integrand, 0.0, std::min({end, dark, far}));

  const double depth = a.sigma_t * (a.t0 + std::hypot(a.distance, a.t0 - a.closest));
  const double factor = a.albedo * a.sigma_t * narrow * wide / (2.0 * kPiD * a.distance);
  const double value = factor * integral.value * std::exp(-depth);
  const double relative = integral.error / integral.value + 1e-15 * (10.0 + depth);
  return {{value, value * relative}, std::log10(factor * integral.value) - depth / std::log(10.0)};
}

// At the distance t behind the axis, light has come flown + t cos and goes seen + t to the eye; the ray is in the beam
// for |t| < beam_radius / sin.
Bounded solve_beam_airlight(const BeamAirlight& a) {
  assert(a.sigma_t > 0.0 && std::fabs(a.cosine) < 1.0 && std::fabs(a.g) < 1.0);
  const double sine2 = (1.0 - a.cosine) * (1.0 + a.cosine), half = a.beam_radius / std::sqrt(sine2);
  const double rate = a.sigma_t * (1.0 + a.cosine), depth = a.sigma_t * (a.flown + a.seen);
  const double along = 2.0 * std::sinh(rate * half) / rate * std::exp(-depth);
  const double away = 1.0 + a.g * a.g + 2.0 * a.g * a.cosine;  // light is scattered by the angle of cosine -cos
  const double phase = (1.0 - a.g) * (1.0 + a.g) / (4.0 * kPiD * away * std::sqrt(away));
  const double value = a.albedo * a.sigma_t * phase * along;
  return {value, value * 1e-15 * (10.0 + depth + rate * half + 1.0 / sine2 + 3.0 / away)};
}

}  // namespace vpm::exact
