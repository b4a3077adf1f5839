// Maps of uniform photons.
#include "vpm/study/estimates/density.h"

#include <functional>

#include "vpm/base/parallel.h"
#include "vpm/base/rng.h"
#include "vpm/estimate/kernel_sum.h"

namespace vpm {
namespace {

using Densities = std::array<double, kKernels.size()>;  // by kernel

Rgb kernel_estimate(int dimension, const PhotonMap& map, const Vec3& point) {
  const auto power = [](const Vec3&, const Rgb& p) { return p; };
  if (dimension == 1) return kernel_sum<1>(map, point, AnyPhoton{}, power).value;
  return dimension == 2 ? kernel_sum<2>(map, point, AnyPhoton{}, power).value
                        : kernel_sum<3>(map, point, AnyPhoton{}, power).value;
}

/// The middle of the unit interval, square or cube; axes beyond the dimension stay at 0, as photons do.
Vec3 middle(int dimension) { return {0.5f, dimension > 1 ? 0.5f : 0.0f, dimension > 2 ? 0.5f : 0.0f}; }

/// Those of `count` uniform photons that lie within `reach` of the middle, along each axis.
std::vector<Photon> middle_photons(int dimension, uint64_t count, float reach, Rng& rng) {
  Photon photon;
  photon.travel = PackedDirection(Vec3(0.0f, 0.0f, -1.0f));
  photon.power = Rgb(1.0f);
  std::vector<Photon> photons;
  for (uint64_t i = 0; i < count; ++i) {
    for (int axis = 0; axis < dimension; ++axis) photon.position[axis] = rng.uniform();
    const Vec3 off = glm::abs(photon.position - middle(dimension));
    if (std::max(off.x, std::max(off.y, off.z)) < reach) photons.push_back(photon);
  }
  return photons;
}

/// The estimates at the middle of a map of uniform photons, by each kernel.
Densities middle_estimates(int dimension, uint64_t photons, const GatherSettings& settings, Rng& rng) {
  // What lies far beyond the k nearest, or the radius, has no part in the estimate.
  const double share = 1.5 * settings.count / static_cast<double>(photons);
  const float reach = settings.mode == GatherMode::radius ? 1.5f * settings.radius
                                                          : static_cast<float>(2.0 * std::pow(share, 1.0 / dimension));
  PhotonMap map = make_photon_map(middle_photons(dimension, photons, reach, rng), settings, photons);
  Densities found{};
  for (size_t i = 0; i < kKernels.size(); ++i) {
    map.settings.kernel = kKernels[i].kind;
    found[i] = kernel_estimate(dimension, map, middle(dimension)).r;
  }
  return found;
}

DensityFacts estimate_density(int dimension, uint64_t photons, const GatherSettings& settings, uint64_t maps,
                              uint64_t seed) {
  std::vector<Densities> found(maps);
  parallel_for_chunks(maps, 16, [&](size_t begin, size_t end, size_t) {
    for (size_t i = begin; i < end; ++i) {
      Rng rng(seed, rng_stream(RngUse::test, 0), i);
      found[i] = middle_estimates(dimension, photons, settings, rng);
    }
  });
  DensityFacts facts;
  for (const Densities& d : found) {
    for (size_t i = 0; i < d.size(); ++i) {
      facts.mean[i].add(d[i]);
      facts.square_error[i].add((d[i] - 1.0) * (d[i] - 1.0));
      facts.square_ratio[i].add(d[0] > 0.0 ? (d[i] / d[0]) * (d[i] / d[0]) : 0.0);
    }
    facts.volumes.push_back((settings.count - 1.0) / (static_cast<double>(photons) * d[0]));
  }
  return facts;
}

}  // namespace

DensityFacts estimate_nearest_density(int dimension, uint64_t photons, uint32_t k, uint64_t maps, uint64_t seed) {
  return estimate_density(dimension, photons, {GatherMode::nearest, kInfinity, k, {}}, maps, seed);
}

DensityFacts estimate_radius_density(int dimension, uint64_t photons, double radius, uint64_t maps, uint64_t seed) {
  return estimate_density(dimension, photons, {GatherMode::radius, static_cast<float>(radius), 0, {}}, maps, seed);
}

std::array<Moments, kBiasDensities> estimate_kernel_bias(int dimension, KernelKind kernel, double h, uint64_t shifts,
                                                         uint64_t seed) {
  constexpr std::array kSteps{1000.0, 48.0, 10.0};  // of a radius, by dimension: lattices of some thousand photons
  const double step = h / kSteps[static_cast<size_t>(dimension) - 1], cell = std::pow(step, dimension);
  const int reach = static_cast<int>(h / step) + 2;
  const int reach_y = dimension > 1 ? reach : 0, reach_z = dimension > 2 ? reach : 0;
  std::array<Moments, kBiasDensities> result;
  for (uint64_t shift = 0; shift < shifts; ++shift) {
    Rng rng(seed, rng_stream(RngUse::test, 0), shift);
    const Vec3d off(rng.uniform(), rng.uniform(), rng.uniform());
    std::vector<Photon> smooth, waves;
    for (int z = -reach_z; z <= reach_z; ++z)
      for (int y = -reach_y; y <= reach_y; ++y)
        for (int x = -reach; x <= reach; ++x) {
          Vec3d p = (Vec3d(x, y, z) + off) * step;
          for (int axis = dimension; axis < 3; ++axis) p[axis] = 0.0;
          Photon photon;
          photon.position = Vec3(p);
          photon.travel = PackedDirection(Vec3(0.0f, 0.0f, -1.0f));
          photon.power = Rgb(Vec3d(1.0 + p.x, 1.0 + glm::dot(p, p), 1.0) * cell);
          smooth.push_back(photon);
          const Vec3d phase = Vec3d(1.0, 2.0, 4.0) * (p.x / h);
          photon.power = Rgb((1.0 + glm::cos(phase)) * cell);
          waves.push_back(photon);
        }
    const GatherSettings settings{GatherMode::radius, static_cast<float>(h), 0, kernel};
    const Rgb s = kernel_estimate(dimension, make_photon_map(std::move(smooth), settings, 1), Vec3(0.0f));
    const Rgb w = kernel_estimate(dimension, make_photon_map(std::move(waves), settings, 1), Vec3(0.0f));
    result[0].add(s.r);
    result[1].add(s.g);
    for (int i = 0; i < 3; ++i) result[static_cast<size_t>(i) + 2].add(w[i]);
  }
  return result;
}

namespace {

template <int Dimension>
KernelIntegrals integrate(KernelKind kernel) {
  constexpr int kSteps = 20'000;
  const double unit = Dimension == 1 ? 2.0 : Dimension == 2 ? 2.0 * kPiD : 4.0 * kPiD;  // "surface" of the unit ball
  // The mean of cos(a x_1) over directions, for |x| = 1.
  const auto mean_cosine = [&](double a) {
    if (Dimension == 1) return std::cos(a);
    return Dimension == 2 ? std::cyl_bessel_j(0.0, a) : std::sin(a) / a;
  };
  KernelIntegrals sums;
  with_kernel<Dimension>(kernel, [&](auto profile) {
    for (int i = 0; i < kSteps; ++i) {
      const double r = (i + 0.5) / kSteps, shell = unit * std::pow(r, Dimension - 1) / kSteps;
      const double value = profile(static_cast<float>(r * r)).value;
      sums.volume += shell;
      sums.profile += value * shell;
      sums.square += value * value * shell;
      sums.second_moment += value * r * r * shell;
      for (size_t k = 0; k < 3; ++k) sums.cosine[k] += value * mean_cosine(static_cast<double>(1 << k) * r) * shell;
    }
    return 0;
  });
  return sums;
}

}  // namespace

KernelIntegrals integrate_kernel(int dimension, KernelKind kernel) {
  if (dimension == 1) return integrate<1>(kernel);
  return dimension == 2 ? integrate<2>(kernel) : integrate<3>(kernel);
}

double nearest_volume_below(double volume, uint32_t k, uint64_t n) {
  // k or more of the n photons lie in the volume.
  if (volume >= 1.0) return 1.0;
  const auto count = static_cast<double>(n);
  double fewer = 0.0;
  for (uint32_t j = 0; j < k; ++j)
    fewer += std::exp(std::lgamma(count + 1.0) - std::lgamma(j + 1.0) - std::lgamma(count - j + 1.0) +
                      j * std::log(volume) + (count - j) * std::log1p(-volume));
  return 1.0 - fewer;
}

}  // namespace vpm
