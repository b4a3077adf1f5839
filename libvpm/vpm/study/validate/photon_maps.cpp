// Density estimates of photons spread evenly: every kernel, by radius and by count, has the exact density for its mean.
//
// Of n photons uniform over a volume V the k-th nearest to a point lies in a ball whose share of V has the distribution
// Beta(k, n - k + 1), so the mean of 1 over the ball's volume is n / ((k - 1) V): k - 1 photons over it are unbiased,
// and so is any kernel, as the k - 1 are uniform in the ball. The same holds in discs.
#include <fmt/format.h>
#include <array>

#include "vpm/estimate/surface_estimate.h"
#include "vpm/estimate/volume_estimate.h"
#include "vpm/study/sample_moments.h"
#include "vpm/study/validate/groups.h"

namespace vpm {

namespace {

constexpr uint64_t kPhotons = 200;  // of a total of 1 W in a cube or square of side 2 m

/// Photons that travel down, uniform over [-1, 1]^3 or over its section z = 0.
std::vector<Photon> even_photons(bool flat, Rng& rng) {
  std::vector<Photon> photons(kPhotons);
  const PackedDirection down(Vec3(0.0f, 0.0f, -1.0f));
  for (Photon& p : photons) {
    p = {2.0f * Vec3(rng.uniform(), rng.uniform(), flat ? 0.5f : rng.uniform()) - 1.0f, down, Rgb(1.0f)};
  }
  return photons;
}

/// Fluence over sigma_t = 1/m in the volume, irradiance on the plane, both at a point off the centre.
double estimate(bool flat, const GatherSettings& settings, Rng& rng) {
  const Vec3 point(0.1f, -0.05f, 0.0f);
  const PhotonMap map = make_photon_map(even_photons(flat, rng), settings, kPhotons);
  return flat ? surface_irradiance(point, Vec3(0.0f, 0.0f, 1.0f), map).g : fluence(Rgb(1.0f), point, map).g;
}

std::vector<Check> check_maps(bool flat, const Effort& effort) {
  const double exact = flat ? 1.0 / 4.0 : 1.0 / 8.0;
  std::vector<Check> checks;
  for (const KernelInfo& kernel : kKernels)
    for (const GatherMode mode : {GatherMode::radius, GatherMode::nearest}) {
      const bool nearest = mode == GatherMode::nearest;
      const GatherSettings settings{mode, nearest ? 0.85f : 0.5f, 12, kernel.kind};
      const std::string name = fmt::format("{} kernel, {} {}", kernel.name, nearest ? "12 nearest" : "fixed radius",
                                           flat ? "on a plane" : "in a volume");
      const auto samples = sample_moments(1, effort.count(4'500, 60'000), effort.seed_of(name),
                                          [&](Rng& rng, double* out) { out[0] = estimate(flat, settings, rng); });
      checks.push_back(check_mean(name, samples[0], exact));
    }
  return checks;
}

}  // namespace

std::vector<Experiment> photon_map_experiments() {
  return {{0, "even photons, estimates of their density", [](const Effort& effort) {
             std::vector<Check> checks = check_maps(false, effort);
             append(checks, check_maps(true, effort));
             return checks;
           }}};
}

}  // namespace vpm
