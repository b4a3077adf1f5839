// The path tracer in slabs: radiance that leaves them, and fluence inside.
#include <fmt/format.h>

#include "vpm/study/estimates/slab_radiance.h"
#include "vpm/study/exact/slab.h"
#include "vpm/study/validate/groups.h"

namespace vpm {
namespace {

struct RadianceProblem {
  double tau, albedo, g;
};

std::vector<Check> radiances(const Effort& effort) {
  static constexpr RadianceProblem kProblems[] = {{4.0, 0.9, 0.0}, {2.0, 0.9, 0.75}};
  const std::vector<double> mus{0.1, 0.5, 1.0}, depths{0.125, 0.5, 1.0};  // over the thickness
  std::vector<SlabExit> exits;
  for (const bool below : {false, true})
    for (const double mu : mus) exits.push_back({mu, below});
  std::vector<Check> checks;
  for (const RadianceProblem& p : kProblems) {
    exact::SlabPlaces places{{}, mus, {}};
    for (const double depth : depths) places.depths.push_back(depth * p.tau);
    const exact::SlabSolution s =
        exact::solve_slab({p.tau, p.albedo, exact::henyey_greenstein_moments(p.g), {}}, places);
    const std::string name = fmt::format("tau {}, albedo {}, g {}", p.tau, p.albedo, p.g);
    const SlabRadiances e =
        estimate_slab_radiance(homogeneous_slab(p.tau, p.albedo, p.g, Incidence::collimated), exits, depths,
                               effort.count(10'000, 600'000), effort.seed_of("radiance " + name));
    for (size_t i = 0; i < exits.size(); ++i) {
      const size_t m = i % mus.size();
      const double radiance = exits[i].below ? s.transmitted_radiance.values[m] : s.reflected_radiance.values[m];
      checks.push_back(
          check_mean(fmt::format("{}: {} radiance, mu {}", name, exits[i].below ? "transmitted" : "reflected", mus[m]),
                     e.exits[i], radiance));
    }
    for (size_t i = 0; i < depths.size(); ++i)
      checks.push_back(check_mean(fmt::format("{}: fluence of scattered light at {} of the depth", name, depths[i]),
                                  e.fluences[i], s.fluence.values[i] - s.uncollided_fluence[i]));
  }
  return checks;
}

}  // namespace

std::vector<Experiment> slab_radiance_experiments() {
  return {{2, "radiance of slabs, by the path tracer", radiances}};
}

}  // namespace vpm
