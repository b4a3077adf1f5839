// The ranges of coefficients, and of what a phase function is made of.
#include "vpm/medium/check_medium.h"

#include "vpm/base/overloads.h"

namespace vpm {
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
