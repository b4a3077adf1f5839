// Radii of pixels' own against the textbook of stochastic progressive photon mapping: its three numbers a pixel, R, N
// and the flux tau, kept by the rules as they are printed [Hachisuka2009].
#include "vpm/film/pixel_disc.h"

#include <gtest/gtest.h>

#include <cstring>

#include "support/scenes.h"
#include "support/statistics.h"
#include "vpm/base/parallel.h"
#include "vpm/base/progress.h"
#include "vpm/estimate/surface_estimate.h"
#include "vpm/integrators/photon_map/photon_pass.h"
#include "vpm/integrators/render_scene.h"
#include "vpm/render/render.h"

namespace vpm {
namespace {

/// One pixel of the textbook.
struct Textbook {
  double radius, photons = 0.0, flux = 0.0;  // R, m; N; tau, W

  /// A pass that has found `found` photons of that power in all.
  void add(double found, double power) {
    constexpr double kAlpha = 2.0 / 3.0;
    if (found == 0.0) return;
    const double next = radius * std::sqrt((photons + kAlpha * found) / (photons + found));
    flux = (flux + power) * next * next / (radius * radius);
    photons += kAlpha * found;
    radius = next;
  }
  /// W/m^2
  double irradiance(int passes, double emitted) const { return flux / (passes * emitted * kPiD * radius * radius); }
};

TEST(PixelDisc, FollowsTheRuleOnNumbersByHand) {
  PixelDisc disc;
  shrink(disc, 0);  // nothing found: nothing learnt
  EXPECT_EQ(disc.area, 1.0);
  EXPECT_EQ(disc.photons, 0.0);
  shrink(disc, 3);  // 2 of 3 are kept
  EXPECT_DOUBLE_EQ(disc.photons, 2.0);
  EXPECT_DOUBLE_EQ(disc.area, 2.0 / 3.0);
  shrink(disc, 6);  // 2 + 4 of 2 + 6
  EXPECT_DOUBLE_EQ(disc.photons, 6.0);
  EXPECT_DOUBLE_EQ(disc.area, 0.5);
  shrink(disc, 0);
  EXPECT_DOUBLE_EQ(disc.area, 0.5);
  EXPECT_FLOAT_EQ(disc_radius(disc, 3.0f), 3.0f * std::sqrt(0.5f));
}

TEST(PixelDisc, InEvenLightTheScheduleIsThatOfPassesAfterAFirstFactor) {
  PixelDisc disc;
  for (int pass = 0; pass < 100; ++pass) {
    shrink(disc, static_cast<uint64_t>(std::llround(1e12 * disc.area)));
    EXPECT_NEAR(disc.area / (best_a(2) * measure_of_pass(best_a(2), pass)), 1.0, 1e-9);
  }
}

TEST(PixelDisc, KnowsPhotonsByTheirRatiosAlone) {
  PixelDisc sums, means;
  for (const uint64_t found : {4, 0, 12, 8, 20}) {
    shrink(sums, found);
    shrink(means, found / 4);
    EXPECT_NEAR(sums.area, means.area, 1e-15);
  }
}

/// A pixel that sees another point of a plane in each pass, few photons around it: none in some passes.
TEST(PixelDisc, TheMeanOfPassesIsTheTextbooksRadiance) {
  constexpr int kPasses = 20;
  constexpr float kFirst = 0.3f;
  const Vec3 up(0, 1, 0);
  for (uint64_t pixel = 0; pixel < 50; ++pixel) {
    Textbook textbook{kFirst};
    PixelDisc disc;
    double sum = 0.0;
    for (uint64_t pass = 0; pass < kPasses; ++pass) {
      Rng rng(1, rng_stream(RngUse::test, pass), pixel);
      std::vector<Photon> photons(12);
      for (Photon& p : photons)
        p = {Vec3(rng.uniform(), 0.0f, rng.uniform()), PackedDirection(-up), Rgb(0.5f + rng.uniform())};
      const Vec3 at(0.4f + 0.2f * rng.uniform(), 0.0f, 0.4f + 0.2f * rng.uniform());

      const GatherSettings made{GatherMode::radius, 0.2f, 0, KernelKind::constant};
      const PhotonMap map = make_photon_map(photons, made, photons.size());
      GatherSettings own = made;
      own.radius = disc_radius(disc, kFirst);
      GatherCounters counters;
      Neighbours neighbours;
      sum += surface_irradiance(at, up, CountedMap{map, GatherWork{counters, neighbours}, own}).value.g;
      shrink(disc, counters.used);

      double near = 0.0, power = 0.0;
      for (const Photon& p : photons)
        if (glm::distance(Vec3d(p.position), Vec3d(at)) < textbook.radius) {
          ++near;
          power += p.power.g;
        }
      ASSERT_EQ(counters.used, near);
      textbook.add(near, power);
      ASSERT_NEAR(disc_radius(disc, kFirst), textbook.radius, 1e-6);
    }
    ASSERT_GT(textbook.photons, 0.0);
    EXPECT_NEAR(sum / kPasses / textbook.irradiance(kPasses, 12.0), 1.0, 1e-5);
  }
}

/// A grey floor alone, seen from above: photons, straight from the light, are all there is, each of that light's power.
Scene lit_floor(const Light& light) {
  Scene scene;
  scene.lights.push_back(light);
  add_shape(scene, quad_mesh(Vec3(-3, 0, 3), Vec3(6, 0, 0), Vec3(0, 0, -6)), Lambertian{Rgb(0.5f)});
  scene.camera = make_camera(Vec3(0, 4, 0), Vec3(0.0f), Vec3(0, 0, -1), 30.0f, {18, 18});
  scene.geometry.commit();
  finish(scene);
  return scene;
}

RenderSettings per_pixel(uint64_t photons) {
  RenderSettings settings;
  settings.radii = RadiusSchedule::per_pixel;
  settings.direct.type = DirectLight::photons;
  settings.photons.emitted = photons;
  settings.until.passes = 12;
  settings.surface.radius = 0.15f;
  settings.surface.kernel = KernelKind::constant;
  return settings;
}

RenderResult render_all(const Scene& scene, const RenderSettings& settings) {
  return render(scene, settings, nothing_rendered(scene.camera), {});
}

TEST(RadiiOfPixels, ShrinkTheLaterTheFewerPhotonsArrive) {
  const Scene scene = lit_floor(PointLight{Vec3(-0.5f, 0.3f, 0.2f), Rgb(1.0f)});
  const RenderResult result = render_all(scene, per_pixel(300));
  const Image mean = result.film.mean();
  std::vector<std::pair<float, double>> area_by_light;
  for (size_t i = 0; i < result.discs.size(); ++i) {
    const PixelDisc& disc = result.discs[i];
    EXPECT_EQ(disc.area == 1.0, disc.photons == 0.0);
    EXPECT_EQ(disc.photons == 0.0, mean.pixels[i].g == 0.0f);  // who found nothing has seen nothing
    area_by_light.emplace_back(mean.pixels[i].g, disc.area);
  }
  std::sort(area_by_light.begin(), area_by_light.end());
  const auto mean_area = [&](size_t begin, size_t end) {
    double sum = 0.0;
    for (size_t i = begin; i < end; ++i) sum += area_by_light[i].second / static_cast<double>(end - begin);
    return sum;
  };
  const size_t tenth = area_by_light.size() / 10;
  const double bright = mean_area(area_by_light.size() - tenth, area_by_light.size()), dark = mean_area(0, tenth);
  EXPECT_NEAR(bright, best_a(2) * measure_of_pass(best_a(2), 11), 0.03);  // as in even light
  EXPECT_GT(dark, 1.5 * bright);
}

// The mean over pixels of renders of 12 passes, each of its own seed.
TEST(SlowRadiiOfPixels, AreRightInTheMeanWhileTheyShrink) {
  const Scene scene = lit_floor(DirectionalLight{Vec3(0, -1, 0), Rgb(2.0f)});
  RenderSettings settings = per_pixel(2000);
  Moments radiance, area;
  for (settings.seed = 1; settings.seed <= 60; ++settings.seed) {
    const RenderResult result = render_all(scene, settings);
    double sum = 0.0, areas = 0.0;
    for (const Rgb& p : result.film.mean().pixels) sum += p.g;
    for (const PixelDisc& disc : result.discs) areas += disc.area;
    radiance.add(sum / static_cast<double>(result.discs.size()));
    area.add(areas / static_cast<double>(result.discs.size()));
  }
  expect_mean(radiance, 0.5 / kPiD * 2.0, kFalseAlarms, "radiance of a floor in even light");
  EXPECT_LT(area.mean(), 0.45);
}

TEST(RadiiOfPixels, OfARenderAreThoseOfItsPassesOneAfterAnother) {
  const Scene scene = lit_floor(PointLight{Vec3(-0.5f, 0.3f, 0.2f), Rgb(1.0f)});
  const RenderSettings settings = per_pixel(3000);
  const auto run = [&](int number, const RenderResult& so_far, const PassProgress& shown) {
    return render_photon_pass_after(so_far.discs, scene, settings, {number, shown});
  };
  const Image passes =
      run_passes(settings.until, {run, tile_count(scene.camera)}, nothing_rendered(scene.camera), {}).film.mean();
  const Image whole = render_all(scene, settings).film.mean();
  ASSERT_EQ(passes.pixels.size(), whole.pixels.size());
  EXPECT_TRUE(std::memcmp(passes.pixels.data(), whole.pixels.data(), whole.pixels.size() * sizeof(Rgb)) == 0);
}

TEST(RadiiOfPixels, AreTheSameForAnyNumberOfThreads) {
  const Scene scene = lit_floor(PointLight{Vec3(-0.5f, 0.3f, 0.2f), Rgb(1.0f)});
  std::vector<RenderResult> results;
  for (const int threads : {1, 2, 5}) {
    set_threads(threads);
    results.push_back(render_all(scene, per_pixel(3000)));
  }
  set_threads(0);
  for (const RenderResult& other : results) {
    const Image a = results[0].film.mean(), b = other.film.mean();
    EXPECT_TRUE(std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(Rgb)) == 0);
    ASSERT_EQ(other.discs.size(), results[0].discs.size());
    EXPECT_TRUE(std::memcmp(other.discs.data(), results[0].discs.data(), other.discs.size() * sizeof(PixelDisc)) == 0);
  }
}

TEST(RadiiOfPixels, AreNoneWithoutARoughSurface) {
  Scene scene = boxed_medium(make_medium(nullptr, Rgb(1.0f), 0.8f), PointLight{Vec3(0, 3, 0), Rgb(1.0f)});
  scene.camera = make_camera(Vec3(0, 0, 4), Vec3(0.0f), Vec3(0, 1, 0), 20.0f, {4, 4});
  EXPECT_TRUE(render_all(scene, per_pixel(100)).discs.empty());
}

}  // namespace
}  // namespace vpm
