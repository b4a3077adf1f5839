// Rays from the camera followed together find what each finds alone.
#include <gtest/gtest.h>

#include "support/scenes.h"
#include "vpm/integrators/combined/combined_pass.h"
#include "vpm/integrators/photon_map/eye_path.h"
#include "vpm/integrators/photon_map/photon_pass.h"

namespace vpm {
namespace {

constexpr int kEdge = 8;  // rays along an edge of a bundle

Medium fog(const Rgb& sigma_t, const Phase& phase) {
  Medium medium = make_medium(nullptr, sigma_t);
  medium.sigma_s = 0.8f * sigma_t;
  medium.phase = phase;
  return medium;
}

void light_up(Scene& scene) {
  const QuadLight lamp{Vec3(-0.5f, 1.9f, -0.5f), Vec3(1, 0, 0), Vec3(0, 0, 1), Rgb(10.0f, 8.0f, 6.0f)};
  scene.lights.push_back(lamp);
  add_shape(scene, quad_mesh(lamp.corner, lamp.edge_u, lamp.edge_v), Lambertian{Rgb(0.0f)}, nullptr, 0);
}

/// A room full of fog, with a ball of glass.
Scene room(const Medium& medium) {
  Scene scene;
  scene.media.push_back(medium);
  const Interface media{0, kVacuum};
  add_shape(scene, box_mesh(Vec3d(-2.0), Vec3d(2.0)), Lambertian{Rgb(0.5f)}, &media);
  const Interface glass{kVacuum, 0};
  add_shape(scene, SphereShape{Vec3(0.7f, -0.5f, -0.7f), 0.6f}, Dielectric{1.5f}, &glass);
  light_up(scene);
  scene.geometry.commit();
  finish(scene);
  return scene;
}

/// Two balls of fog side by side, and a grid, over a floor.
Scene balls(const Medium& medium) {
  Scene scene;
  scene.media = {medium, fog(Rgb(3.0f, 1.0f, 0.5f), Isotropic{})};
  const Interface left{0, kVacuum}, right{1, kVacuum};
  add_shape(scene, SphereShape{Vec3(-0.6f, 0.0f, 0.0f), 0.6f}, Boundary{}, &left);
  add_shape(scene, SphereShape{Vec3(0.6f, 0.0f, 0.0f), 0.6f}, Boundary{}, &right);
  add_shape(scene, quad_mesh(Vec3(-2, -1, -2), Vec3(0, 0, 4), Vec3(4, 0, 0)), Lambertian{Rgb(0.5f)});
  light_up(scene);
  scene.geometry.commit();
  finish(scene);
  return scene;
}

/// Rays of a bundle, each with random numbers of its own.
struct Bundle {
  EyeCounters counters{};
  EyeScratch scratch{};
  std::vector<Rng> rngs{};
  std::vector<EyeRay> rays{};

