// Photon beams met by a ray: one beam by hand, many in the mean.
#include "vpm/integrators/photon_map/volume/photon_beams.h"

#include <gtest/gtest.h>

#include "support/grids.h"
#include "support/scenes.h"

namespace vpm {
namespace {

constexpr float kBeamRadius = 0.1f;  // m

/// Beams in an endless medium, and a segment of a ray along x, from 0 to 2 m.
struct Crossed {
  Scene scene;
  EyeCounters counters;
  EyeScratch scratch;

  explicit Crossed(Medium medium) {
    scene.media.push_back(std::move(medium));
    scene.world_medium = 0;
    scene.lights.push_back(ConstantEnvironment{Rgb(1.0f)});
    scene.geometry.commit();
    finish(scene);
  }

  VolumeForm form = VolumeForm::density_at_query;
  bool long_beams = false;

  Rgb light_of(const std::vector<PhotonBeam>& beams, KernelKind kernel = KernelKind::epanechnikov,
               const std::vector<Photon>& collisions = {}) {
    VolumeSettings settings("photon-beams", {.radius = kBeamRadius, .kernel = kernel});
    settings.form = form;
    settings.density_floor = 0.0f;
    settings.length = long_beams ? BeamLength::long_beams : BeamLength::short_beams;
    PhotonBeams estimator(scene, settings, {});
    static_cast<BeamRecorder*>(estimator.recorders()[0])->beams[0] = beams;
    static_cast<CollisionRecorder*>(estimator.recorders()[1])->photons[0] = collisions;
    RenderStatistics statistics;
    estimator.build(1, statistics);
    Rng rng(1, 0, 0);
    EyeWork work{rng, counters, scratch};
    const EyeSegment segment(scene, {{Vec3(0.0f), Vec3(1.0f, 0.0f, 0.0f)}, {0.0f, 2.0f}, 0}, {});
    return estimator.along(segment, work).value;
  }
};

/// Crosses the ray at x = 1.2 m, 0.04 m beside it, 0.5 m from the beam's origin, at an angle of 30 degrees.
PhotonBeam slanted(float length) {
  const Vec3 direction(std::cos(kPi / 6), std::sin(kPi / 6), 0.0f);
  return {Vec3(1.2f, 0.0f, 0.04f) - 0.5f * direction, length, direction, Rgb(3.0f, 2.0f, 1.0f)};
}

/// The share of light that comes from beams rather than from collisions, by integrals of squared kernels.
float share_of_beams(KernelKind kernel, float sine, float sigma_t) {
  constexpr int kSteps = 2000;
  double line = 0.0, disc = 0.0;  // the integrals at the radius 1
  for (int i = 0; i < kSteps; ++i) {
    const float t = (static_cast<float>(i) + 0.5f) / kSteps;
    const float k1 = kernel_norm_1d(kernel, 1.0f) * with_kernel<1>(kernel, [&](auto of) { return of(t * t).value; });
    const float k2 = kernel_norm_2d(kernel, 1.0f) * with_kernel<2>(kernel, [&](auto of) { return of(t * t).value; });
    line += 2.0 * double{k1 * k1} / kSteps;
    disc += 2.0 * kPi * double{t * k2 * k2} / kSteps;
  }
  const double beams = kBeamRadius / line * double{sine}, points = kBeamRadius * kBeamRadius / disc * double{sigma_t};
  return static_cast<float>(beams / (beams + points));
}

TEST(PhotonBeams, OneBeamIsItsFiveFactors) {
  const Rgb sigma_t(0.7f), albedo(0.9f, 0.5f, 0.1f);
  Medium medium = make_medium(nullptr, sigma_t);
  medium.sigma_s = albedo * sigma_t;
  medium.phase = HenyeyGreenstein{0.4f};
  Crossed crossed(medium);
  for (const KernelInfo& info : kKernels) {
    const Rgb found = crossed.light_of({slanted(0.6f)}, info.kind);
    const float q = 0.4f * 0.4f;
    const float profile =
        with_kernel<1>(info.kind, [&](auto of) { return of(q).value; }) * kernel_norm_1d(info.kind, kBeamRadius);
    const float phase = phase_value(HenyeyGreenstein{0.4f}, slanted(0.6f).direction, Vec3(-1.0f, 0.0f, 0.0f));
    const Rgb light = Rgb(3.0f, 2.0f, 1.0f) * sigma_t * albedo * phase * std::exp(-0.7f * 1.2f) * profile / 0.5f *
                      share_of_beams(info.kind, 0.5f, 0.7f);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], light[c], 1e-4f * std::abs(light[c])) << info.name;
  }
}

TEST(PhotonBeams, ABeamEndsWhereItsPhotonCollides) {
  Crossed crossed(make_medium(nullptr, Rgb(0.7f)));
  EXPECT_GT(crossed.light_of({slanted(0.501f)}).g, 0.0f);
  EXPECT_EQ(crossed.light_of({slanted(0.499f)}).g, 0.0f);
}

