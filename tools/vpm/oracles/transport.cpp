// S2, S3 and S5: point sources in endless media, airlight, spheres in a uniform environment.
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <map>

#include "oracles/cases.h"
#include "vpm/study/estimates/airlight.h"
#include "vpm/study/estimates/point_source.h"
#include "vpm/study/estimates/sphere.h"

namespace vpm::tools {
namespace {

/// A kernel radius that gathers enough photons around a distance, and over which the fluence is nearly a quadratic.
double kernel_radius(double distance) { return std::min(0.35 * distance, 1.0); }

/// The results of the cases of one medium, by number.
struct MediumResults {
  std::vector<Moments> collisions;
  std::vector<MapFluence> total, collided;
};

MediumResults estimate_medium(const PointSource& source, const std::vector<double>& radii, const Effort& effort) {
  std::vector<double> kernels;
  for (const double r : radii) kernels.push_back(kernel_radius(r));
  const MissingLight missing = missing_light(source, *std::max_element(radii.begin(), radii.end()));
  // Collisions of a photon: until it is absorbed, or until it leaves the medium by diffusion.
  const double diffusion = missing.end > 0.0 ? missing.end * missing.end / (6.0 * missing.diffusion) : 1e30;
  const double collisions = std::min(1.0 / (1.0 - source.albedo), diffusion) + 1.0;
  const double work = effort.full ? 6e8 : 6e6;
  const auto photons = static_cast<uint64_t>(std::clamp(work / collisions, 1e4, 2e7));
  const uint64_t seed = effort.seed_of(fmt::format("point source {} {}", source.albedo, source.g));
  const MapEffort maps{20, std::max<uint64_t>(photons / 20, 500), seed};
  return {estimate_collisions_within(source, radii, photons, seed + 1),
          estimate_map_fluence(source, radii, kernels, false, maps),
          estimate_map_fluence(source, radii, kernels, true, maps)};
}

/// A fluence through maps. Batches of a few photons are far from normal.
Check check_map(const std::string& name, const MapFluence& found, double exact, double exact_error) {
  constexpr double kFewest = 100.0;
  if (found.fewest < kFewest)
    return not_determined(name, found.unbiased.mean(), exact, fmt::format("{:.2g} photons in a batch", found.fewest));
  return check_mean(name, found.unbiased, exact, exact_error);
}

void check_point_source(CaseResult& result, const OracleCase& c, const MediumResults& found, size_t i,
                        const MissingLight& missing) {
  const double r = c.number("r_optical");
  const double beyond = missing.collisions_within(r), light = missing.fluence(r);
  result.checks.push_back(check_mean("collisions_within", found.collisions[i], c.number("collisions_within") - beyond,
                                     missing.relative_error * beyond));
  const double total = c.number("phi_total"), collided = c.number("phi_collided");
  result.checks.push_back(
      check_map("phi_total by photon maps", found.total[i], total - light, missing.relative_error * light));
  result.checks.push_back(
      check_map("phi_collided by photon maps", found.collided[i], collided - light, missing.relative_error * light));
  const double uncollided = c.number("phi_uncollided");
  const PointSource source{c.number("albedo"), c.number("g")};
  result.checks.push_back(check_bound("phi_uncollided by direct light", direct_fluence(source, r), uncollided,
                                      1e-6 * (1.0 + r) * uncollided));
}

}  // namespace

std::vector<CaseResult> run_point_sources(const OracleList& list, const Effort& effort) {
  // Cases of one medium share photons.
  std::map<std::pair<double, double>, std::vector<size_t>> media;
  std::vector<CaseResult> results(list.cases.size());
  for (size_t i = 0; i < list.cases.size(); ++i)
    results[i] = run_case([&, &c = list.cases[i]] {
      c.number_in("r_optical", 1e-3, 1e3);
      media[{c.number_in("albedo", 0.0, 1.0), c.number_in("g", -0.999, 0.999)}].push_back(i);
      return CaseResult{};
    });
  for (const auto& [medium, cases] : media) {
    std::vector<double> radii;
    for (const size_t i : cases) radii.push_back(list.cases[i].number("r_optical"));
    const PointSource source{medium.first, medium.second};
    const MissingLight missing = missing_light(source, *std::max_element(radii.begin(), radii.end()));
    const MediumResults found = estimate_medium(source, radii, effort);
    for (size_t i = 0; i < cases.size(); ++i)
      results[cases[i]] = run_case([&] {
        CaseResult result;
        check_point_source(result, list.cases[cases[i]], found, i, missing);
        return result;
      });
  }
  return results;
}

std::vector<CaseResult> run_airlights(const OracleList& list, const Effort& effort) {
  return run_each(list, [&](const OracleCase& c) {
    const Airlight airlight{c.number_in("sigma_t", 1e-9, 1e9), c.number_in("albedo", 0.0, 1.0),
                            c.number_in("g", -0.999, 0.999),   c.number_in("d", 1e-9, 1e9),
                            c.number_in("t_l", -1e9, 1e9),     c.number_in("t0", 0.0, 1e9),
                            c.number_or_infinity("t1")};
    if (!(airlight.t1 > airlight.t0)) c.refuse("\"t1\" must be larger than \"t0\"");
    const double log10_l = c.number("log10_L");
    const uint64_t seed = effort.seed_of(c.place()), samples = effort.count(20'000, 1'000'000);
    CaseResult result;
    // Coordinates and coefficients are floats: relative errors of 1e-7 times the optical path.
    result.checks.push_back(check_mean(fmt::format("L / 10^{:.6g}", log10_l),
                                       estimate_airlight(airlight, log10_l, samples, seed), 1.0, 1e-6));
    if (airlight.t0 == 0.0 && std::isinf(airlight.t1) && airlight.distance >= 0.05 * airlight.t_light)
      result.checks.push_back(check_mean(
          "L by the eye path", estimate_airlight_by_eye_path(airlight, DirectLight::shadow_rays, 4 * samples, seed + 1),
          c.number("L")));
    return result;
  });
}

std::vector<CaseResult> run_spheres(const OracleList& list, const Effort& effort) {
  return run_each(list, [&](const OracleCase& c) {
    const FoggySphere sphere{c.number_in("R_optical", 1e-3, 1e3), c.number_in("albedo", 0.0, 1.0),
                             c.number_in("g", -0.999, 0.999)};
    const uint64_t seed = effort.seed_of(c.place());
    const double collisions = 4.0 / 3.0 * sphere.optical_radius + 1.0;  // the most, where nothing is absorbed
    const double work = effort.full ? 6e7 : 1e6;
    const auto photons = static_cast<uint64_t>(std::clamp(work / collisions, 1e4, 1e7));
    const SpherePhotons e = estimate_sphere_photons(sphere, photons, seed);
    CaseResult result;
    const double abs_err = c.number("abs_err"), error = c.has("std_err") ? c.number("std_err") : abs_err;
    const auto check = [&](const char* field, const Moments& found) {
      if (!c.has(field)) return;
      const double exact = c.share(field);
      // Reference numbers of Monte Carlo have errors that count.
      result.checks.push_back(error > 1e-6 && std::string(field) != "uncollided_fraction"
                                  ? check_mean(field, found, exact, error)
                                  : check_probability(field, found, exact));
    };
    check("escape_fraction", e.escaped);
    check("absorbed_fraction", e.absorbed);
    check("uncollided_fraction", e.uncollided);
    result.checks.push_back(check_mean("power that enters, over pi times the surface", e.entering, 1.0));
    if (c.has("mean_collisions_per_photon"))
      result.checks.push_back(check_mean("mean_collisions_per_photon", e.collisions,
                                         c.number("mean_collisions_per_photon"), error / (1.0 - sphere.albedo)));
    else
      result.checks.push_back(check_mean("collisions of a photon", e.collisions,
                                         sphere.albedo < 1.0 ? c.number("absorbed_fraction") / (1.0 - sphere.albedo)
                                                             : 4.0 / 3.0 * sphere.optical_radius));
    if (!c.has("fluence")) return result;
    const std::vector<double> radii = c.numbers("fluence_r_over_R"), impacts = c.numbers("image_p");
    const std::vector<double> fluence = c.numbers("fluence", radii.size()),
                              image = c.numbers("image_radiance", impacts.size());
    const auto samples = static_cast<uint64_t>(std::clamp(work / (8.0 * collisions), 1e4, 1e7));
    const SpherePaths paths = estimate_sphere_paths(sphere, radii, impacts, samples, seed + 1);
    for (size_t i = 0; i < radii.size(); ++i)
      result.checks.push_back(check_mean(fmt::format("fluence, r/R {}", radii[i]), paths.fluence[i], fluence[i]));
    for (size_t i = 0; i < impacts.size(); ++i)
      result.checks.push_back(check_mean(fmt::format("image_radiance, p {}", impacts[i]), paths.image[i], image[i],
                                         c.has("image_abs_err") ? c.number("image_abs_err") : 0.0));
    return result;
  });
}

}  // namespace vpm::tools
