// Density estimates of photons spread evenly: every kernel, by radius and by count, has the exact density for its mean.
//
// Of n photons uniform over a volume V the k-th nearest to a point lies in a ball whose share of V has the distribution
// Beta(k, n - k + 1), so the mean of 1 over the ball's volume is n / ((k - 1) V): k - 1 photons over it are unbiased,
// and so is any kernel, as the k - 1 are uniform in the ball. The same holds in discs. Around a ray, each photon stands
// for the density along the ray, whatever its disc.
#include <fmt/format.h>
#include <array>

#include "vpm/estimate/beam_estimate.h"
#include "vpm/estimate/surface_estimate.h"
#include "vpm/estimate/volume_estimate.h"
#include "vpm/photon/density_control.h"
#include "vpm/study/sample_moments.h"
#include "vpm/study/validate/groups.h"

namespace vpm {

namespace {

// Of a total of 1 W in a cube or square of side 2 m; around rays so many that the faces of the cube, where balls of ten
// photons are larger, lie outside of the discs.
constexpr uint64_t kPhotonsOfMaps = 200, kPhotonsAroundRays = 2000;

/// Photons that travel down, uniform over [-1, 1]^3 or over its section z = 0.
std::vector<Photon> even_photons(uint64_t count, bool flat, Rng& rng) {
  std::vector<Photon> photons(count);
  const PackedDirection down(Vec3(0.0f, 0.0f, -1.0f));
  for (Photon& p : photons) {
    p = {2.0f * Vec3(rng.uniform(), rng.uniform(), flat ? 0.5f : rng.uniform()) - 1.0f, down, Rgb(1.0f)};
  }
  return photons;
}

/// Fluence over sigma_t = 1/m in the volume, irradiance on the plane, both at a point off the center.
double estimate(bool flat, const GatherSettings& settings, Rng& rng) {
  const Vec3 point(0.1f, -0.05f, 0.0f);
  const PhotonMap map = make_photon_map(even_photons(kPhotonsOfMaps, flat, rng), settings, kPhotonsOfMaps);
  return flat ? surface_irradiance(point, Vec3(0.0f, 0.0f, 1.0f), map).value.g : fluence(Rgb(1.0f), point, map).g;
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

/// Where the density is (1 + 4 |x|^2) of what it is at the middle of the kernel, the bias of kernels is of order r^2
/// and nothing else: their corrections take it away as a whole (KernelPair).
std::vector<Check> check_corrected(bool flat, const Effort& effort) {
  const Vec3 point(0.1f, -0.05f, 0.0f);
  std::vector<Check> checks;
  for (const KernelInfo& kernel : kKernels) {
    const GatherSettings settings{GatherMode::radius, 0.5f, 12, kernel.kind};
    const std::string name =
        fmt::format("{} kernel, corrected in a curved density {}", kernel.name, flat ? "on a plane" : "in a volume");
    const auto samples =
        sample_moments(1, effort.count(4'500, 60'000), effort.seed_of(name), [&](Rng& rng, double* out) {
          std::vector<Photon> photons = even_photons(kPhotonsOfMaps, flat, rng);
          for (Photon& p : photons) p.power = Rgb(1.0f + 4.0f * glm::dot(p.position - point, p.position - point));
          const PhotonMap map = make_photon_map(std::move(photons), settings, kPhotonsOfMaps);
          const auto power = [](const Vec3&, const Rgb& of_photon) { return of_photon; };
          const KernelEstimate found =
              flat ? kernel_sum<2>(map, point, AnyPhoton{}, power) : kernel_sum<3>(map, point, AnyPhoton{}, power);
          out[0] = found.value.g + found.correction.g;
        });
    checks.push_back(check_mean(name, samples[0], flat ? 1.0 / 4.0 : 1.0 / 8.0));
  }
  return checks;
}

/// Photons whose power others have taken over leave all means as they are.
Check check_controlled(const Effort& effort) {
  const std::string name = "at most 4 photons in a cube, fixed radius in a volume";
  const auto samples = sample_moments(1, effort.count(4'500, 60'000), effort.seed_of(name), [](Rng& rng, double* out) {
    std::vector<Photon> photons = even_photons(kPhotonsOfMaps, false, rng);
    control_density(photons, 0.6f, 4);
    const PhotonMap map = make_photon_map(photons, {.radius = 0.5f}, kPhotonsOfMaps);
    out[0] = fluence(Rgb(1.0f), Vec3(0.1f, -0.05f, 0.0f), map).g;
  });
  return check_mean(name, samples[0], 1.0 / 8.0);
}

const Rgb kAttenuation(0.2f, 1.0f, 3.0f);  // 1/m

/// Radiance along a ray through the middle of the cube, by isotropic scattering of albedo 1, attenuated by
/// kAttenuation; discs of half a metre, or of the balls of about so many photons.
Rgb estimate_around_ray(KernelKind kernel, uint32_t count, Rng& rng) {
  const GatherSettings settings{.radius = 0.5f, .kernel = kernel, .beam_count = count};
  const BeamMap map{settings, SegmentMap(even_photons(kPhotonsAroundRays, false, rng), {settings.radius, count},
                                         1.0f / kPhotonsAroundRays)};
  const Ray ray{Vec3(0.1f, -0.05f, 1.0f), Vec3(0.0f, 0.0f, -1.0f)};
  const auto transmittance = [](float t) { return glm::exp(-kAttenuation * t); };
  GatherCounters counters;
  return beam_sum(Isotropic{}, {ray, {0.0f, 2.0f}}, each_distance(transmittance), map, counters).sum.value;
}

/// The photons' density, 1/(8 m^3), times the integral of exp(-sigma t) over the 2 m of the cube, at 1/(4 pi) sr.
double exact_around_ray(double sigma) { return -std::expm1(-2.0 * sigma) / sigma / 8.0 / (4.0 * kPiD); }

std::vector<Check> check_beams(const Effort& effort) {
  std::vector<Check> checks;
  for (const KernelInfo& kernel : kKernels)
    for (const uint32_t count : {0u, 10u}) {
      const std::string name =
          fmt::format("{} kernel, around a ray{}", kernel.name, count > 0 ? ", radii of their own" : "");
      const auto samples =
          sample_moments(3, effort.count(1'500, 12'000), effort.seed_of(name), [&](Rng& rng, double* out) {
            const Rgb radiance = estimate_around_ray(kernel.kind, count, rng);
            for (int c = 0; c < 3; ++c) out[c] = radiance[c];
          });
      for (size_t c = 0; c < 3; ++c)
        checks.push_back(
            check_mean(name + kOfChannel[c], samples[c], exact_around_ray(kAttenuation[static_cast<int>(c)])));
    }
  return checks;
}

}  // namespace

std::vector<Experiment> photon_map_experiments() {
  return {{0, "even photons, estimates of their density", [](const Effort& effort) {
             std::vector<Check> checks = check_maps(false, effort);
             append(checks, check_maps(true, effort));
             append(checks, check_corrected(false, effort));
             append(checks, check_corrected(true, effort));
             checks.push_back(check_controlled(effort));
             append(checks, check_beams(effort));
             return checks;
           }}};
}

}  // namespace vpm
