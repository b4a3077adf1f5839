// Point sources in endless media, spheres in a uniform environment, airlight of points and of beams.
#include <fmt/format.h>
#include <algorithm>

#include "vpm/study/estimates/airlight.h"
#include "vpm/study/estimates/point_source.h"
#include "vpm/study/estimates/sphere.h"
#include "vpm/study/exact/airlight.h"
#include "vpm/study/exact/point_source.h"
#include "vpm/study/exact/sphere.h"
#include "vpm/study/validate/groups.h"

namespace vpm {
namespace {

/// What a photon map with Epanechnikov's kernel of radius h has for its mean at distance r from a point source: the
/// fluence averaged over the ball with that kernel. A radial field's mean over the sphere of radius s about the point
/// is int u phi(u) du / (2 r s) from r - s to r + s; the integral over s is done in closed form.
double smoothed_fluence(const PointSource& source, double r, double h) {
  constexpr int kSteps = 200;
  std::vector<double> radii;
  for (int i = 0; i < kSteps; ++i) radii.push_back(r + h * (2.0 * (i + 0.5) / kSteps - 1.0));
  const exact::PointSourceSolution s =
      exact::solve_point_source(source.albedo, exact::henyey_greenstein_moments(source.g), radii);
  double sum = 0.0;
  for (size_t i = 0; i < radii.size(); ++i) {
    const double x = (radii[i] - r) / h, weight = 15.0 / 16.0 * (1.0 - x * x) * (1.0 - x * x);
    sum += weight * radii[i] / r * (s.uncollided[i] + s.collided[i].value) * 2.0 / kSteps;
  }
  return sum;
}

std::vector<Check> point_sources(const Effort& effort) {
  static constexpr PointSource kSources[] = {{0.9, 0.0}, {0.9, 0.8}};
  const std::vector<double> distances{0.5, 1.0, 2.0}, kernels{0.15, 0.3, 0.6};
  std::vector<Check> checks;
  for (const PointSource& source : kSources) {
    const std::string name = fmt::format("albedo {}, g {}", source.albedo, source.g);
    const uint64_t seed = effort.seed_of("point source " + name);
    const exact::PointSourceSolution s =
        exact::solve_point_source(source.albedo, exact::henyey_greenstein_moments(source.g), distances);
    const std::vector<Moments> within =
        estimate_collisions_within(source, distances, effort.count(50'000, 3'000'000), seed);
    const MapEffort maps{20, effort.count(5'000, 200'000), seed + 1};
    const std::vector<MapFluence> found = estimate_map_fluence(source, distances, kernels, false, maps);
    for (size_t i = 0; i < distances.size(); ++i) {
      const double r = distances[i], h = kernels[i], fluence = s.uncollided[i] + s.collided[i].value;
      const double wide = smoothed_fluence(source, r, h), narrow = smoothed_fluence(source, r, 0.5 * h);
      const auto title = [&](const std::string& what) { return fmt::format("{}, r {}: {}", name, r, what); };
      checks.push_back(check_mean(title("collisions within"), within[i], s.collisions[i].value));
      checks.push_back(check_mean(
          title(fmt::format("fluence and kernel bias of {:+.2g} %, h {}", 100.0 * (wide / fluence - 1.0), h)),
          found[i].wide, wide));
      checks.push_back(check_mean(
          title(fmt::format("fluence and kernel bias of {:+.2g} %, h {}", 100.0 * (narrow / fluence - 1.0), 0.5 * h)),
          found[i].narrow, narrow));
      // What is left is of the order of h^4.
      const double left = (4.0 * narrow - wide) / 3.0 - fluence;
      checks.push_back(
          check_mean(title("fluence, bias extrapolated away"), found[i].unbiased, fluence, std::abs(left)));
    }
  }
  return checks;
}

std::vector<Check> spheres(const Effort& effort) {
  static constexpr FoggySphere kSpheres[] = {{2.0, 0.9, 0.0}, {8.0, 0.99, 0.0}};
  const std::vector<double> radii{0.25, 0.9}, impacts{0.0, 0.75};
  std::vector<Check> checks;
  for (const FoggySphere& sphere : kSpheres) {
    const std::string name = fmt::format("optical radius {}, albedo {}", sphere.optical_radius, sphere.albedo);
    const uint64_t seed = effort.seed_of("sphere " + name);
    const exact::SphereSolution s = exact::solve_sphere(sphere.optical_radius, sphere.albedo, radii, impacts);
    const SpherePhotons photons = estimate_sphere_photons(sphere, effort.count(40'000, 1'200'000), seed);
    checks.push_back(check_probability(name + ": escaping", photons.escaped, s.escaping.value));
    checks.push_back(check_probability(name + ": uncollided", photons.uncollided, s.uncollided));
    checks.push_back(check_mean(name + ": collisions", photons.collisions, s.absorbed.value / (1.0 - sphere.albedo)));
    const SpherePaths paths = estimate_sphere_paths(sphere, radii, impacts, effort.count(10'000, 400'000), seed + 1);
    for (size_t i = 0; i < radii.size(); ++i)
      checks.push_back(
          check_mean(fmt::format("{}: fluence at {} R", name, radii[i]), paths.fluence[i], s.fluence.values[i]));
    for (size_t i = 0; i < impacts.size(); ++i)
      checks.push_back(check_mean(fmt::format("{}: image at {} R", name, impacts[i]), paths.image[i], s.image.values[i],
                                  s.image.error));
  }
  return checks;
}

/// Airlight by photons that fly once, their kernels' bias extrapolated away: what is left is of the order of the fourth
/// power of the radius, which is small against the distance over which light changes.
template <class Estimate>
void check_airlight_by_photons(std::vector<Check>& checks, const std::string& name, double exact, double radius,
                               const Effort& effort, const Estimate& estimate) {
  for (const auto& [type, by] : kAlongRays) {
    const std::string title = fmt::format("{}: radiance by {}", name, by);
    const RadianceByPhotons found = estimate({.type = type,
                                              .radius = radius,
                                              .photons = 10'000,
                                              .passes = static_cast<int>(effort.count(20, 400)),
                                              .seed = effort.seed_of("airlight, " + title)});
    checks.push_back(check_mean(title + ", bias extrapolated away", found.unbiased, exact));
  }
}

std::vector<Check> airlights(const Effort& effort) {
  static constexpr Airlight kAirlights[] = {{0.5, 0.9, 0.5, 1.0, 3.0, 0.0, 10.0},
                                            {0.3, 0.8, 0.9, 1e-6, 2.0, 0.0, 4.0},
                                            {1.0, 1.0, -0.3, 1.0, 0.5, 0.0, HUGE_VAL},
                                            {1.0, 0.9, 0.7, 0.01, 0.5, 0.0, HUGE_VAL}};
  std::vector<Check> checks;
  for (const Airlight& a : kAirlights) {
    const exact::AirlightSolution s =
        exact::solve_airlight({a.sigma_t, a.albedo, a.g, a.distance, a.t_light, a.t0, a.t1});
    const std::string name = fmt::format("light {} m off the ray, g {}", a.distance, a.g);
    const uint64_t seed = effort.seed_of("airlight " + name);
    // Positions are floats: relative errors of 1e-6.
    checks.push_back(check_mean(name + ": radiance over what is exact",
                                estimate_airlight(a, s.log10_radiance, effort.count(10'000, 400'000), seed), 1.0,
                                1e-6));
    if (!std::isinf(a.t1)) continue;
    const uint64_t paths = effort.count(40'000, 1'600'000);
    checks.push_back(check_mean(name + ": radiance by the eye path",
                                estimate_airlight_by_eye_path(a, DirectLight::shadow_rays, paths, seed + 1),
                                s.radiance.value));
    checks.push_back(check_mean(name + ": radiance by the eye path, equiangular",
                                estimate_airlight_by_eye_path(a, DirectLight::equiangular, paths, seed + 2),
                                s.radiance.value));
    check_airlight_by_photons(checks, name, s.radiance.value, 0.2 * a.distance, effort,
                              [&](const PhotonRays& by) { return estimate_airlight_by_photons(a, by); });
  }
  return checks;
}

/// A beam of light seen from ahead, aside and behind.
std::vector<Check> beams_of_light(const Effort& effort) {
  static constexpr BeamAirlight kBeams[] = {
      {0.5, 0.9, 0.0, 0.5, -0.8, 2.0, 2.0}, {1.0, 0.8, 0.6, 0.3, 0.0, 1.0, 1.5}, {2.0, 1.0, -0.4, 0.2, 0.9, 1.0, 1.0}};
  std::vector<Check> checks;
  for (const BeamAirlight& a : kBeams)
    check_airlight_by_photons(
        checks, fmt::format("g {}, cosine {}", a.g, a.cosine),
        exact::solve_beam_airlight({a.sigma_t, a.albedo, a.g, a.beam_radius, a.cosine, a.flown, a.seen}).value,
        0.4 * a.beam_radius, effort, [&](const PhotonRays& by) { return estimate_beam_airlight_by_photons(a, by); });
  return checks;
}

}  // namespace

std::vector<Experiment> source_experiments() {
  return {{2, "point sources in endless media", point_sources},
          {2, "spheres in a uniform environment", spheres},
          {2, "airlight", airlights},
          {2, "airlight of a collimated beam", beams_of_light}};
}

}  // namespace vpm
