// Radiance that leaves slabs, by the path tracer and by photons gathered along rays, and fluence inside.
#include <fmt/format.h>

#include "vpm/image/metrics.h"
#include "vpm/integrators/photon_map/photon_pass.h"
#include "vpm/medium/grid/make_grid.h"
#include "vpm/scene/build.h"
#include "vpm/study/estimates/slab_radiance.h"
#include "vpm/study/exact/slab.h"
#include "vpm/study/validate/groups.h"

namespace vpm {
namespace {

struct RadianceProblem {
  double tau, albedo, g;
};
constexpr RadianceProblem kRadianceProblems[] = {{4.0, 0.9, 0.0}, {2.0, 0.9, 0.75}};

std::vector<Check> radiances(const Effort& effort) {
  const std::vector<double> mus{0.1, 0.5, 1.0}, depths{0.125, 0.5, 1.0};  // over the thickness
  std::vector<SlabExit> exits;
  for (const bool below : {false, true})
    for (const double mu : mus) exits.push_back({mu, below});
  std::vector<Check> checks;
  for (const RadianceProblem& p : kRadianceProblems) {
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

/// A slab is seen alike along parallel rays, and so through kernels of any radius: they have no bias.
void check_radiance_by_photons(std::vector<Check>& checks, const RadianceProblem& p, const NamedGather& by,
                               const Effort& effort) {
  const std::string name = fmt::format("tau {}, albedo {}, g {}, {}", p.tau, p.albedo, p.g, by.name);
  const std::vector<SlabExit> exits{{0.5, false}, {0.8, false}, {0.5, true}, {0.8, true}};
  const std::vector<SlabRange> ranges{{0.5, 1.0, false}, {0.5, 1.0, true}};
  const exact::SlabSolution s =
      exact::solve_slab({p.tau, p.albedo, exact::henyey_greenstein_moments(p.g), {}}, {{}, {0.5, 0.8}, {0.5, 1.0}});
  const SlabSights found =
      estimate_slab_radiance_by_photons(homogeneous_slab(p.tau, p.albedo, p.g, Incidence::collimated), exits, ranges,
                                        {.type = by.type,
                                         .radius = 0.4,
                                         .photons = 5'000,
                                         .passes = static_cast<int>(effort.count(60, 600)),
                                         .seed = effort.seed_of("radiance by photons " + name)});
  const auto check = [&](const std::string& what, const RadianceByPhotons& seen, double exact) {
    checks.push_back(check_mean(fmt::format("{}: {}, radius 0.4", name, what), seen.wide, exact));
    checks.push_back(check_mean(fmt::format("{}: {}, radius 0.2", name, what), seen.narrow, exact));
  };
  for (size_t i = 0; i < exits.size(); ++i) {
    const auto& [mu, below] = exits[i];
    check(fmt::format("{} radiance, mu {}", below ? "transmitted" : "reflected", mu), found.exits[i],
          (below ? s.transmitted_radiance : s.reflected_radiance).values[i % 2]);
  }
  for (size_t i = 0; i < ranges.size(); ++i)
    check(fmt::format("{} flux, mu 0.5 to 1", ranges[i].below ? "transmitted" : "reflected"), found.fluxes[i],
          (ranges[i].below ? s.transmitted_flux : s.reflected_flux).values[0]);
}

std::vector<Check> radiances_by_photons(const Effort& effort) {
  std::vector<Check> checks;
  for (const RadianceProblem& p : kRadianceProblems)
    for (const NamedGather& by : kAlongRays) check_radiance_by_photons(checks, p, by, effort);
  return checks;
}

}  // namespace

std::vector<Experiment> slab_radiance_experiments() {
  return {{2, "radiance of slabs, by the path tracer", radiances},
          {2, "radiance of slabs, by photons along rays", radiances_by_photons}};
}

// A slab that light enters straight from above, seen at a slant through kernels as wide as it is deep. It hardly
// scatters twice, so that its radiance is known in closed form. Light falls off with depth, and both faces cut every
// kernel: what is missing before the ends of segments must come from beyond them, seen through as much of the slab.
namespace {

constexpr double kDepth = 0.4, kExtinction = 5.0;  // m, 1/m
constexpr double kAlbedo = 1e-4;                   // so much of the light is scattered twice
constexpr double kCosine = 0.6;                    // of the view to the normal

Medium hardly_scattering(bool voxels) {
  Medium medium{.name = "", .sigma_s = Rgb(0.0f), .sigma_t = Rgb(0.0f), .phase = Isotropic{}, .grid = nullptr};
  medium.sigma_t = Rgb(static_cast<float>(kExtinction));
  medium.sigma_s = medium.sigma_t * static_cast<float>(kAlbedo);
  if (voxels) medium.grid = make_grid(centered_frame(24, 0.2), [](int, int, int) { return 1.0; });
  return medium;
}

Scene slab(bool voxels) {
  Scene scene;
  scene.media.push_back(hardly_scattering(voxels));
  const Interface media{0, kVacuum};
  const double half = 0.5 * kDepth;
  add_shape(scene, box_mesh(Vec3d(-1.5, -half, -1.5), Vec3d(1.5, half, 1.5)), Boundary{}, &media);
  scene.lights.push_back(DirectionalLight{Vec3(0.0f, -1.0f, 0.0f), Rgb(1.0f)});
  const float sine = static_cast<float>(std::sqrt(1.0 - kCosine * kCosine));
  scene.camera =
      make_camera(20.0f * Vec3(sine, static_cast<float>(kCosine), 0.0f), Vec3(0.0f), Vec3(0, 1, 0), 0.3f, {4, 4});
  scene.geometry.commit();
  finish(scene);
  return scene;
}

/// The integral, along the ray, of what is scattered once at the depth z = cos t: sigma_s / (4 pi) exp(-sigma_t (z +
/// t)).
double exact_radiance() {
  const double optical = kExtinction * kDepth * (1.0 + 1.0 / kCosine);
  return -kAlbedo / (4.0 * kPiD) * std::expm1(-optical) / (1.0 + kCosine);
}

Check check_slab(const std::string& name, bool voxels, std::string_view type, const Effort& effort) {
  const Scene scene = slab(voxels);
  RenderSettings settings;
  settings.seed = effort.seed_of(name);
  settings.photons.emitted = 40'000;
  settings.radii = RadiusSchedule::constant;
  settings.volume.choose(type);
  settings.volume.radius = 0.4f;
  Moments means;
  for (int pass = 0; pass < static_cast<int>(effort.count(24, 400)); ++pass)
    means.add(channel_means(render_photon_pass(scene, settings, pass).image).g);
  const double exact = exact_radiance();
  return check_within(name, means, exact, 0.005 * exact);
}

std::vector<Check> check_slabs(const Effort& effort) {
  return {check_slab("balls", false, "radius", effort),
          check_slab("discs", false, "beam", effort),
          check_slab("voxels, discs", true, "beam", effort),
          check_slab("photon beams", false, "photon-beams", effort),
          check_slab("voxels, photon beams", true, "photon-beams", effort),
          check_slab("photon beams around points", false, "beams-points", effort),
          check_slab("voxels, photon beams around points", true, "beams-points", effort)};
}

}  // namespace

std::vector<Experiment> slanted_slab_experiments() {
  return {{1, "a slab seen at a slant through kernels as wide as it is deep", check_slabs}};
}

}  // namespace vpm
