// Photons through slabs and half spaces: how many come back, go through, are absorbed, and where.
#include <fmt/format.h>
#include <algorithm>

#include "vpm/study/careful_settings.h"
#include "vpm/study/estimates/slab.h"
#include "vpm/study/exact/slab.h"
#include "vpm/study/validate/groups.h"

namespace vpm {
namespace {

struct SlabProblem {
  double tau, albedo, g;
  Incidence incidence;
};

exact::Slab exact_slab(const SlabProblem& p) {
  return {p.tau, p.albedo, exact::henyey_greenstein_moments(p.g),
          p.incidence == Incidence::diffuse ? exact::Incidence::diffuse : exact::Incidence::collimated_normal};
}

std::string title(const SlabProblem& p) {
  return fmt::format("tau {}, albedo {}, g {}, {}", p.tau, p.albedo, p.g,
                     p.incidence == Incidence::diffuse ? "diffuse" : "collimated");
}

/// Enough for a standard error below 0.05 % of the incident power, or as many as quick mode has time for.
uint64_t photon_count(const Effort& effort, double collisions) {
  const auto quick = static_cast<uint64_t>(std::clamp(1e6 / (2.0 + collisions), 1e4, 1e5));
  return effort.count(quick, 1'200'000);
}
/// Collisions of a photon, roughly.
double collisions_of(const SlabProblem& p) { return std::min(1.0 / (1.0 - p.albedo + 1e-12), 2.5 * p.tau + 1.0); }

const std::vector<double> kMuEdges{0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0};

/// The directions in which light leaves, together with what does not leave: every photon is in one cell.
Check check_ends(const std::string& name, const SlabEstimate& e, const exact::SlabSolution& s) {
  std::vector<double> counts, probabilities;
  const auto add = [&](const Moments& found, double probability) {
    counts.push_back(found.mean() * static_cast<double>(found.count()));
    probabilities.push_back(probability);
  };
  for (size_t i = 0; i + 1 < kMuEdges.size(); ++i) {
    add(e.reflected_at[i], s.reflected_flux.values[i]);
    add(e.transmitted_at[i], s.transmitted_flux.values[i]);
  }
  add(e.unscattered, s.unscattered);
  add(e.absorbed, s.absorbed.value);
  return check_distribution(name, counts, probabilities);
}

std::vector<Check> homogeneous_slabs(const Effort& effort) {
  // The first is the case for which [Wang1995] cites reflection and transmission from [Hulst1980].
  static constexpr SlabProblem kProblems[] = {
      {2.0, 0.9, 0.75, Incidence::collimated},   {1.0, 1.0, 0.0, Incidence::collimated},
      {0.1, 0.5, 0.0, Incidence::diffuse},       {4.0, 0.9, 0.0, Incidence::collimated},
      {8.0, 1.0, 0.75, Incidence::diffuse},      {16.0, 0.99, 0.0, Incidence::diffuse},
      {64.0, 0.999, 0.75, Incidence::collimated}};
  const auto strategy = make_distance_strategy({});
  std::vector<Check> checks;
  for (const SlabProblem& p : kProblems) {
    const exact::SlabSolution s = exact::solve_slab(exact_slab(p), {{}, {}, kMuEdges});
    const SlabEstimate e = estimate_slab(homogeneous_slab(p.tau, p.albedo, p.g, p.incidence), *strategy, {kMuEdges, {}},
                                         photon_count(effort, collisions_of(p)), effort.seed_of("slab " + title(p)));
    checks.push_back(check_probability(title(p) + ": reflected", e.reflected, s.reflected.value));
    checks.push_back(check_probability(title(p) + ": transmitted", e.transmitted, s.transmitted.value));
    checks.push_back(check_probability(title(p) + ": absorbed", e.absorbed, s.absorbed.value));
    checks.push_back(check_ends(title(p) + ": directions", e, s));
  }
  return checks;
}

std::vector<Check> half_spaces(const Effort& effort) {
  // So thick that 1e-9 of the light comes through.
  static constexpr SlabProblem kProblems[] = {{20.0, 0.5, 0.0, Incidence::collimated},
                                              {50.0, 0.9, 0.0, Incidence::collimated},
                                              {130.0, 0.99, 0.0, Incidence::diffuse},
                                              {80.0, 0.9, 0.75, Incidence::collimated}};
  const auto strategy = make_distance_strategy({});
  std::vector<Check> checks;
  for (const SlabProblem& p : kProblems) {
    exact::Slab half_space = exact_slab(p);
    half_space.tau = std::numeric_limits<double>::infinity();
    const exact::SlabSolution s = exact::solve_slab(half_space);
    const std::string name =
        fmt::format("albedo {}, g {}, {}", p.albedo, p.g, p.incidence == Incidence::diffuse ? "diffuse" : "collimated");
    const SlabEstimate e = estimate_slab(homogeneous_slab(p.tau, p.albedo, p.g, p.incidence), *strategy, {},
                                         photon_count(effort, collisions_of(p)), effort.seed_of("half space " + name));
    checks.push_back(check_probability(name + ": reflected", e.reflected, s.reflected.value));
    checks.push_back(check_mean(name + ": collisions", e.collisions, s.absorbed.value / (1.0 - p.albedo)));
    if (p.g == 0.0 && p.incidence == Incidence::collimated) {
      const double h = exact::chandrasekhar_h(p.albedo, 1.0).value;
      checks.push_back(check_probability(name + ": reflected, by Chandrasekhar's H", e.reflected,
                                         1.0 - std::sqrt(1.0 - p.albedo) * h));
    }
  }
  return checks;
}

/// Reflection, transmission and absorption by one strategy.
void check_strategy(std::vector<Check>& checks, const Slab& slab, const StrategyInfo& info, const std::string& name,
                    const exact::SlabSolution& s, const Effort& effort) {
  const auto strategy = make_distance_strategy(careful_settings(info.name));
  const std::string title = fmt::format("{}, {}", name, info.name);
  const bool homogeneous = slab.layers.sigma_t.front() == slab.layers.sigma_t.back();
  const SlabEstimate e =
      estimate_slab(slab, *strategy, {}, effort.count(50'000, 1'500'000), effort.seed_of("strategy " + title));
  const auto check = [&](const char* what, const Moments& found, double exact) {
    checks.push_back(homogeneous || info.bounded_weight ? check_probability(title + what, found, exact)
                                                        : check_weighted_mean(title + what, found, exact));
  };
  check(": reflected", e.reflected, s.reflected.value);
  check(": transmitted", e.transmitted, s.transmitted.value);
  check(": absorbed", e.absorbed, s.absorbed.value);
}

std::vector<Check> strategies_in_slabs(const Effort& effort) {
  const SlabProblem p{2.0, 0.9, 0.5, Incidence::collimated};
  const exact::SlabSolution s = exact::solve_slab(exact_slab(p));
  std::vector<Check> checks;
  for (const StrategyInfo& info : distance_strategies())
    if (info.positive)
      check_strategy(checks, homogeneous_slab(p.tau, p.albedo, p.g, p.incidence), info, "homogeneous", s, effort);
  // Contrasts so mild that weighted strategies stay usable: of strong ones their tails hide.
  const std::pair<const char*, Layers> kProfiles[] = {{"two layers", {{0.0, 0.5, 0.5, 1.0}, {1.5, 1.5, 2.5, 2.5}}},
                                                      {"a ramp", {{0.0, 1.0}, {1.5, 2.5}}}};
  for (const auto& [name, layers] : kProfiles)
    for (const StrategyInfo& info : distance_strategies())
      if (info.heterogeneous && info.unbiased && info.positive)
        check_strategy(checks, {layers, p.albedo, p.g, p.incidence}, info, name, s, effort);
  return checks;
}

std::vector<Check> steep_slabs(const Effort& effort) {
  const SlabProblem p{4.0, 0.9, 0.0, Incidence::collimated};
  const std::vector<double> planes{0.0, 0.2, 0.4, 0.6, 0.8, 1.0};
  struct Steep {
    const char* name;
    Layers layers;
    std::vector<double> tau;  // at the planes
  };
  const Steep kSteep[] = {{"an empty layer",
                           {{0.0, 0.25, 0.25, 0.75, 0.75, 1.0}, {8.0, 8.0, 0.0, 0.0, 8.0, 8.0}},
                           {0.0, 1.6, 2.0, 2.0, 2.4, 4.0}},
                          {"from nothing", {{0.0, 1.0}, {0.0, 8.0}}, {0.0, 0.16, 0.64, 1.44, 2.56, 4.0}},
                          {"a dense sheet",
                           {{0.0, 0.5, 0.5, 0.53125, 0.53125, 1.0}, {1.0, 1.0, 97.0, 97.0, 1.0, 1.0}},
                           {0.0, 0.2, 0.4, 3.6, 3.8, 4.0}}};
  const auto strategy = make_distance_strategy({});
  std::vector<Check> checks;
  for (const Steep& steep : kSteep) {
    const exact::SlabSolution s = exact::solve_slab(exact_slab(p), {steep.tau, {}, {}});
    const std::string name = steep.name;
    const SlabEstimate e = estimate_slab({steep.layers, p.albedo, p.g, p.incidence}, *strategy, {{}, planes},
                                         effort.count(50'000, 1'200'000), effort.seed_of("steep " + name));
    checks.push_back(check_probability(name + ": reflected", e.reflected, s.reflected.value));
    checks.push_back(check_probability(name + ": transmitted", e.transmitted, s.transmitted.value));
    for (size_t i = 0; i + 1 < planes.size(); ++i) {
      const double absorbed = s.net_flux.values[i] - s.net_flux.values[i + 1];
      checks.push_back(check_probability(fmt::format("{}: absorbed from {} to {} m", name, planes[i], planes[i + 1]),
                                         e.absorbed_between[i], std::max(0.0, absorbed)));
    }
  }
  return checks;
}

}  // namespace

std::vector<Experiment> slab_experiments() {
  return {{2, "slabs", homogeneous_slabs},
          {2, "half spaces", half_spaces},
          {2, "slabs by every strategy", strategies_in_slabs},
          {2, "slabs that vary with depth", steep_slabs}};
}

}  // namespace vpm
