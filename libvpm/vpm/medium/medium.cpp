// Density integrals along rays, and the ranges of coefficients.
#include "vpm/medium/medium.h"

#include <cmath>

namespace vpm {

DensityIntegral density_integral(const Medium& medium, const Ray& ray, const Interval& interval) {
  DensityIntegral result;
  result.lookups = medium.visit_pieces(ray, interval, [&](const DensityPiece& piece) {
    result.value += piece.integral();
    return true;
  });
  return result;
}

namespace {

/// The first number that is out of its range.
template <class Function>
std::string problem_of_numbers(const Function& function) {
  for (const auto& number : function.numbers())
    if (!contains(number.range, function.*number.member))
      return "its " + std::string(number.name) + " must be " + text_of(number.range);
  return "";
}

}  // namespace

std::string problem_of(const Medium& medium) {
  if (!is_finite(medium.sigma_t)) return "its extinction coefficient must be finite";
  for (int c = 0; c < 3; ++c)
    if (!(medium.sigma_s[c] >= 0.0f && medium.sigma_s[c] <= medium.sigma_t[c]))
      return "its scattering coefficient must be at least 0 and at most the extinction coefficient";
  if (medium.emission) {
    const Rgb& colour = medium.emission->colour;
    if (!is_finite(colour) || std::min({colour.r, colour.g, colour.b}) < 0.0f || colour == Rgb(0.0f))
      return "its emission must be at least 0 and finite, and not 0 in all channels";
    if (!(medium.emission->scale >= 0.0 && std::isfinite(medium.emission->scale + medium.emission->offset)))
      return "the temperature of its emission must have a scale of at least 0, and a finite offset";
  }
  if (const auto* tabulated = std::get_if<Tabulated>(&medium.phase); tabulated && !tabulated->table)
    return "its phase function has no table";
  return std::visit([](const auto& function) { return problem_of_numbers(function); }, medium.phase);
}

}  // namespace vpm
