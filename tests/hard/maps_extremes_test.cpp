// Photon maps at their ends: photons that coincide by the thousand, none and one, radii beyond the scene, below the
// spacing of floats, and far from the origin.
#include "hard/hard_scenes.h"
#include "vpm/base/warp.h"
#include "vpm/estimate/surface_estimate.h"
#include "vpm/estimate/volume_estimate.h"

namespace vpm {
namespace {

constexpr GatherMode kModes[] = {GatherMode::radius, GatherMode::nearest};

/// The plain density of photons: the sum of K_r over them.
Rgb density_at(const Vec3& point, const PhotonMap& map) {
  return kernel_sum<3>(map, point, AnyPhoton{}, [](auto&&, const Rgb& p) { return p; }).value;
}
Rgb density_at(const Vec3& point, const std::vector<Photon>& photons, const GatherSettings& settings) {
  return kernel_sum<3>(photons, settings, uint64_t{1}, point, AnyPhoton{}, [](auto&&, const Rgb& p) { return p; })
      .value;
}

TEST(MapsExtremes, ThousandsAtOnePointWeighAsMuchAsTheirSum) {
  constexpr int kCount = 5000;
  const Vec3 spot(0.3f, -7.0f, 2.0f);
  const std::vector<Photon> photons(kCount, Photon{spot, PackedDirection(Vec3(0, -1, 0)), Rgb(0.5f)});
  for (const KernelInfo& info : kKernels) {
    const KernelKind kernel = info.kind;
    const GatherSettings settings{GatherMode::radius, 0.25f, 0, kernel};
    const PhotonMap map = make_photon_map(photons, settings, 1);
    const double at_it = kCount * 0.5 * kernel_norm_3d(kernel, 0.25f);
    EXPECT_NEAR(density_at(spot, map).r / at_it, 1.0, 1e-5);
    EXPECT_EQ(density_at(spot + Vec3(0.2501f, 0, 0), map), Rgb(0.0f));
    // From beside, k - 1 of them fill the ball that reaches them all: the constant kernel counts k - 1, the others,
    // which vanish at its border, none.
    const PhotonMap nearest = make_photon_map(photons, {GatherMode::nearest, 10.0f, 50, kernel}, 1);
    const double ball = kernel == KernelKind::constant ? 49 * 0.5 * kernel_norm_3d(kernel, 1.0f) : 0.0;
    EXPECT_NEAR(density_at(spot + Vec3(0, 0, 1), nearest).r, ball, 1e-5 * ball);
  }
}

TEST(MapsExtremes, KNearestWhereAllKCoincideWithTheQueryIsNoNumberAndCounted) {
  // The ball that k photons fill has no volume: an infinite density. No number stands for it; a render counts the
  // sample as dropped. The scene: a light so far from the origin that its photons share the spacing of floats.
  const std::vector<Photon> photons(50, Photon{Vec3(1.0f), PackedDirection(Vec3(0, -1, 0)), Rgb(1.0f)});
  const PhotonMap nearest = make_photon_map(photons, {GatherMode::nearest, 10.0f, 50, KernelKind::constant}, 1);
  EXPECT_FALSE(is_finite(density_at(Vec3(1.0f), nearest)));
  const PhotonMap fixed = make_photon_map(photons, {GatherMode::radius, 1.0f, 50, KernelKind::constant}, 1);
  EXPECT_NEAR(density_at(Vec3(1.0f), fixed).r, 50.0f * kernel_norm_3d(KernelKind::constant, 1.0f), 1e-4f);

  Scene scene;
  const float far = 1e8f;  // floats are 8 m apart: a floor of 16 m holds nine points
  add_shape(scene, quad_mesh(Vec3d(far, 0, far), Vec3d(0, 0, 16), Vec3d(16, 0, 0)), Lambertian{});
  scene.lights.push_back(DirectionalLight{Vec3(0, -1, 0), Rgb(1.0f)});
  scene.camera = make_camera(Vec3(far, 16, far), Vec3(far, 0, far), Vec3(1, 0, 0), 60.0f, {8, 8});
  scene.geometry.commit();
  finish(scene);
  RenderSettings settings = settings_of(100'000, 4.0f);  // most miss: the sphere around the scene is rounded up, too
  settings.direct.type = DirectLight::photons;
  settings.surface.mode = GatherMode::nearest;
  const Pass pass = render_photon_pass(scene, settings, 0);
  for (const Rgb& pixel : pass.image.pixels) EXPECT_TRUE(is_finite(pixel));
  EXPECT_GT(pass.statistics.eye.non_finite, 0u);
  settings.surface.mode = GatherMode::radius;
  clean_image(scene, settings);
}

TEST(MapsExtremes, NoPhotonAndOnePhoton) {
  for (const GatherMode mode : kModes) {
    const GatherSettings settings{mode, 2.0f, 1'000'000, KernelKind::epanechnikov};  // k is larger than any map
    const PhotonMap none = make_photon_map({}, settings, 7);
    EXPECT_EQ(none.size(), 0u);
    EXPECT_TRUE(none.bounds().empty());
    EXPECT_EQ(density_at(Vec3(0.0f), none), Rgb(0.0f));
    const PhotonMap one = make_photon_map({Photon{Vec3(1, 0, 0), {}, Rgb(3.0f)}}, settings, 3);
    EXPECT_FLOAT_EQ(density_at(Vec3(0.0f), one).r, 0.75f * kernel_norm_3d(KernelKind::epanechnikov, 2.0f));
    EXPECT_EQ(density_at(Vec3(-2, 0, 0), one), Rgb(0.0f));
  }
}

TEST(MapsExtremes, RadiiBeyondTheSceneTakeEveryPhoton) {
  std::vector<Photon> photons(3000);
  for (size_t i = 0; i < photons.size(); ++i) {
    Rng rng(1, rng_stream(RngUse::test, 0), i);
    photons[i] = {Vec3(rng.uniform(), rng.uniform(), rng.uniform()), {}, Rgb(1.0f)};
  }
  for (const float radius : {3.0f, 1e3f, 1e9f})
    for (const GatherMode mode : kModes) {
      const PhotonMap map = make_photon_map(photons, {mode, radius, 5000, KernelKind::constant}, 1);
      const double exact = 3000.0 * kernel_norm_3d(KernelKind::constant, radius);
      EXPECT_NEAR(density_at(Vec3(0.5f), map).r / exact, 1.0, 1e-4) << radius;
      EXPECT_NEAR(density_at(Vec3(-1, 0, 2), map).r / exact, 1.0, 1e-4) << radius;
    }
}

TEST(MapsExtremes, MapsFarFromTheOriginEqualTheBruteForceTwin) {
  // Coordinates of 1e6 m are 1/16 m apart; radii from many times that to below it, for slabs of some twenty radii.
  for (const float offset : {0.0f, 1e6f, -1.6e7f})
    for (const float radius : {1e-3f, 0.4f, 3.0f, 40.0f}) {
      std::vector<Photon> photons(4000);
      for (size_t i = 0; i < photons.size(); ++i) {
        Rng rng(2, rng_stream(RngUse::test, 1), i);
        photons[i].position = offset + 20.0f * radius * Vec3(rng.uniform(), rng.uniform(), 0.2f * rng.uniform());
        photons[i].power = Rgb(1.0f);
      }
      const GatherSettings settings{GatherMode::radius, radius, 20, KernelKind::constant};
      const PhotonMap map = make_photon_map(photons, settings, 1);
      for (uint64_t i = 0; i < 200; ++i) {
        Rng rng(3, rng_stream(RngUse::test, 2), i);
        const Vec3 at = photons[i * 17].position + 1.1f * radius * uniform_sphere(rng.uniform2());
        EXPECT_FLOAT_EQ(density_at(at, map).r, density_at(at, photons, settings).r)
            << "at " << offset << ", radius " << radius;
      }
    }
}

TEST(MapsExtremes, PhotonsInARowOfAMillionCellsEqualTheBruteForceTwin) {
  // A line along each axis: cells are counted in hundreds of thousands, and their borders must not drift.
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<Photon> photons(200'000);
    for (size_t i = 0; i < photons.size(); ++i) {
      photons[i].position = Vec3(1.0f);
      photons[i].position[axis] = 1e3f * static_cast<float>(i) / 200'000.0f;
      photons[i].power = Rgb(1.0f);
    }
    const GatherSettings settings{GatherMode::radius, 1e-2f, 20, KernelKind::constant};
    const PhotonMap map = make_photon_map(photons, settings, 1);
    for (uint64_t i = 0; i < 40; ++i) {
      Rng rng(3, rng_stream(RngUse::test, 3), i);
      Vec3 at(1.001f);
      at[axis] = 1e3f * rng.uniform();
      EXPECT_FLOAT_EQ(density_at(at, map).r, density_at(at, photons, settings).r) << axis;
    }
  }
}

TEST(MapsExtremes, AnEndlessThinMediumIsSeenInAPicturesTime) {
  // All space filled with next to nothing: photons collide a billion metres away, if at all, and the eye's march must
  // not walk there in steps of the radius. Radiance: single scattering of a light in all space is too faint to see, the
  // panel ahead is not.
  for (const float sigma : {1e-9f, 1e-6f, 1e-3f})
    for (const uint64_t photons : {1u, 2000u})
      for (const VolumeForm form : {VolumeForm::density_at_query, VolumeForm::density_at_photon}) {
        Scene scene;
        scene.media.push_back(make_medium(nullptr, Rgb(sigma), 0.5f));
        scene.world_medium = scene.camera_medium = 0;
        const QuadLight panel{Vec3(-1, -1, -2), Vec3(2, 0, 0), Vec3(0, 2, 0), Rgb(1.0f)};
        scene.lights.push_back(panel);
        add_shape(scene, quad_mesh(Vec3d(panel.corner), Vec3d(panel.edge_u), Vec3d(panel.edge_v)),
                  Lambertian{Rgb(0.0f)}, nullptr, 0);
        scene.camera = make_camera(Vec3(0, 0, 3), Vec3(0.0f), Vec3(0, 1, 0), 60.0f, {8, 8});
        scene.geometry.commit();
        finish(scene);
        RenderSettings settings = settings_of(photons, 0.02f);
        settings.volume.form = form;
        const Image image = clean_image(scene, settings);
        EXPECT_NEAR(image.at(4, 4).r, std::exp(-5.0 * sigma), 1e-4);
      }
}

}  // namespace
}  // namespace vpm
