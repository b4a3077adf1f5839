// Kernels of any radius, packed directions, and both maps against the plain list, for any photons: spread, in a plane,
// on a line, at few points, near and far.
#include "support/properties.h"
#include "vpm/base/rng.h"
#include "vpm/base/warp.h"
#include "vpm/estimate/surface_estimate.h"
#include "vpm/estimate/volume_estimate.h"

namespace vpm {
namespace {

rc::Gen<KernelKind> any_kernel() {
  return rc::gen::map(rc::gen::elementOf(std::vector<KernelInfo>(kKernels.begin(), kKernels.end())),
                      [](const KernelInfo& k) { return k.kind; });
}

/// The integral of the kernel of radius r over its interval, disc or ball.
template <int Dimension>
void check_kernel(KernelKind kind, float r) {
  with_kernel<Dimension>(kind, [&](auto profile) {
    constexpr int kSteps = 2000;
    double sum = 0.0;
    float last = profile(0.0f).value;
    for (int i = 0; i < kSteps; ++i) {
      const double t = (i + 0.5) / kSteps;  // the distance over the radius
      const float value = profile(static_cast<float>(t * t)).value;
      RC_ASSERT(kernel_order(kind) == 4 || (value >= 0.0f && value <= last));
      last = value;
      constexpr double kSphere = Dimension == 1 ? 2.0 : 2.0 * (Dimension - 1) * kPiD;  // of radius 1
      sum += value * kSphere * std::pow(t, Dimension - 1) / kSteps;
    }
    RC_ASSERT(std::abs(sum * std::pow(double{r}, Dimension) * kernel_norm<Dimension>(kind, r) - 1.0) < 1e-5);
    RC_ASSERT(kind == KernelKind::constant || profile(1.0f).value == 0.0f);
    return 0;
  });
}

RC_GTEST_PROP(KernelProperty, IsNormalisedFallsAndEndsAtItsRadius, ()) {
  const KernelKind kind = *any_kernel();
  const auto r = static_cast<float>(*magnitude(1e-9, 1e9));
  check_kernel<1>(kind, r);
  check_kernel<2>(kind, r);
  check_kernel<3>(kind, r);
}

RC_GTEST_PROP(PackedDirectionProperty, IsUnitAndOffByAtMostItsBound, ()) {
  const Vec3 d = *unit_vector();
  const Vec3 back = PackedDirection(d).unpack();
  RC_ASSERT(std::abs(glm::length(Vec3d(back)) - 1.0) < 3e-7);
  RC_ASSERT(glm::distance(Vec3d(back), Vec3d(d)) < 7e-5);
  RC_ASSERT(glm::distance(PackedDirection(back).unpack(), back) < 1e-6f);  // once packed it stays
}

enum class RandomLayout { spread, plane, line, points, scales };

/// Photons of whole powers, so that sums in any order are exact. Where coordinates coincide so do powers, or the k
/// nearest would depend on the choice among equals.
std::vector<Photon> any_photons() {
  const auto layout = *rc::gen::element(RandomLayout::spread, RandomLayout::plane, RandomLayout::line,
                                        RandomLayout::points, RandomLayout::scales);
  const Vec3 offset = *rc::gen::element(Vec3(0.0f), Vec3(-100.0f, 3.0f, 1e4f), Vec3(1e6f));
  const int count = *rc::gen::inRange(0, 300);
  const auto seed = *rc::gen::arbitrary<uint64_t>();
  std::vector<Photon> photons(static_cast<size_t>(count));
  for (size_t i = 0; i < photons.size(); ++i) {
    Rng rng(seed, rng_stream(RngUse::test, 0), i);
    Vec3 p(rng.uniform(), rng.uniform(), rng.uniform());
    if (layout == RandomLayout::plane) p.y = 0.5f;
    if (layout == RandomLayout::line) p.x = p.y = 0.5f;
    if (layout == RandomLayout::points) p = glm::floor(2.0f * p);
    if (layout == RandomLayout::scales) p *= std::pow(10.0f, -6.0f * rng.uniform());
    photons[i] = {offset + p, PackedDirection(Vec3(0, -1, 0)), Rgb(1.0f, 2.0f, 4.0f)};
  }
  return photons;
}

Vec3 any_query(const std::vector<Photon>& photons, float radius) {
  const Vec3 off = static_cast<float>(*number(0.0, 1.5)) * radius * *unit_vector();
  if (photons.empty()) return off;
  return photons[static_cast<size_t>(*rc::gen::inRange<int64_t>(0, static_cast<int64_t>(photons.size())))].position +
         off;
}

/// Equal but for rounding: of the sums, and of kernels of that norm next to their radius, where they vanish or change
/// their sign. k photons at the query itself have no finite density: both must say so.
bool same(const Rgb& a, const Rgb& b, float norm) {
  if (!is_finite(a) || !is_finite(b)) return is_finite(a) == is_finite(b);
  return glm::all(glm::lessThanEqual(glm::abs(a - b), 1e-5f * glm::abs(b) + 1e-5f * norm));
}
/// Corrections change signs within the kernel, and do not vanish at its radius: they are equal but for rounding of what
/// values add up to, of a few parts in 1e6 of the kernel's norm for each photon, and of their own floats, which is most
/// where all photons lie at the rim: the value is 0 there.
bool same(const KernelEstimate& a, const KernelEstimate& b, float norm) {
  if (!is_finite(a.correction) || !is_finite(b.correction)) return is_finite(a.correction) == is_finite(b.correction);
  return same(a.value, b.value, norm) &&
         glm::all(glm::lessThanEqual(glm::abs(a.correction - b.correction),
                                     1e-4f * (glm::abs(b.value) + norm) + 1e-6f * glm::abs(b.correction)));
}

RC_GTEST_PROP(MapProperty, EqualsTheBruteForceTwinForAnyPhotons, ()) {
  const std::vector<Photon> photons = any_photons();
  const GatherSettings settings{*rc::gen::element(GatherMode::radius, GatherMode::nearest),
                                static_cast<float>(*rc::gen::oneOf(magnitude(0.05, 2.0), magnitude(1e-7, 1e3))),
                                static_cast<uint32_t>(*rc::gen::inRange(2, 400)), *any_kernel()};
  const PhotonMap map = make_photon_map(photons, settings, 1);
  RC_ASSERT(map.size() == photons.size());
  for (const Photon& p : photons) RC_ASSERT(map.bounds().contains(p.position));
  for (int i = 0; i < 10; ++i) {
    const Vec3 at = any_query(photons, settings.radius), up(0, 1, 0);
    RC_ASSERT(same(volume_sum(Isotropic{}, at, up, map),
                   volume_sum(Isotropic{}, at, up, photons, settings, uint64_t{1}),
                   kernel_norm<3>(settings.kernel, settings.radius)));
    RC_ASSERT(same(surface_irradiance(at, up, map), surface_irradiance(at, up, photons, settings, uint64_t{1}),
                   kernel_norm<2>(settings.kernel, settings.radius)));
  }
}

RC_GTEST_PROP(MapProperty, AnswersRadiiItWasNotMadeForAndCounts, ()) {
  const std::vector<Photon> photons = any_photons();
  const GatherSettings made{GatherMode::radius, static_cast<float>(*magnitude(1e-3, 1e1)), 0, *any_kernel()};
  const PhotonMap map = make_photon_map(photons, made, 1);
  for (int i = 0; i < 10; ++i) {
    GatherSettings own = made;
    own.radius *= static_cast<float>(*magnitude(0.02, 50.0));
    const Vec3 at = any_query(photons, own.radius), up(0, 1, 0);
    GatherCounters counters;
    Neighbours near;
    RC_ASSERT(same(surface_irradiance(at, up, CountedMap{map, GatherWork{counters, near}, own}).value,
                   surface_irradiance(at, up, photons, own, uint64_t{1}).value,
                   kernel_norm<2>(made.kernel, own.radius)));
    const Arrives arrives{up, plane_thickness(own)};
    const auto counts = [&](const Photon& p) {
      const Vec3 offset = p.position - at;
      return glm::dot(offset, offset) < own.radius * own.radius && arrives(p.travel, offset);
    };
    RC_ASSERT(counters.used == static_cast<uint64_t>(std::count_if(photons.begin(), photons.end(), counts)));
    RC_ASSERT(counters.used <= counters.visited && counters.visited <= photons.size());
  }
}

RC_GTEST_PROP(MapProperty, DoesNotDependOnTheOrderOfPhotonsOrTheirScale, ()) {
  std::vector<Photon> photons = any_photons();
  const GatherSettings settings{*rc::gen::element(GatherMode::radius, GatherMode::nearest),
                                static_cast<float>(*magnitude(1e-3, 1e1)), 20, *any_kernel()};
  const Vec3 at = any_query(photons, settings.radius);
  const PhotonMap map = make_photon_map(photons, settings, 1);
  std::reverse(photons.begin(), photons.end());
  for (Photon& p : photons) p.power *= 8.0f;
  const PhotonMap turned = make_photon_map(photons, settings, 8);
  const Rgb a = volume_sum(Isotropic{}, at, Vec3(0, 0, 1), map).value,
            b = volume_sum(Isotropic{}, at, Vec3(0, 0, 1), turned).value;
  RC_ASSERT(same(a, b, kernel_norm<3>(settings.kernel, settings.radius)));
}

}  // namespace
}  // namespace vpm
