#include "vpm/study/exact/sphere.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "vpm/base/vec.h"
#include "vpm/study/exact/ordinates.h"
#include "vpm/study/exact/quadrature.h"
#include "vpm/study/exact/special_functions.h"

namespace vpm::exact {

namespace {

/// u(r) = r fluence(r), continued as an odd function, satisfies the equation of a slab [-R, R] [Case1953]. Uniform
/// radiance 1 around the sphere becomes radiance R + mu entering the slab at R, and its negative at -R: then u = 4 pi
/// r, I = r - mu, is the solution without absorption. u is a sum of sinh(k r) / sinh(k R).
struct RadialModes {
  double radius, albedo;
  std::vector<double> k, amplitude;
};

RadialModes solve_modes(int count, double radius, double albedo) {
  const Ordinates ordinates = make_ordinates(count);
  const Modes modes = make_modes(albedo, isotropic_moments(), ordinates);
  std::vector<double> incoming;
  for (const double mu : ordinates.mu) incoming.push_back(radius + mu);
  const LayerField field = illuminate_antisymmetric(modes, 2.0 * radius, incoming);
  const std::vector<double> share = mode_fluence(modes);
  RadialModes radial{radius, albedo, modes.k, {}};
  for (size_t m = 0; m < share.size(); ++m) radial.amplitude.push_back(share[m] * field.odd[m]);
  return radial;
}

/// sinh(k r) / (r sinh(k R)).
double radial_shape(double k, double radius, double r) {
  if (k * radius == 0.0) return 1.0 / radius;
  const double scale = std::exp(-k * (radius - r)) / std::expm1(-2.0 * k * radius);
  return r == 0.0 ? -2.0 * k * scale : scale * std::expm1(-2.0 * k * r) / r;
}

double radial_fluence(const RadialModes& modes, double r) {
  double sum = 0.0;
  for (size_t m = 0; m < modes.k.size(); ++m) sum += modes.amplitude[m] * radial_shape(modes.k[m], modes.radius, r);
  return sum;
}

/// (1 - albedo) int fluence dV over the power 4 pi^2 R^2 that enters.
double absorbed_fraction(const RadialModes& modes) {
  const double radius = modes.radius;
  double integral = 0.0;  // int_0^R r u dr
  for (size_t m = 0; m < modes.k.size(); ++m) {
    const double k = modes.k[m];
    const double mode = k == 0.0 ? radius * radius / 3.0 : coth_excess(k * radius) / (k * k);
    integral += modes.amplitude[m] * mode;
  }
  return (1.0 - modes.albedo) * integral / (kPiD * radius * radius);
}

/// The environment through the chord, and what is scattered along it.
Bounded image_radiance(const RadialModes& modes, double impact) {
  const double half = modes.radius * std::sqrt((1.0 - impact) * (1.0 + impact));  // of the chord
  const double closest = impact * modes.radius;
  const auto source = [&](double s) {
    const double r = std::min(std::hypot(closest, s), modes.radius);
    return radial_fluence(modes, r) * (std::exp(s - half) + std::exp(-s - half));
  };
  constexpr double kDark = 745.0;  // exp(-kDark) underflows
  const Bounded scattered = integrate(source, std::max(0.0, half - kDark), half);
  const double factor = modes.albedo / (4.0 * kPiD);
  return {std::exp(-2.0 * half) + factor * scattered.value, factor * scattered.error};
}

}  // namespace

SphereSolution solve_sphere(double optical_radius, double albedo, const std::vector<double>& radii,
                            const std::vector<double>& impacts) {
  assert(optical_radius > 0.0 && albedo >= 0.0 && albedo <= 1.0);
  constexpr int kFine = 96, kCoarse = 72;
  constexpr double kRounding = 1e-13;  // of fractions; of fluence 4 pi times as much
  constexpr double kCaution = 4.0;     // errors oscillate with the number of ordinates
  const RadialModes fine = solve_modes(kFine, optical_radius, albedo);
  const RadialModes coarse = solve_modes(kCoarse, optical_radius, albedo);
  const auto difference = [&](double a, double b) { return kCaution * std::fabs(a - b) + kRounding; };

  SphereSolution solution;
  const double absorbed = absorbed_fraction(fine);
  solution.absorbed = {absorbed, difference(absorbed, absorbed_fraction(coarse))};
  solution.escaping = {1.0 - absorbed, solution.absorbed.error};
  solution.uncollided = 2.0 * exponential_moment(2.0, optical_radius) / (optical_radius * optical_radius);
  for (const double x : radii) {
    const double value = radial_fluence(fine, x * optical_radius);
    const double error = difference(value, radial_fluence(coarse, x * optical_radius)) + 4.0 * kPiD * kRounding;
    solution.fluence.values.push_back(value);
    solution.fluence.error = std::max(solution.fluence.error, error);
  }
  for (const double x : impacts) {
    const Bounded value = image_radiance(fine, x);
    const double error = difference(value.value, image_radiance(coarse, x).value) + value.error;
    solution.image.values.push_back(value.value);
    solution.image.error = std::max(solution.image.error, error);
  }
  return solution;
}

}  // namespace vpm::exact
