// Pictures of which one ray in a square gathers for all: what is blurred, what is not, and what of it is stated.
#include <gtest/gtest.h>

#include "support/scenes.h"
#include "support/statistics.h"
#include "vpm/integrators/photon_map/photon_pass.h"

namespace vpm {
namespace {

constexpr float kHeight = 3.0f;  // m

/// A lamp above a floor, seen from below the lamp: about the middle of the picture light falls off as
/// 1 - 3/2 (r / kHeight)^2.
Scene lamp_over_floor() {
  Scene scene;
  scene.lights.push_back(SpotLight{Vec3(0.0f, kHeight, 0.0f), Vec3(0, -1, 0), 0.9f, 0.89f, Rgb(1.0f)});
  add_shape(scene, quad_mesh(Vec3(-3, 0, 3), Vec3(6, 0, 0), Vec3(0, 0, -6)), Lambertian{Rgb(0.5f, 0.25f, 1.0f)});
  scene.camera = make_camera(Vec3(0, 2, 0), Vec3(0.0f), Vec3(0, 0, 1), 10.0f, {8, 8});
  scene.geometry.commit();
  finish(scene);
  return scene;
}

RenderSettings settings_of(float radius, int square) {
  RenderSettings settings;
  settings.photons.emitted = 100'000;
  settings.surface.radius = radius;
  settings.radii = RadiusSchedule::constant;
  settings.direct.type = DirectLight::photons;
  settings.square = square;
  return settings;
}

/// Of the four pixels in the middle, and of their corrections.
KernelPair<double> middle_of(const Pass& pass) {
  KernelPair<double> sum;
  for (const int x : {3, 4})
    for (const int y : {3, 4}) sum += KernelPair<double>(pass.image.at(x, y).g / 4.0, pass.correction.at(x, y).g / 4.0);
  return sum;
}

// The blur's bias, half its variance times the Laplacian, at three radii: it does not depend on these, and is stated in
// proportion to theirs. Both pictures have the same photons, so that little noise is left; z-tests at 1e-6. Kernels
// take up to a tenth of the Laplacian, by terms of higher order.
TEST(SlowSharedGathers, BlurAsTheirVarianceSays) {
  const Scene scene = lamp_over_floor();
  const double pixel = 2.0 * std::tan(5.0 * kPiD / 180.0) * 2.0 / 8.0;  // m, on the floor
  const double variance = variance_in_square(4) * pixel * pixel;        // m^2
  for (const float radius : {0.6f, 0.45f, 0.36f}) {
    ASSERT_LT(variance, kMostBlur * variance_of({.radius = radius}, 2));
    Moments value, change, correction, stated;
    for (int pass = 0; pass < 40; ++pass) {
      const KernelPair<double> alone = middle_of(render_photon_pass(scene, settings_of(radius, 1), pass));
      const KernelPair<double> shared = middle_of(render_photon_pass(scene, settings_of(radius, 4), pass));
      value.add(alone.value);
      change.add(shared.value - alone.value);
      correction.add(alone.correction);
      stated.add(shared.correction);
    }
    const double expected = -3.0 * variance / (kHeight * kHeight) * value.mean();
    const double error = std::sqrt(change.variance_of_mean());
    EXPECT_LT(change.mean() - 4.9 * error, 0.9 * expected) << radius;
    EXPECT_GT(change.mean() + 4.9 * error, expected) << radius;
    EXPECT_LT(change.mean() + 4.9 * error, 0.0) << radius;
    EXPECT_NEAR(stated.mean() / correction.mean(), 1.0 + variance / variance_of({.radius = radius}, 2),
                4.9 * std::sqrt(stated.variance_of_mean()) / correction.mean())
        << radius;
  }
}

/// The sum over a picture's pixels of the mean over passes, and how many gathers were shared.
struct Found {
  Moments mean;
  uint64_t gathers = 0, shared = 0;
};
Found render(const Scene& scene, RenderSettings settings, int square, int passes) {
  settings.square = square;
  Found found;
  for (int pass = 0; pass < passes; ++pass) {
    const Pass one = render_photon_pass(scene, settings, pass);
    double sum = 0.0;
    for (const Rgb& p : one.image.pixels) sum += sum_channels(p);
    found.mean.add(sum);
    found.gathers += one.statistics.eye.volume_queries + one.statistics.eye.surface_queries;
    found.shared += one.statistics.eye.shared_gathers;
  }
  return found;
}

/// Fog in a room with a ball in front of its wall.
Scene foggy_room(const Phase& phase) {
  Scene scene;
  Medium fog = make_medium(nullptr, Rgb(0.6f, 0.5f, 0.4f), 0.8f);
  fog.phase = phase;
  scene.media.push_back(fog);
  const Interface media{0, kVacuum};
  add_shape(scene, box_mesh(Vec3d(-2.0), Vec3d(2.0)), Lambertian{Rgb(0.5f)}, &media);
  add_shape(scene, SphereShape{Vec3(0.4f, -0.5f, -0.7f), 0.6f}, Lambertian{Rgb(0.7f)}, nullptr);
  const QuadLight lamp{Vec3(-0.5f, 1.9f, -0.5f), Vec3(1, 0, 0), Vec3(0, 0, 1), Rgb(10.0f, 8.0f, 6.0f)};
  scene.lights.push_back(lamp);
  add_shape(scene, quad_mesh(lamp.corner, lamp.edge_u, lamp.edge_v), Lambertian{Rgb(0.0f)}, nullptr, 0);
  scene.camera = make_camera(Vec3(0.2f, 0.1f, 1.7f), Vec3(0, 0, -2), Vec3(0, 1, 0), 60.0f, {64, 64});
  scene.camera_medium = 0;
  scene.geometry.commit();
  finish(scene);
  return scene;
}

RenderSettings in_fog(std::string_view type) {
  RenderSettings settings;
  settings.photons.emitted = 4000;
  settings.volume.choose(type);
  settings.volume.radius = 0.3f;
  settings.surface.radius = 0.4f;
  return settings;
}

// Whatever gathers, pictures have the same light in all, from less than half of the gathers, and a crop has the bits
// of the whole.
TEST(SharedGathers, LeaveLightAsItIs) {
  const Scene scene = foggy_room(HenyeyGreenstein{0.4f});
  for (const char* type : {"beam", "photon-beams", "radius"}) {
    SCOPED_TRACE(type);
    const RenderSettings settings = in_fog(type);
    const Found alone = render(scene, settings, 1, 4), shared = render(scene, settings, 2, 4);
    EXPECT_EQ(alone.shared, 0u);
    EXPECT_GT(shared.shared, 4u * 2u * 64u * 64u * 3u / 4u * 7u / 10u);  // of four passes, in fog and on surfaces
    EXPECT_LT(shared.gathers, alone.gathers / 2);
    EXPECT_NEAR(shared.mean.mean(), alone.mean.mean(), 0.005 * alone.mean.mean());
    Scene cut = foggy_room(HenyeyGreenstein{0.4f});
    cut.camera.crop = PixelRect{20, 30, 37, 45};
    const Image whole = render_photon_pass(scene, settings, 3).image, part = render_photon_pass(cut, settings, 3).image;
    for (int y = 30; y < 45; ++y)
      for (int x = 20; x < 37; ++x) EXPECT_EQ(whole.at(x, y), part.at(x, y));
  }
}

// Light that is shared behind a medium has the throughput of each ray itself: a ball that absorbs, of an optical depth
// of up to 4, before fog. Pixels of the same photons may differ by what the blur moves, and no more.
TEST(SharedGathers, KeepTheThroughputOfEachRay) {
  Scene scene;
  scene.media = {make_medium(nullptr, Rgb(0.5f), 0.8f), make_medium(nullptr, Rgb(8.0f), 0.0f)};
  const Interface fog{0, kVacuum}, ball{1, kVacuum};
  add_shape(scene, box_mesh(Vec3d(-2, -2, -2), Vec3d(2, 2, 0)), Boundary{}, &fog);
  add_shape(scene, SphereShape{Vec3(0.0f, 0.0f, 1.0f), 0.25f}, Boundary{}, &ball);
  scene.lights.push_back(SphereLight{Vec3(0.0f, 3.0f, -1.0f), 0.2f, Rgb(100.0f)});
  scene.camera = make_camera(Vec3(0, 0, 3), Vec3(0.0f), Vec3(0, 1, 0), 40.0f, {64, 64});
  scene.geometry.commit();
  finish(scene);
  RenderSettings settings = in_fog("beam");
  settings.photons.emitted = 40'000;
  const auto mean_of = [&](int square) {
    RenderSettings own = settings;
    own.square = square;
    std::vector<double> mean(64 * 64);
    for (int pass = 0; pass < 8; ++pass) {
      const Pass one = render_photon_pass(scene, own, pass);
      EXPECT_EQ(one.statistics.eye.shared_gathers > 1000, square > 1);
      for (size_t i = 0; i < mean.size(); ++i) mean[i] += one.image.pixels[i].g / 8.0;
    }
    return mean;
  };
  const std::vector<double> alone = mean_of(1), shared = mean_of(2);
  double most = 0.0, least = kInfinity;
  for (size_t i = 0; i < alone.size(); ++i) {
    ASSERT_GT(alone[i], 0.0);
    most = std::max(most, alone[i]);
    least = std::min(least, alone[i]);
    EXPECT_NEAR(shared[i] / alone[i], 1.0, 0.25) << i % 64 << ' ' << i / 64;
  }
  EXPECT_GT(most, 30.0 * least);
}

// Nothing is shared where kernels are narrow beside pixels or have no one variance, in narrow peaks, and by shadow
// rays.
TEST(SharedGathers, AreNotMadeWhereTheyWouldBlur) {
  const Scene scene = foggy_room(HenyeyGreenstein{0.4f});
  RenderSettings narrow = in_fog("beam");
  narrow.volume.radius = narrow.surface.radius = 0.02f;
  EXPECT_EQ(render(scene, narrow, 2, 1).shared, 0u);
  RenderSettings by_count = in_fog("nearest");
  by_count.surface.mode = GatherMode::nearest;
  EXPECT_EQ(render(scene, by_count, 2, 1).shared, 0u);
  RenderSettings rays = in_fog("radius");
  rays.single_scattering.type = DirectLight::shadow_rays;
  rays.surface.kernel = KernelKind::order_4;
  EXPECT_EQ(render(scene, rays, 2, 1).shared, 0u);
  RenderSettings peak = in_fog("beam");
  peak.surface.kernel = KernelKind::order_4;
  EXPECT_EQ(render(foggy_room(HenyeyGreenstein{0.99f}), peak, 2, 1).shared, 0u);
}

/// A small lamp that a ball of glass shows in a few pixels.
Scene lamp_in_ball() {
  Scene scene;
  const QuadLight lamp{Vec3(-0.2f, 2.0f, -0.2f), Vec3(0.4f, 0, 0), Vec3(0, 0, 0.4f), Rgb(250.0f)};
  scene.lights.push_back(lamp);
  add_shape(scene, quad_mesh(lamp.corner, lamp.edge_u, lamp.edge_v), Lambertian{Rgb(0.0f)}, nullptr, 0);
  add_shape(scene, SphereShape{Vec3(0.0f, 0.5f, 0.0f), 0.5f}, Dielectric{1.5f}, nullptr);
  scene.camera = make_camera(Vec3(0, 1, 3), Vec3(0, 0.5f, 0), Vec3(0, 1, 0), 40.0f, {24, 24});
  scene.geometry.commit();
  finish(scene);
  return scene;
}

// Images of lamps have the same mean by rays of their own, and less than a fifth of the variance. A z-test at 1e-6.
TEST(LampImages, AreSeenByRaysOfTheirOwn) {
  const Scene scene = lamp_in_ball();
  RenderSettings settings;
  settings.photons.emitted = 10;
  const LampImages images(scene, settings.seed, settings.max_events);
  Moments without, with;
  for (int pass = 0; pass < 200; ++pass) {
    const auto sum = [&](const LampImages* of) {
      double light = 0.0;
      for (const Rgb& p : render_photon_pass_after({}, scene, settings, {pass, {}, {}, of}).image.pixels) light += p.g;
      return light;
    };
    without.add(sum(nullptr));
    with.add(sum(&images));
  }
  ASSERT_GT(without.mean(), 0.0);
  EXPECT_NEAR(with.mean(), without.mean(),
              4.9 * std::hypot(std::sqrt(with.variance_of_mean()), std::sqrt(without.variance_of_mean())));
  EXPECT_LT(with.variance(), 0.2 * without.variance());
  size_t marked = 0;
  for (size_t pixel = 0; pixel < 24u * 24u; ++pixel) marked += images.in(pixel) ? 1 : 0;
  EXPECT_GT(marked, 8u);
  EXPECT_LT(marked, 150u);
  EXPECT_FALSE(LampImages(lamp_over_floor(), 1, 100).in(0));
}

// A sky of one radiance lights what it alone sees without any noise: shadow rays go as the cosine law says.
TEST(SurfaceShadowRays, OfAnEvenSkyHaveNoNoise) {
  Scene scene;
  scene.lights.push_back(ConstantEnvironment{Rgb(2.0f, 1.0f, 0.5f)});
  add_shape(scene, quad_mesh(Vec3(-1, 0, 1), Vec3(2, 0, 0), Vec3(0, 0, -2)), Lambertian{Rgb(0.6f)});
  scene.camera = make_camera(Vec3(0, 1, 0.5f), Vec3(0.0f), Vec3(0, 1, 0), 20.0f, {6, 6});
  scene.geometry.commit();
  finish(scene);
  RenderSettings settings;
  settings.photons.emitted = 10;
  for (const Rgb& p : render_photon_pass(scene, settings, 0).image.pixels)
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(p[c], 0.6f * (c == 0 ? 2.0f : c == 1 ? 1.0f : 0.5f), 1e-5f);
}

}  // namespace
}  // namespace vpm
