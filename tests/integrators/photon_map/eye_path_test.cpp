// Eye paths at smooth glass, both of whose sides they follow. What weak sides count on average is checked by `vpm
// validate`.
#include "vpm/integrators/photon_map/eye_path.h"

#include <gtest/gtest.h>

#include "support/scenes.h"
#include "vpm/base/warp.h"
#include "vpm/surface/material/fresnel.h"

namespace vpm {
namespace {

constexpr float kIor = 1.5f;

TEST(EyePath, SeesLampsOnBothSidesOfGlassWithoutNoise) {
  Scene scene;
  add_shape(scene, quad_mesh(Vec3(-3, -3, 0), Vec3(6, 0, 0), Vec3(0, 6, 0)), ThinDielectric{kIor});
  const QuadLight behind{Vec3(-1, -1, -4), Vec3(2, 0, 0), Vec3(0, 2, 0), Rgb(3.0f)};
  const QuadLight reflected{Vec3(-1, -1, 4), Vec3(0, 2, 0), Vec3(2, 0, 0), Rgb(100.0f)};
  for (const QuadLight& lamp : {behind, reflected}) {
    scene.lights.push_back(lamp);
    add_shape(scene, quad_mesh(lamp.corner, lamp.edge_u, lamp.edge_v), Lambertian{Rgb(0.0f)}, nullptr,
              static_cast<int>(scene.lights.size()) - 1);
  }
  scene.geometry.commit();
  finish(scene);
  const Estimators none;
  const double of_face = fresnel_dielectric(1.0f, kIor), of_pane = 2.0 * of_face / (1.0 + of_face);
  for (uint64_t i = 0; i < 100; ++i) {
    Rng rng(1, rng_stream(RngUse::test, 0), i);
    EyeScratch scratch;
    EyeCounters counters;
    EyeWork work{rng, counters, scratch};
    const double seen = eye_radiance({scene, none}, {Vec3(0.1f, 0.2f, 2.0f), Vec3(0, 0, -1)}, work).value.r;
    EXPECT_NEAR(seen, 100.0 * of_pane + 3.0 * (1.0 - of_pane), 1e-5);
  }
}

/// Finds no light, but counts how often it is asked.
class Asked final : public VolumeEstimator {
 public:
  ScatteredLight finds() const override { return {}; }
  KernelEstimate along(const EyeSegment&, EyeWork& work) const override {
    ++work.counters.volume_queries;
    return Rgb(0.0f);
  }
};

// Glass in glass in a box of mirrors: no branch ever ends by itself, and there are no more than there may be.
TEST(EyePath, TheBranchesOfGlassAreBounded) {
  Scene scene;
  add_shape(scene, box_mesh(Vec3d(-2.0), Vec3d(2.0)), Mirror{Rgb(1.0f)});
  add_shape(scene, SphereShape{Vec3(0.0f), 1.0f}, Dielectric{kIor});
  add_shape(scene, SphereShape{Vec3(0.1f, 0.0f, 0.0f), 0.7f}, Dielectric{1.7f});
  scene.geometry.commit();
  finish(scene);
  Estimators asked;
  asked.volume.push_back(std::make_unique<Asked>());
  constexpr int kEvents = 50;
  constexpr uint64_t kMost = 256;
  uint64_t most = 0;
  for (uint64_t i = 0; i < 200; ++i) {
    Rng rng(1, rng_stream(RngUse::test, 1), i);
    EyeScratch scratch;
    EyeCounters counters;
    EyeWork work{rng, counters, scratch};
    eye_radiance({scene, asked, kEvents}, {Vec3(0.3f, -0.2f, 1.8f), uniform_sphere(rng.uniform2())}, work);
    EXPECT_LE(counters.volume_queries, kMost * kEvents);
    most = std::max(most, counters.cut_paths);
  }
  EXPECT_GT(most, kMost / 8);
  EXPECT_LE(most, kMost);
}

}  // namespace
}  // namespace vpm
