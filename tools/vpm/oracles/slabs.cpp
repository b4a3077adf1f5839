// S4 and S8: slabs, homogeneous and varying with depth.
#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "oracles/cases.h"
#include "vpm/base/error.h"
#include "vpm/study/estimates/slab.h"
#include "vpm/study/estimates/slab_radiance.h"

namespace vpm::tools {
namespace {

/// An infinite one as that through which 1e-12 of the light comes, by diffusion.
double read_thickness(const OracleCase& c, double albedo, double g) {
  const double tau = c.number_or_infinity("tau");
  if (std::isinf(tau) && albedo < 1.0) return 28.0 * (1.0 + 1.0 / std::sqrt(3.0 * (1.0 - albedo) * (1.0 - albedo * g)));
  return c.number_in("tau", 1e-6, 1e5);
}

Slab read_slab(const OracleCase& c) {
  const std::string incidence = c.text("incidence");
  if (incidence != "collimated_normal" && incidence != "diffuse")
    c.refuse(fmt::format("\"incidence\" is \"{}\", it must be collimated_normal or diffuse", incidence));
  const double albedo = c.number_in("albedo", 0.0, 1.0), g = c.number_in("g", -0.999, 0.999);
  Slab slab = homogeneous_slab(read_thickness(c, albedo, g), albedo, g,
                               incidence == "diffuse" ? Incidence::diffuse : Incidence::collimated);
  if (!c.has("z_nodes")) return slab;
  slab.layers.depth = c.numbers("z_nodes");
  slab.layers.sigma_t = c.numbers("sigma_t_nodes", slab.layers.depth.size());
  if (slab.layers.depth.size() < 2 || slab.layers.depth.front() != 0.0 ||
      !std::is_sorted(slab.layers.depth.begin(), slab.layers.depth.end()) ||
      *std::min_element(slab.layers.sigma_t.begin(), slab.layers.sigma_t.end()) < 0.0)
    c.refuse("\"z_nodes\" must ascend from 0, \"sigma_t_nodes\" must be at least 0");
  double tau = 0.0;
  for (size_t i = 1; i < slab.layers.depth.size(); ++i)
    tau +=
        0.5 * (slab.layers.sigma_t[i] + slab.layers.sigma_t[i - 1]) * (slab.layers.depth[i] - slab.layers.depth[i - 1]);
  if (std::abs(tau - c.number("tau")) > 1e-6 * tau)
    c.refuse(fmt::format("the optical thickness of its nodes is {}, \"tau\" is {}", tau, c.number("tau")));
  return slab;
}

/// As many samples as cost `work` collisions, at least 10^4: below, p-values go astray in the tails.
uint64_t samples_for(const Slab& slab, double work, uint64_t seed) {
  const auto strategy = make_distance_strategy({});
  const double collisions = estimate_slab(slab, *strategy, {}, 256, seed).collisions.mean();
  return static_cast<uint64_t>(std::clamp(work / (2.0 + collisions), 1e4, 1e7));
}

SlabTallies read_tallies(const OracleCase& c, const Slab& slab) {
  SlabTallies tallies;
  if (c.has("mu_bin_edges")) tallies.mu_edges = c.numbers("mu_bin_edges");
  if (c.has("z")) tallies.planes = c.numbers("z");
  if (c.has("depth_tau"))
    for (const double tau : c.numbers("depth_tau")) tallies.planes.push_back(tau / slab.layers.sigma_t[0]);
  for (const auto* list : {&tallies.mu_edges, &tallies.planes})
    if (!std::is_sorted(list->begin(), list->end())) c.refuse("bin edges and depths must ascend");
  return tallies;
}

void check_list(std::vector<Check>& checks, const OracleCase& c, const char* field, const std::vector<Moments>& found) {
  const std::vector<double> exact = c.shares(field, found.size());
  for (size_t i = 0; i < exact.size(); ++i)
    checks.push_back(check_probability(fmt::format("{}[{}]", field, i), found[i], exact[i]));
}

/// What photons find.
void check_photons(std::vector<Check>& checks, const OracleCase& c, const Slab& slab, const Effort& effort) {
  const auto strategy = make_distance_strategy({});
  const uint64_t seed = effort.seed_of(c.place());
  const uint64_t photons = samples_for(slab, effort.full ? 4e7 : 3.5e5, seed);
  const SlabEstimate e = estimate_slab(slab, *strategy, read_tallies(c, slab), photons, seed + 1);
  const auto check = [&](const char* field, const Moments& found) {
    if (c.has(field)) checks.push_back(check_probability(field, found, c.share(field)));
  };
  check("R", e.reflected);
  check("T_total", e.transmitted);
  check("T_unscattered", e.unscattered);
  check("A", e.absorbed);
  checks.push_back(check_probability("lost", e.lost, 0.0));
  if (c.has("flux_in_bin_reflected")) check_list(checks, c, "flux_in_bin_reflected", e.reflected_at);
  if (c.has("flux_in_bin_transmitted_scattered"))
    check_list(checks, c, "flux_in_bin_transmitted_scattered", e.transmitted_at);
  if (c.has("absorbed_in_z_fifths")) check_list(checks, c, "absorbed_in_z_fifths", e.absorbed_between);
  for (const char* flux : {"net_flux", "net_flux_down"}) {
    if (!c.has(flux)) continue;
    check_list(checks, c, flux, e.net_flux);
    if (slab.albedo == 1.0) continue;
    // What is absorbed between two depths is 1 - albedo of what collides there.
    const std::vector<double> exact = c.numbers(flux, e.net_flux.size());
    for (size_t i = 0; i + 1 < exact.size(); ++i)
      checks.push_back(check_mean(fmt::format("collisions between {}[{}] and [{}]", flux, i, i + 1),
                                  e.collisions_between[i], (exact[i] - exact[i + 1]) / (1.0 - slab.albedo)));
  }
}

/// What the path tracer finds.
void check_paths(std::vector<Check>& checks, const OracleCase& c, const Slab& slab, const Effort& effort) {
  std::vector<SlabExit> exits;
  std::vector<double> exact, depths, uncollided;
  if (c.has("radiance_reflected")) {
    const std::vector<double> mu = c.numbers("mu");
    const double tau = c.number("tau");
    for (const double m : mu) exits.push_back({m, false});
    for (const double m : mu) exits.push_back({m, true});
    exact = c.numbers("radiance_reflected", mu.size());
    for (const double radiance : c.numbers("radiance_transmitted_scattered", mu.size())) exact.push_back(radiance);
    if (slab.incidence == Incidence::diffuse)  // what has not scattered is seen, too
      for (size_t i = 0; i < mu.size(); ++i) exact[mu.size() + i] += std::exp(-tau / mu[i]) / kPiD;
  }
  if (c.has("fluence_total")) {
    depths = read_tallies(c, slab).planes;
    const char* seen = slab.incidence == Incidence::diffuse ? "fluence_total" : "fluence_scattered";
    for (const double fluence : c.numbers(seen, depths.size())) exact.push_back(fluence);
    uncollided = c.numbers("fluence_uncollided", depths.size());
  }
  if (exact.empty()) return;
  const uint64_t seed = effort.seed_of(c.place());
  const uint64_t samples = samples_for(slab, (effort.full ? 2e7 : 1e6) / static_cast<double>(exact.size()), seed);
  const SlabRadiances e = estimate_slab_radiance(slab, exits, depths, samples, seed + 2);
  for (size_t i = 0; i < exits.size(); ++i)
    checks.push_back(
        check_mean(fmt::format("radiance_{}, mu {}", exits[i].below ? "transmitted" : "reflected", exits[i].mu),
                   e.exits[i], exact[i]));
  for (size_t i = 0; i < depths.size(); ++i) {
    checks.push_back(check_mean(fmt::format("fluence[{}]", i), e.fluences[i], exact[exits.size() + i]));
    const Moments direct = estimate_unscattered_fluence(slab, depths[i], 20'000, seed + 3 + i);
    const std::string name = fmt::format("fluence_uncollided[{}]", i);
    checks.push_back(slab.incidence == Incidence::diffuse
                         ? check_mean(name, direct, uncollided[i])
                         : check_bound(name, direct.mean(), uncollided[i], 3e-6 * uncollided[i]));
  }
}

CaseResult run_slab(const OracleCase& c, const Effort& effort) {
  CaseResult result;
  const Slab slab = read_slab(c);
  if (!c.has("R") && !c.has("flux_in_bin_reflected") && !c.has("fluence_total")) {
    result.unchecked = "it has neither R, nor flux_in_bin_reflected, nor fluence_total";
    return result;
  }
  check_photons(result.checks, c, slab, effort);
  check_paths(result.checks, c, slab, effort);
  return result;
}

}  // namespace

std::vector<CaseResult> run_slabs(const OracleList& list, const Effort& effort) {
  return run_each(list, [&](const OracleCase& c) { return run_slab(c, effort); });
}

}  // namespace vpm::tools
