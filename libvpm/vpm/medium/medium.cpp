// Density integrals along rays, and the ranges of coefficients.
#include "vpm/medium/medium.h"
#include "vpm/base/overloads.h"

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

std::string problem_of(const Phase& phase) {
  return std::visit(Overloads{[](const Isotropic&) { return std::string(); },
                              [](const HenyeyGreenstein& p) {
                                return std::string(std::abs(p.g) < 1.0f ? "" : "its g must lie between -1 and 1");
                              },
                              [](const Rayleigh&) { return std::string(); }},
                    phase);
}

}  // namespace

std::string problem_of(const Medium& medium) {
  if (!is_finite(medium.sigma_t)) return "its extinction coefficient must be finite";
  for (int c = 0; c < 3; ++c)
    if (!(medium.sigma_s[c] >= 0.0f && medium.sigma_s[c] <= medium.sigma_t[c]))
      return "its scattering coefficient must be at least 0 and at most the extinction coefficient";
  return problem_of(medium.phase);
}

}  // namespace vpm