// A collision beside the ray has the rest of the light of its direction; all of it where it flew along the ray.
TEST(PhotonBeams, CollisionsHaveTheOtherShare) {
  const float sigma_t = 0.7f;
  Crossed crossed(make_medium(nullptr, Rgb(sigma_t)));
  for (const KernelInfo& info : kKernels)
    for (const float sine : {0.0f, 0.01f, 0.5f, 1.0f}) {
      const Vec3 travel(std::sqrt(1.0f - sine * sine), sine, 0.0f);
      const Photon photon{Vec3(1.2f, 0.0f, 0.04f), PackedDirection(travel), Rgb(3.0f, 2.0f, 1.0f)};
      const Rgb found = crossed.light_of({}, info.kind, {photon});
      const float kernel =
          with_kernel<2>(info.kind, [&](auto of) { return of(0.16f).value; }) * kernel_norm_2d(info.kind, kBeamRadius);
      const float share = 1.0f - share_of_beams(info.kind, sine, sigma_t);
      const Rgb light = Rgb(3.0f, 2.0f, 1.0f) * std::exp(-sigma_t * 1.2f) * kernel * share * 0.5f / (4.0f * kPi);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], light[c], 2e-3f * light[c]) << info.name << " " << sine;
    }
}

// Where a photon has come as far as to the crossing, its colours are those of the mixture that its flight was drawn by.
TEST(PhotonBeams, ChromaticBeamsCarryTheWeightsOfTheirMixture) {
  const Rgb sigma_t(0.2f, 1.0f, 3.0f), power(3.0f, 2.0f, 1.0f);
  Crossed crossed(make_medium(nullptr, sigma_t));
  const Rgb found = crossed.light_of({slanted(0.6f)});
  const Rgb come = glm::exp(-sigma_t * 0.5f), weight = come / glm::dot(power / 6.0f, come);
  const float kernel =
      0.75f / kBeamRadius * (1.0f - 0.16f) / 0.5f / (4.0f * kPi) * share_of_beams(KernelKind::epanechnikov, 0.5f, 1.4f);
  const Rgb light = power * weight * 0.5f * sigma_t * glm::exp(-sigma_t * 1.2f) * kernel;
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], light[c], 1e-4f * light[c]);
}

/// In a grid whose density rises evenly, 0.2 + 0.3 x + 2 z: what scatters is the density on the ray or on the beam, and
/// light has come through the density between. A long beam's photon need not have come so far.
TEST(PhotonBeams, AreAttenuatedByTheDensityOnTheirWay) {
  const GridFrame frame = centered_frame(16, 0.25);
  Crossed crossed(make_medium(make_grid(frame,
                                        [](int x, int y, int z) {
                                          const Vec3d at = 0.25 * Vec3d(x, y, z);
                                          return std::max(0.0, 0.2 + 0.3 * at.x + 2.0 * at.z);
                                        }),
                              Rgb(0.7f)));
  const float on_ray = 0.2f + 0.3f * 1.2f, on_beam = on_ray + 2.0f * 0.04f;
  const float to_eye = std::exp(-0.7f * (0.2f * 1.2f + 0.15f * 1.2f * 1.2f));
  const float middle = 1.2f - 0.25f * std::cos(kPi / 6);  // of the beam before the crossing, which rises with x alone
  const float come = std::exp(-0.7f * 0.5f * (0.2f + 0.3f * middle + 2.0f * 0.04f));
  const float kernel = 0.75f / kBeamRadius * (1.0f - 0.16f) / 0.5f / (4.0f * kPi);
  for (const VolumeForm form : {VolumeForm::density_at_query, VolumeForm::density_at_photon})
    for (const bool long_beams : {false, true}) {
      crossed.form = form;
      crossed.long_beams = long_beams;
      const float density = form == VolumeForm::density_at_query ? on_ray : on_beam;
      const float light = 3.0f * 0.5f * 0.7f * density * to_eye * kernel * (long_beams ? come : 1.0f) *
                          share_of_beams(KernelKind::epanechnikov, 0.5f, 0.7f * on_ray);
      EXPECT_NEAR(crossed.light_of({slanted(0.6f)}).r, light, 1e-3f * light) << long_beams;
    }
}

/// Beside those along the ray: a long beam's density integral, and the density at the photon.
TEST(PhotonBeams, LookUpsOfDensityAreCounted) {
  const PhotonBeam beam = slanted(0.6f);
  Crossed crossed(
      make_medium(make_grid(centered_frame(16, 0.25), [](int x, int, int) { return 2.0 + 0.01 * x; }), Rgb(0.7f)));
  const auto lookups = [&](VolumeForm form, bool long_beams) {
    crossed.form = form;
    crossed.long_beams = long_beams;
    crossed.counters = {};
    crossed.light_of({beam});
    return crossed.counters.walk.lookups;
  };
  const uint64_t along_ray = lookups(VolumeForm::density_at_query, false);
  const uint64_t along_beam =
      density_integral(crossed.scene.media[0], {beam.origin, beam.direction}, {0.0f, 0.5f}).lookups;
  ASSERT_GT(along_beam, 1u);
  EXPECT_EQ(lookups(VolumeForm::density_at_query, true), along_ray + along_beam);
  EXPECT_EQ(lookups(VolumeForm::density_at_photon, false), along_ray + 1);
  EXPECT_EQ(lookups(VolumeForm::density_at_photon, true), along_ray + along_beam + 1);
}

}  // namespace
}  // namespace vpm
