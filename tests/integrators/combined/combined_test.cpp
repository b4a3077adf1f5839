// The combined estimator: its maps, and that its pictures depend on no threads.
#include "vpm/integrators/combined/combined.h"
#include "vpm/integrators/combined/merge_shares.h"
#include "vpm/integrators/combined/merging_rays.h"

#include <gtest/gtest.h>

#include <set>

#include "support/scenes.h"
#include "vpm/base/parallel.h"
#include "vpm/base/warp.h"
#include "vpm/image/metrics.h"
#include "vpm/integrators/combined/combined_pass.h"
#include "vpm/integrators/render_scene.h"

namespace vpm {
namespace {

Vec3 random_place(Rng& rng) { return 2.0f * Vec3(rng.uniform(), rng.uniform(), rng.uniform()); }

/// Photons know their numbers by their powers.
MergePhoton numbered(const Vec3& point, uint32_t number) {
  return {.point = point, .power = Rgb(static_cast<float>(number))};
}
uint32_t number_of(const MergePhoton& photon) { return static_cast<uint32_t>(photon.power.r); }

TEST(MergeMap, FindsWhatASearchThroughAllFinds) {
  constexpr float kRadius = 0.15f;
  for (const int count : {0, 1, 17, 3000}) {
    Rng rng(1, rng_stream(RngUse::test, 1), static_cast<uint64_t>(count));
    std::vector<MergePhoton> photons;
    for (int i = 0; i < count; ++i) photons.push_back(numbered(random_place(rng), static_cast<uint32_t>(i)));
    const MergeMap map(photons, 1.5f * kRadius);
    for (int query = 0; query < 50; ++query) {
      const Vec3 point = random_place(rng);
      const Ray ray{point, uniform_sphere(rng.uniform2())};
      const Interval interval{0.2f, 1.1f};
      std::set<uint32_t> near, beside, near_found, beside_found;
      for (uint32_t i = 0; i < photons.size(); ++i) {
        const Vec3 offset = photons[i].point - point;
        const float t = glm::dot(offset, ray.direction), square = glm::dot(offset, offset);
        if (square < kRadius * kRadius) near.insert(i);
        if (t >= interval.t0 && t < interval.t1 && square - t * t < kRadius * kRadius) beside.insert(i);
      }
      map.visit_near(point, kRadius, [&](const MergePhoton& photon, float) {
        EXPECT_TRUE(near_found.insert(number_of(photon)).second);
      });
      map.visit_leaves_near_ray(ray, interval, kRadius, [&](const auto& leaf, const auto& found) {
        for (size_t i = 0; i < kBlock; ++i) {
          if (found.distances2[i] >= kRadius * kRadius) continue;
          EXPECT_TRUE(beside_found.insert(number_of(leaf[i])).second);
          EXPECT_NEAR(found.places[i], glm::dot(leaf.point(i) - point, ray.direction), 1e-6f);
        }
      });
      EXPECT_EQ(near_found, near);
      EXPECT_EQ(beside_found, beside);
    }
  }
}

TEST(MergeMap, OfALeafLeavesOutNothingNearABundle) {
  constexpr float kRadius = 0.05f, kFarthest = 2.0f;
  Rng rng(1, rng_stream(RngUse::test, 2), 0);
  const Vec3 apex(0.1f, -0.2f, 0.3f);
  uint32_t near_rays = 0, found_all = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const Vec3 middle = uniform_sphere(rng.uniform2());
    std::array<Vec3, 4> directions;
    for (Vec3& direction : directions) direction = glm::normalize(middle + 0.1f * (random_place(rng) - 1.0f));
    const RayBundle bundle(apex, directions, kFarthest + kRadius);
    PhotonLeaf leaf;
    leaf.set(kBlock - 1, {.point = Vec3(kInfinity)});
    for (size_t i = 0; i + 1 < kBlock; ++i)
      leaf.set(i, {.point = apex + kFarthest * rng.uniform() * (middle + 0.3f * (random_place(rng) - 1.0f))});
    uint32_t numbers[kBlock];
    const uint32_t count = find_near(leaf, bundle, kRadius, numbers);
    const std::set<uint32_t> found(numbers, numbers + count);
    EXPECT_FALSE(found.contains(kBlock - 1)) << "a place that is missing";
    found_all += count;
    for (uint32_t i = 0; i + 1 < kBlock; ++i)
      for (const Vec3& direction : directions) {
        const Vec3 from = leaf.point(i) - apex;
        const float t = glm::dot(from, direction);
        if (t < 0.0f || t > kFarthest || glm::length(from - t * direction) >= kRadius) continue;
        ++near_rays;
        EXPECT_TRUE(found.contains(i));
      }
  }
  EXPECT_GT(near_rays, 1000u);
  EXPECT_LT(found_all, 2000u * kBlock / 2) << "most are left out";
}

float largest_difference(const Image& a, const Image& b) {
  float largest = 0.0f;
  for (size_t i = 0; i < a.pixels.size(); ++i)
    for (int c = 0; c < 3; ++c) largest = std::max(largest, std::abs(a.pixels[i][c] - b.pixels[i][c]));
  return largest;
}

/// A box of fog over a floor, which the camera sees from outside.
Scene foggy_box(const Material& floor = Lambertian{Rgb(0.6f)}) {
  Scene scene;
  scene.media.push_back(make_medium(nullptr, Rgb(0.8f, 1.0f, 1.3f), 0.7f));
  const Interface media{0, kVacuum};
  add_shape(scene, box_mesh(Vec3d(-1.0), Vec3d(1.0)), Boundary{}, &media);
  add_shape(scene, quad_mesh(Vec3d(-3, -1.1, 3), Vec3d(6, 0, 0), Vec3d(0, 0, -6)), floor);
  scene.lights.push_back(PointLight{Vec3(0.3f, 2.0f, 0.4f), Rgb(5.0f)});
  scene.camera = make_camera(Vec3(0.5f, 1.0f, 4.0f), Vec3(0.0f), Vec3(0, 1, 0), 40.0f, {24, 20});
  scene.geometry.commit();
  finish(scene);
  return scene;
}

RenderSettings combined_settings_of(uint64_t paths) {
  RenderSettings settings;
  settings.integrator = Integrator::combined;
  settings.photons.emitted = paths;
  settings.volume.radius = settings.surface.radius = 0.1f;
  for (const TechniqueInfo& info : kTechniques) settings.combined.techniques.set(info.technique, true);
  return settings;
}

TEST(Combined, IsTheSameBitForBitOnAnyNumberOfThreads) {
  const Scene scene = foggy_box();
  const RenderSettings settings = combined_settings_of(5'000);
  set_threads(1);
  const Image one = render_combined_pass(scene, settings, 3).image;
  set_threads(3);
  const Image three = render_combined_pass(scene, settings, 3).image;
  set_threads(0);
  EXPECT_EQ(one.pixels, three.pixels);
}

/// Photons on a diffuse floor are merged in lanes, those on a glossy one by one: without its gloss it is diffuse.
TEST(Combined, PhotonsOnDiffuseSurfacesAreMergedAsOnOthers) {
  for (const Heuristic heuristic : {Heuristic::balance, Heuristic::power, Heuristic::correlation_aware}) {
    RenderSettings settings = combined_settings_of(20'000);
    settings.combined.heuristic = heuristic;
    const auto floor_of = [&](const Material& material) {
      return render_combined_pass(foggy_box(material), settings, 2).image;
    };
    const Image diffuse = floor_of(Lambertian{Rgb(0.6f, 0.3f, 0.1f)});
    const Image others = floor_of(Phong{Rgb(0.6f, 0.3f, 0.1f), Rgb(0.0f), 5.0f});
    EXPECT_GT(channel_means(diffuse).r, 1e-3);
    EXPECT_LT(largest_difference(diffuse, others), 1e-5 * channel_means(diffuse).r);
  }
}

/// The report tells the largest radius of merges in media, and photons below the floor.
TEST(Combined, StatisticsTellRadiiAndThinPlaces) {
  RenderSettings settings = combined_settings_of(2'000);
  settings.radii = RadiusSchedule::constant;
  EXPECT_FLOAT_EQ(render_combined_pass(foggy_box(), settings, 0).statistics.last_volume_radius, 0.1f);
  const auto grid = make_grid(centered_frame(16, 2.0 / 32.0), lattice_noise);
  Scene scene = boxed_medium(make_medium(grid, Rgb(2.0f), 0.9f), PointLight{Vec3(0.5f, 1.5f, 0.5f), Rgb(9.0f)});
  scene.camera = make_camera(Vec3(0, 0.5f, 4), Vec3(0.0f), Vec3(0, 1, 0), 30.0f, {6, 6});
  const auto below = [&](float floor) {
    settings.volume.density_floor = floor;
    return render_combined_pass(scene, settings, 0).statistics.ledger.floored;
  };
  EXPECT_EQ(below(0.0f), 0u);
  EXPECT_GT(below(0.3f), below(0.1f));
}

/// The weighted layers of all techniques sum to the picture, and keeping them changes nothing in it.
TEST(Combined, LayersAreThePartsOfThePicture) {
  const Scene scene = foggy_box();
  RenderSettings settings = combined_settings_of(3'000);
  settings.combined.heuristic = Heuristic::balance;  // each technique has a part then
  const Image alone = render_combined_pass(scene, settings, 1).image;
  settings.combined.layers = true;
  const Pass pass = render_combined_pass(scene, settings, 1);
  EXPECT_EQ(pass.image.pixels, alone.pixels);
  const std::vector<std::string> names = layer_names(settings);
  ASSERT_EQ(pass.layers.size(), names.size());
  for (size_t i = 0; i < alone.pixels.size(); ++i) {
    Rgb sum(0.0f);
    for (size_t layer = 0; layer < names.size(); layer += 2) sum += pass.layers[layer].pixels[i];
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c], alone.pixels[i][c], 1e-5f * (1.0f + alone.pixels[i][c]));
  }
  for (size_t layer = 0; layer < names.size(); layer += 2) {
    EXPECT_EQ(names[layer], "combined." + std::string(kTechniques[layer / 2].name) + ".weighted");
    const Rgbd weighted = channel_means(pass.layers[layer]), unweighted = channel_means(pass.layers[layer + 1]);
    for (int c = 0; c < 3; ++c) {
      EXPECT_GT(weighted[c], 0.0) << names[layer];
      EXPECT_GT(unweighted[c], weighted[c]) << names[layer];
    }
  }
}

/// The mean of many passes by one technique.
Image mean_picture(const Scene& scene, Technique technique, uint64_t seed) {
  RenderSettings settings = combined_settings_of(20'000);
  settings.seed = seed;
  for (const TechniqueInfo& info : kTechniques)
    settings.combined.techniques.set(info.technique, info.technique == technique);
  constexpr int kPasses = 40;
  Image sum(scene.camera.width, scene.camera.height);
  for (int pass = 0; pass < kPasses; ++pass) {
    const Image image = render_combined_pass(scene, settings, pass).image;
    for (size_t i = 0; i < sum.pixels.size(); ++i) sum.pixels[i] += image.pixels[i] / float{kPasses};
  }
  return sum;
}

/// The square difference of a picture from another that is moved by so many columns.
double difference(const Image& a, const Image& b, int columns) {
  double sum = 0.0;
  for (int y = 0; y < a.height; ++y)
    for (int x = 1; x + 1 < a.width; ++x) {
      const double d = a.at(x, y).g - b.at(x + columns, y).g;
      sum += d * d;
    }
  return sum;
}

/// A floor behind a filter that reaches into neighbouring pixels: light tracing finds the same light as light that is
/// sampled, in the mean and pixel by pixel.
TEST(Combined, LightTracingFillsPixelsAsTheirFiltersSay) {
  Scene scene = foggy_box();
  scene.camera.filter = {FilterKind::tent, 1.0f};
  const Image traced = mean_picture(scene, Technique::light_tracing, 1);
  const Image sampled = mean_picture(scene, Technique::connections, 2);
  EXPECT_NEAR(channel_means(traced).g / channel_means(sampled).g, 1.0, 0.02);
  const double here = difference(traced, sampled, 0);
  EXPECT_LT(here, 0.5 * difference(traced, sampled, 1));
  EXPECT_LT(here, 0.5 * difference(traced, sampled, -1));
}

/// At the rim of a pixel's filter the density of rays is 0: light tracing then has the whole of the light, if it is
/// used at all.
TEST(SharesOfPoints, AreNumbersWhereAPixelDrawsNoRay) {
  TechniqueCounts counts;
  counts.points_2d = 0.5;
  const Floats one = Floats(1.0f);
  PhotonsBesideRays beside{};
  beside.adjacent = beside.density = beside.kept = one;
  beside.colliding = 0.5f * one;
  const SharesOfPoints<false> shares(counts, 1.0f);
  EXPECT_EQ(shares.of(beside)[0], 1.0f / 1.5f);
  MergeSegment segment;
  segment.adjacent = std::numeric_limits<double>::infinity();
  beside.splats = 4.0f * rays_of(segment, counts.points_2d).splats;
  const float beside_light_tracing = shares.of(beside)[0];
  EXPECT_GE(beside_light_tracing, 0.0f);
  EXPECT_LT(beside_light_tracing, 1e-29f);
}

/// A ball of glass straight before the camera, and a lamp behind it: what two faces send back is the light times
/// 2 F / (1 + F). Each sample follows both sides, so that it finds nearly all of that, and never the whole lamp.
TEST(Combined, FollowsBothSidesOfGlass) {
  Scene scene;
  add_shape(scene, SphereShape{Vec3(0.0f), 1.0f}, Dielectric{1.5f});
  const TriangleMesh lamp = quad_mesh(Vec3d(-5, -5, 6), Vec3d(0, 10, 0), Vec3d(10, 0, 0));
  scene.lights.push_back(QuadLight{Vec3(-5, -5, 6), Vec3(0, 10, 0), Vec3(10, 0, 0), Rgb(1.0f)});
  add_shape(scene, lamp, Lambertian{Rgb(0.0f)}, nullptr, 0);
  scene.camera = make_camera(Vec3(0, 0, 4), Vec3(0.0f), Vec3(0, 1, 0), 0.5f, {16, 16});
  scene.geometry.commit();
  finish(scene);
  const Image picture = render_combined_pass(scene, combined_settings_of(100), 0).image;
  for (const Rgb& pixel : picture.pixels) {
    EXPECT_GT(pixel.g, 0.039f);
    EXPECT_LT(pixel.g, 0.09f);
  }
  constexpr double kFresnel = 0.04;
  EXPECT_NEAR(channel_means(picture).g, 2.0 * kFresnel / (1.0 + kFresnel), 0.003);  // 256 samples: 4 standard errors
}

/// Samples that were dropped as they were not finite, in a few passes by all techniques.
uint64_t dropped(const Scene& scene, const RenderSettings& settings) {
  uint64_t count = 0;
  for (int pass = 0; pass < 4; ++pass) {
    const RenderStatistics s = render_combined_pass(scene, settings, pass).statistics;
    count += s.eye.non_finite + s.ledger.non_finite;
  }
  return count;
}

Scene foggy_box_of(const Medium& medium, const Light& light) {
  Scene scene = boxed_medium(medium, light);
  scene.camera = make_camera(Vec3(0.5f, 1.0f, 4.0f), Vec3(0.0f), Vec3(0, 1, 0), 40.0f, {24, 20});
  return scene;
}

TEST(Combined, DropsNothingWhereDensitiesVanish) {
  const PointLight point{Vec3(0.3f, 2.0f, 0.4f), Rgb(5.0f)};
  const RenderSettings settings = combined_settings_of(2'000);
  EXPECT_EQ(dropped(foggy_box_of(make_medium(nullptr, Rgb(150.0f), 0.9f), ConstantEnvironment{Rgb(1.0f)}), settings),
            0u);
  EXPECT_EQ(dropped(foggy_box_of(make_medium(nullptr, Rgb(0.0f, 1.0f, 2.0f), 0.9f), point), settings), 0u);
  EXPECT_EQ(dropped(foggy_box_of(make_medium(nullptr, Rgb(1.0f), 0.0f), point), settings), 0u);
  // A sun of one texel on a black sky, and a spot with a hard edge, whose light only merges find.
  std::vector<Rgb> sky(64 * 32, Rgb(0.0f));
  sky[5 * 64 + 40] = Rgb(100.0f);
  const EnvironmentMap sun{std::make_shared<const ImageEnvironment>(64, 32, sky)};
  EXPECT_EQ(dropped(foggy_box_of(make_medium(nullptr, Rgb(1.0f), 0.9f), sun), settings), 0u);
  const SpotLight spot{Vec3(0.3f, 2.0f, 0.4f), Vec3(0, -1, 0), 0.9f, 0.9f, Rgb(5.0f)};
  RenderSettings without = settings;
  without.combined.techniques.set(Technique::connections, false);
  EXPECT_EQ(dropped(foggy_box_of(make_medium(nullptr, Rgb(1.0f), 0.9f), spot), without), 0u);
}

/// Rays leave large tilted triangles farther off than others: they must be aimed at lamps from there.
TEST(Combined, SeesSmallLampsFromLargeTiltedTriangles) {
  Scene scene;
  const Vec3d along(8.66, 5.0, 0.0), across(-1.7, 3.1, 9.0);
  add_shape(scene, quad_mesh(-0.5 * (along + across), along, across), Lambertian{Rgb(0.6f)});
  const Vec3 normal(glm::normalize(glm::cross(along, across)));
  const Vec3 above = normal.y > 0.0f ? normal : -normal;
  scene.lights.push_back(SphereLight{2.0f * above, 0.02f, Rgb(1000.0f)});
  add_shape(scene, SphereShape{2.0f * above, 0.02f}, Lambertian{Rgb(0.0f)}, nullptr, 0);
  scene.camera = make_camera(above, Vec3(0.4f, 0.2f, -0.3f), Vec3(0, 0, 1), 40.0f, {24, 20});  // below the lamp
  scene.geometry.commit();
  finish(scene);
  const Image sampled = mean_picture(scene, Technique::connections, 1);
  const Image traced = mean_picture(scene, Technique::light_tracing, 2);
  EXPECT_NEAR(channel_means(sampled).g / channel_means(traced).g, 1.0, 0.02);
}

}  // namespace
}  // namespace vpm