  Bundle(const Vec3& from, const Vec3& towards, float width) {
    const Vec3 ahead = glm::normalize(towards - from);
    Vec3 right, up;
    make_frame(ahead, right, up);
    rngs.reserve(kEdge * kEdge);
    for (int i = 0; i < kEdge * kEdge; ++i) {
      const Vec2 place = (Vec2(i % kEdge, i / kEdge) / float{kEdge} - 0.5f) * width;
      Rng& rng = rngs.emplace_back(5, rng_stream(RngUse::test, 0), static_cast<uint64_t>(i));
      rays.push_back({{from, glm::normalize(ahead + place.x * right + place.y * up)}, {rng, counters, scratch}});
    }
  }
};

/// Light and corrections that bundles find are those that their rays find alone, to rounding: a photon at the rim of a
/// kernel may be on either side of it, where the kernel is next to nothing. Of rays that go together, as those of
/// narrow bundles do, some sums are not the very same.
template <class OfRays, class OfRay>
void expect_alike_by(OfRays&& of_rays, OfRay&& of_ray, const Vec3& from, const Vec3& towards, bool go_together) {
  for (const float width : {0.05f, 0.8f}) {
    Bundle together(from, towards, width), alone(from, towards, width);
    of_rays(std::span<EyeRay>(together.rays));
    float largest = 0.0f;
    for (EyeRay& ray : alone.rays) {
      ray.radiance = of_ray(ray.ray, ray.work);
      largest = std::max(largest, max_channel(ray.radiance.value));
    }
    ASSERT_GT(largest, 0.0f);
    bool same = true;
    for (size_t i = 0; i < alone.rays.size(); ++i) {
      const KernelEstimate &a = together.rays[i].radiance, &b = alone.rays[i].radiance;
      same &= a.value == b.value;
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(a.value[c], b.value[c], 2e-4f * largest) << i;
        EXPECT_NEAR(a.correction[c], b.correction[c], 2e-4f * largest) << i;
      }
    }
    if (width < 0.1f) {
      EXPECT_EQ(same, !go_together);
    }
    const auto used = static_cast<double>(alone.counters.gather.used);
    EXPECT_GT(used, 100.0);
    EXPECT_NEAR(static_cast<double>(together.counters.gather.used), used, 1e-4 * used + 2.0);
    EXPECT_EQ(together.counters.used_in_media - alone.counters.used_in_media,
              alone.counters.used_in_media > 0 ? together.counters.gather.used - alone.counters.gather.used : 0);
  }
}

void expect_alike(const Scene& scene, const RenderSettings& settings, const Vec3& from, const Vec3& towards,
                  bool go_together = true) {
  const Estimators estimators = plan_estimators(scene, settings, 0);
  RenderStatistics statistics;
  prepare_pass(scene, settings, estimators, {}, statistics);
  const EyeContext context{scene, estimators};
  expect_alike_by([&](std::span<EyeRay> rays) { eye_radiance(context, rays); },
                  [&](const Ray& ray, EyeWork& work) { return eye_radiance(context, ray, work); }, from, towards,
                  go_together);
}

/// The same of techniques combined.
void expect_combined_alike(Scene& scene, const RenderSettings& settings, const Vec3& from, const Vec3& towards,
                           bool go_together = true) {
  scene.camera = make_camera(from, towards, Vec3(0, 1, 0), 60.0f, {kEdge, kEdge});
  const CombinedPass pass(scene, settings, 0);
  expect_alike_by([&](std::span<EyeRay> rays) { pass.radiance(rays); },
                  [&](const Ray& ray, EyeWork& work) { return pass.radiance(ray, work); }, from, towards, go_together);
}

RenderSettings settings_of(std::string_view type, KernelKind kernel, BoundaryRule boundary) {
  RenderSettings settings;
  settings.photons.emitted = 2000;
  settings.volume.planes = 50;
  settings.volume.choose(type);
  settings.volume.radius = type == "beam" ? 0.2f : 0.1f;
  settings.volume.kernel = kernel;
  settings.volume.boundary = boundary;
  return settings;
}

constexpr std::array<std::string_view, 3> kTypes{"beam", "photon-beams", "photon-planes"};

TEST(EyeRays, TogetherFindWhatEachFindsAlone) {
  const Scene grey = room(fog(Rgb(0.7f), HenyeyGreenstein{0.6f}));
  for (const std::string_view type : kTypes)
    for (const BoundaryRule boundary : {BoundaryRule::none, BoundaryRule::ends})
      for (const Vec3& towards : {Vec3(-2.0f, 0.3f, -2.0f), Vec3(0.7f, -0.5f, -0.7f)}) {  // the corner, the glass
        SCOPED_TRACE(type);
        expect_alike(grey, settings_of(type, KernelKind::epanechnikov, boundary), Vec3(0.2f, 0.1f, 1.7f), towards);
      }
}

TEST(EyeRays, HaveEveryKernelAndPhaseFunction) {
  for (const Phase& phase : {Phase(Isotropic{}), Phase(Rayleigh{}), Phase(HenyeyGreenstein{-0.4f})}) {
    const Scene scene = room(fog(Rgb(0.7f), phase));
    for (const KernelInfo& info : kKernels)
      for (const char* type : {"beam", "photon-beams"})
        expect_alike(scene, settings_of(type, info.kind, BoundaryRule::ends), Vec3(0.2f, 0.1f, 1.7f),
                     Vec3(-1.0f, 0.3f, -2.0f));
  }
}

// What beams have left of their powers, in chromatic fog and beyond the collisions of their photons.
TEST(EyeRays, CrossBeamsThatFade) {
  for (const Rgb& sigma_t : {Rgb(0.7f), Rgb(1.5f, 0.7f, 0.2f)})
    for (const BeamLength length : {BeamLength::short_beams, BeamLength::long_beams}) {
      const Scene scene = room(fog(sigma_t, Isotropic{}));
      RenderSettings settings = settings_of("photon-beams", KernelKind::epanechnikov, BoundaryRule::ends);
      settings.volume.length = length;
      expect_alike(scene, settings, Vec3(0.2f, 0.1f, 1.7f), Vec3(-1.0f, 0.3f, -2.0f));
    }
}

TEST(EyeRays, MayBeInDifferentMedia) {
  const Scene scene = balls(fog(Rgb(2.0f, 1.0f, 0.2f), Isotropic{}));
  for (const std::string_view type : kTypes)
    for (const Vec3& towards : {Vec3(0.0f), Vec3(-0.9f, 0.1f, 0.0f)}) {
      SCOPED_TRACE(type);
      expect_alike(scene, settings_of(type, KernelKind::epanechnikov, BoundaryRule::ends), Vec3(0.0f, 0.3f, 3.0f),
                   towards);
    }
}

// Estimators that ask for the density integrals of a segment, one after another, for each segment of a bundle.
TEST(EyeRays, HaveDensityIntegralsOfTheirOwn) {
  const Scene scene = room(fog(Rgb(0.7f), Isotropic{}));
  RenderSettings settings = settings_of("photon-planes", KernelKind::epanechnikov, BoundaryRule::ends);
  settings.single_scattering.type = DirectLight::equiangular;
  expect_alike(scene, settings, Vec3(0.2f, 0.1f, 1.7f), Vec3(-1.0f, 0.3f, -2.0f));
}

// Kernels reach past the border that a slanted ray enters by, and so behind a camera that stands right before it: these
// rays go one by one.
TEST(EyeRays, MayBeginJustBeforeABorder) {
  Scene scene = boxed_medium(fog(Rgb(1.0f), Isotropic{}), ConstantEnvironment{Rgb(1.0f)});
  for (const std::string_view type : kTypes)
    expect_alike(scene, settings_of(type, KernelKind::epanechnikov, BoundaryRule::ends), Vec3(0.0f, 1.01f, 0.0f),
                 Vec3(0.0f, 0.8f, -0.9f), false);
}

/// Short and long beams among all other techniques, by each heuristic; from lamps of which samples depend on the place,
/// and of parallel light.
TEST(EyeRays, TechniquesCombinedFindTogetherWhatTheyFindAlone) {
  const Vec3 from(0.2f, 0.1f, 1.7f);
  for (const Rgb& sigma_t : {Rgb(0.7f), Rgb(0.2f, 1.0f, 3.0f)})
    for (const Heuristic heuristic : {Heuristic::balance, Heuristic::power, Heuristic::correlation_aware}) {
      Scene scene = room(fog(sigma_t, HenyeyGreenstein{0.6f}));
      scene.lights.push_back(SphereLight{Vec3(-1.0f, -1.0f, -1.0f), 0.2f, Rgb(30.0f)});
      scene.lights.push_back(BeamLight{Vec3(1.5f, 1.0f, -1.0f), Vec3(-1.0f, 0.0f, 0.0f), 0.3f, Rgb(20.0f)});
      finish_again(scene);
      RenderSettings settings = settings_of("radius", KernelKind::epanechnikov, BoundaryRule::none);
      settings.integrator = Integrator::combined;
      settings.volume.radius = 0.3f;
      settings.combined.heuristic = heuristic;
      for (const Vec3& towards : {Vec3(-2.0f, 0.3f, -2.0f), Vec3(0.7f, -0.5f, -0.7f)})
        expect_combined_alike(scene, settings, from, towards);
    }
}

/// Rays through several media, of which one is a grid.
TEST(EyeRays, TechniquesCombinedGoThroughSeveralMedia) {
  RenderSettings settings = settings_of("radius", KernelKind::biweight, BoundaryRule::none);
  settings.integrator = Integrator::combined;
  settings.volume.radius = 0.3f;
  Scene two_balls = balls(fog(Rgb(0.7f), Isotropic{}));
  expect_combined_alike(two_balls, settings, Vec3(-3.0f, 0.1f, 0.2f), Vec3(0.0f));
  const Medium grid =
      make_medium(make_grid(centered_frame(16, 0.1), [](int x, int, int) { return 1.0 + 0.05 * x; }), Rgb(0.7f), 0.8f);
  Scene cloudy = room(grid);
  expect_combined_alike(cloudy, settings, Vec3(0.2f, 0.1f, 1.7f), Vec3(-2.0f, 0.3f, -2.0f), false);
}

}  // namespace
}  // namespace vpm
