// Light maps: closed forms of irradiance, which texel is where, and what cannot be laid out.
#include "vpm/integrators/photon_map/surface/light_map.h"

#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <numeric>

#include "support/statistics.h"
#include "vpm/base/error.h"
#include "vpm/base/parallel.h"
#include "vpm/job/bake.h"
#include "vpm/scene/build.h"

namespace vpm {
namespace {

constexpr float kTexelReflectance = 0.5f;

/// The quad of 2 m by 2 m about the origin with its normal along +y: u runs along x, v against z.
TriangleMesh floor_mesh() { return quad_mesh(Vec3d(-1, 0, 1), Vec3d(2, 0, 0), Vec3d(0, 0, -2)); }

Scene lit(const TriangleMesh& mesh, const Light& light) {
  Scene scene;
  add_shape(scene, mesh, Lambertian{Rgb(kTexelReflectance)});
  scene.lights.push_back(light);
  scene.geometry.commit();
  finish(scene);
  return scene;
}

RenderSettings fixed_radius(float radius, uint64_t photons) {
  RenderSettings settings;
  settings.photons.emitted = photons;
  settings.surface.radius = settings.caustics.radius = radius;
  settings.surface.kernel = KernelKind::constant;
  settings.radii = RadiusSchedule::constant;
  return settings;
}

/// What passes give for each texel, and for the whole shape.
struct Baked {
  std::vector<Moments> texels;
  Moments power;
};
Baked bake(const Scene& scene, const RenderSettings& settings, const UvLayout& layout, int passes) {
  Baked baked{std::vector<Moments>(layout.texels()), {}};
  for (int pass = 0; pass < passes; ++pass) {
    const Image map = light_map_pass(scene, settings, layout, pass).image;
    for (size_t t = 0; t < layout.texels(); ++t) baked.texels[t].add(map.pixels[t].g);
    baked.power.add(received_power(layout, map).g);
  }
  return baked;
}

/// The mean of a function of x and z over a texel of the floor's map.
double mean_over_texel(int x, int y, int n, const std::function<double(double x, double z)>& f) {
  constexpr int kPoints = 8;
  double sum = 0.0;
  for (int j = 0; j < kPoints; ++j)
    for (int i = 0; i < kPoints; ++i) {
      const double u = (x + (i + 0.5) / kPoints) / n, v = 1.0 - (y + (j + 0.5) / kPoints) / n;
      sum += f(-1.0 + 2.0 * u, 1.0 - 2.0 * v);
    }
  return sum / (kPoints * kPoints);
}

/// I cos / d^2 on the floor, of I = 1 W/sr.
double point_irradiance(const Vec3d& light, double x, double z) {
  const Vec3d to = light - Vec3d(x, 0.0, z);
  const double d = glm::length(to);
  return to.y / (d * d * d);
}

/// z-tests of texels that are all to pass at kFalseAlarms.
void expect_texels(const Baked& baked, int n, int border, const std::function<double(double x, double z)>& expected) {
  const double rate = kFalseAlarms / (n * n);
  for (int y = border; y < n - border; ++y)
    for (int x = border; x < n - border; ++x)
      expect_mean(baked.texels[static_cast<size_t>(y) * n + x], mean_over_texel(x, y, n, expected), rate,
                  (std::to_string(x) + ", " + std::to_string(y)).c_str());
}

TEST(LightMap, ShadowRaysGiveThePointLightsIrradiance) {
  const Vec3d light(0.7, 0.8, -0.6);
  const Scene scene = lit(floor_mesh(), PointLight{Vec3(light), Rgb(1.0f)});
  constexpr int kTexels = 8;
  const UvLayout layout = lay_out_light_map(scene, 0, kTexels);
  const Baked baked = bake(scene, fixed_radius(0.1f, 10), layout, 400);
  expect_texels(baked, kTexels, 0, [&](double x, double z) { return point_irradiance(light, x, z); });
  // The light is near the end of u and of v: on the right, in the top rows.
  size_t brightest = 0;
  for (size_t t = 0; t < layout.texels(); ++t)
    if (baked.texels[t].mean() > baked.texels[brightest].mean()) brightest = t;
  EXPECT_EQ(brightest % kTexels, 6u);
  EXPECT_EQ(brightest / kTexels, 1u);
}

// Outward is up: from below nothing arrives on that side, whatever estimates it.
TEST(LightMap, IsOfTheOutwardSide) {
  const Scene scene = lit(floor_mesh(), PointLight{Vec3(0.0f, -1.0f, 0.0f), Rgb(1.0f)});
  const UvLayout layout = lay_out_light_map(scene, 0, 4);
  RenderSettings settings = fixed_radius(0.2f, 1000);
  for (const DirectLight direct : {DirectLight::photons, DirectLight::shadow_rays}) {
    settings.direct.type = direct;
    EXPECT_EQ(bake(scene, settings, layout, 1).power.mean(), 0.0);
  }
}

// The floor stands in an absorbing box, whose medium it does not name.
TEST(LightMap, LightIsAttenuatedOnItsWay) {
  const Vec3d light(0.2, 0.5, 0.1);
  Scene scene;
  Medium fog;
  fog.sigma_t = Rgb(1.5f);
  scene.media.push_back(fog);
  const Interface media{0, kVacuum};
  add_shape(scene, box_mesh(Vec3d(-2.0), Vec3d(2.0)), Boundary{}, &media);
  const uint32_t floor = add_shape(scene, floor_mesh(), Lambertian{Rgb(kTexelReflectance)});
  scene.lights.push_back(PointLight{Vec3(light), Rgb(1.0f)});
  scene.geometry.commit();
  finish(scene);
  const Baked baked = bake(scene, fixed_radius(0.1f, 10), lay_out_light_map(scene, floor, 4), 400);
  expect_texels(baked, 4, 0, [&](double x, double z) {
    return point_irradiance(light, x, z) * std::exp(-1.5 * glm::length(light - Vec3d(x, 0.0, z)));
  });
}

/// Six quads around the cube [-1, 1]^3, normals inward, with a light of 1 W in the middle.
Scene cube_of_quads() {
  Scene scene;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      Vec3d corner(-1.0), u(0.0), v(0.0);
      corner[axis] = side;
      u[(axis + 1) % 3] = v[(axis + 2) % 3] = 2.0;
      add_shape(scene, side < 0.0 ? quad_mesh(corner, u, v) : quad_mesh(corner, v, u),
                Lambertian{Rgb(kTexelReflectance)});
    }
  scene.lights.push_back(PointLight{Vec3(0.0f), Rgb(0.25f / kPi)});
  scene.geometry.commit();
  finish(scene);
  return scene;
}

/// The floor with coordinates that stretch its triangles differently, and leave some of the map empty.
TriangleMesh stretched_floor() {
  TriangleMesh mesh = floor_mesh();
  mesh.uvs = {{0.1f, 0.1f}, {0.9f, 0.1f}, {0.9f, 0.4f}, {0.1f, 0.95f}};
  return mesh;
}

// What texels say the floor receives is what the ledger says that it absorbs, over 1 - rho.
TEST(SlowLightMap, ReceivesThePowerOfTheLedger) {
  const Scene scene = lit(stretched_floor(), PointLight{Vec3(0.6f, 0.4f, 0.7f), Rgb(1.0f)});
  const RenderSettings settings = fixed_radius(0.05f, 50'000);
  const UvLayout layout = lay_out_light_map(scene, 0, 48);
  Moments difference;  // W
  for (int pass = 0; pass < 100; ++pass) {
    const Pass done = light_map_pass(scene, settings, layout, pass);
    const Ledger& ledger = done.statistics.ledger;
    const double absorbed = ledger.absorbed_on_surfaces.g / static_cast<double>(ledger.emitted_count);
    difference.add(received_power(layout, done.image).g - absorbed / (1.0 - kTexelReflectance));
  }
  EXPECT_LT(std::sqrt(difference.variance_of_mean()), 0.005);  // of some 4 W
  expect_mean(difference, 0.0, kFalseAlarms);
}

// Shading normals are a matter of reflection, not of what arrives.
TEST(LightMap, KnowsNoShadingNormals) {
  const PointLight light{Vec3(0.3f, 0.5f, 0.1f), Rgb(1.0f)};
  TriangleMesh bent = floor_mesh();
  bent.normals.assign(4, Vec3(0.6f, 0.8f, 0.0f));
  const Scene flat_scene = lit(floor_mesh(), light), bent_scene = lit(bent, light);
  RenderSettings settings = fixed_radius(0.2f, 1000);
  settings.direct.type = DirectLight::photons;
  const auto power = [&](const Scene& scene) {
    return bake(scene, settings, lay_out_light_map(scene, 0, 4), 1).power.mean();
  };
  EXPECT_GT(power(flat_scene), 0.0);
  EXPECT_EQ(power(flat_scene), power(bent_scene));
}

TEST(LightMap, IsTheSameOnAnyNumberOfThreads) {
  const Scene scene = cube_of_quads();
  RenderSettings settings = fixed_radius(0.1f, 5000);
  settings.indirect.type = IndirectLight::final_gather;
  settings.until.passes = 2;
  const UvLayout layout = lay_out_light_map(scene, 0, 40);
  std::vector<Image> maps;
  for (const int threads : {1, 2}) {
    set_threads(threads);
    maps.push_back(bake_light_map(scene, settings, layout, {}).render.film.mean());
  }
  set_threads(0);
  EXPECT_EQ(std::memcmp(maps[0].pixels.data(), maps[1].pixels.data(), layout.texels() * sizeof(Rgb)), 0);
}

/// What the map says that its power is off by is what powers of other seeds differ by.
TEST(LightMap, ThePowerHasItsStandardError) {
  const Scene scene = lit(floor_mesh(), PointLight{Vec3(0.2f, 0.5f, 0.0f), Rgb(1.0f, 2.0f, 3.0f)});
  RenderSettings settings = fixed_radius(0.2f, 300);
  settings.direct.type = DirectLight::photons;
  settings.photons.sequence = PhotonSequence::random;
  settings.until.passes = 8;
  const UvLayout layout = lay_out_light_map(scene, 0, 4);
  ChannelMoments power, squared_error;
  for (settings.seed = 1; settings.seed <= 300; ++settings.seed) {
    const LightMap baked = bake_light_map(scene, settings, layout, {});
    power.add(baked.power.mean());
    squared_error.add(baked.power.standard_error() * baked.power.standard_error());
    EXPECT_NEAR(baked.power.mean().g, received_power(layout, baked.render.film.mean()).g, 1e-5);
  }
  // Of variances with 299 and 300 times 7 degrees of freedom.
  const double spread = normal_quantile(kFalseAlarms) * std::sqrt(2.0 / 299.0 + 2.0 / 2100.0);
  for (size_t c = 0; c < 3; ++c)
    EXPECT_NEAR(power.channels[c].variance() / squared_error.channels[c].mean(), 1.0, spread) << c;
}

// --- Layout

UvLayout lay_out_mesh(const TriangleMesh& mesh, int resolution) {
  return lay_out_light_map(lit(mesh, PointLight{Vec3(0.0f, 1.0f, 0.0f), Rgb(1.0f)}), 0, resolution);
}

/// The floor as a grid of cells, its coordinates the shares of its edges.
TriangleMesh tessellated_floor(uint32_t cells) {
  TriangleMesh mesh;
  for (uint32_t j = 0; j <= cells; ++j)
    for (uint32_t i = 0; i <= cells; ++i) {
      const float u = static_cast<float>(i) / static_cast<float>(cells);
      const float v = static_cast<float>(j) / static_cast<float>(cells);
      mesh.positions.emplace_back(2.0f * u - 1.0f, 0.0f, 1.0f - 2.0f * v);
      mesh.uvs.emplace_back(u, v);
      if (i == cells || j == cells) continue;
      const uint32_t a = j * (cells + 1) + i, b = a + cells + 1;
      mesh.triangles.emplace_back(a, a + 1, b + 1);
      mesh.triangles.emplace_back(a, b + 1, b);
    }
  return mesh;
}

TEST(UvLayout, ShowsTheWholeSurface) {
  const auto sum = [](const auto& values) { return std::accumulate(values.begin(), values.end(), 0.0); };
  for (const int n : {1, 7, 64}) {
    for (const TriangleMesh& mesh : {floor_mesh(), tessellated_floor(9)}) {
      const UvLayout layout = lay_out_mesh(mesh, n);
      EXPECT_NEAR(sum(layout.areas), 4.0, 1e-5);
      for (const float share : layout.coverage) EXPECT_NEAR(share, 1.0f, 1e-5f);
    }
    const UvLayout layout = lay_out_mesh(stretched_floor(), n);
    EXPECT_NEAR(sum(layout.areas), 4.0, 1e-5);
    EXPECT_NEAR(sum(layout.coverage), 0.8 * (0.3 + 0.85) / 2.0 * n * n, 1e-5 * n * n);
    EXPECT_EQ(layout.covered_texels() < layout.texels(), n > 1);
  }
}

// Each point drawn lies in its texel; and both triangles of a texel get their share of the points, which is that of
// their areas.
TEST(UvLayout, DrawsPointsUniformOverTheSurface) {
  const Scene scene = lit(stretched_floor(), PointLight{Vec3(0.0f, 1.0f, 0.0f), Rgb(1.0f)});
  const UvLayout layout = lay_out_light_map(scene, 0, 5);
  std::vector<UvPiece> pieces;
  for (size_t texel = 0; texel < layout.texels(); ++texel) {
    if (!layout.covers(texel)) continue;
    find_pieces(layout, texel, pieces);
    for (uint64_t i = 0; i < 200; ++i) {
      Rng rng(1, rng_stream(RngUse::test, texel), i);
      const Vec2 uv = scene.geometry.uv(sample_pieces(scene.geometry, layout, pieces, rng));
      EXPECT_NEAR(uv.x * 5.0f, static_cast<float>(texel % 5) + 0.5f, 0.5f + 1e-5f);
      EXPECT_NEAR((1.0f - uv.y) * 5.0f, static_cast<float>(texel / 5) + 0.5f, 0.5f + 1e-5f);
    }
  }
  // One texel for all: points are uniform over the floor, in quarters of it.
  const UvLayout whole = lay_out_light_map(scene, 0, 1);
  find_pieces(whole, 0, pieces);
  std::vector<double> counts(16);
  for (uint64_t i = 0; i < 20'000; ++i) {
    Rng rng(1, rng_stream(RngUse::test, 100), i);
    const Vec3 p = sample_pieces(scene.geometry, whole, pieces, rng).position;
    counts[static_cast<size_t>(std::min(3.0f, 2.0f * (p.x + 1.0f))) +
           4 * static_cast<size_t>(std::min(3.0f, 2.0f * (p.z + 1.0f)))] += 1.0;
  }
  expect_distribution(counts, std::vector<double>(16, 1.0 / 16.0), kFalseAlarms, "cells of the floor");
}

void expect_refusal(const std::function<void()>& lay_out, const std::string& words) {
  try {
    lay_out();
    ADD_FAILURE() << "accepted; expected: " << words;
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

TEST(UvLayout, RefusesOverlaps) {
  TriangleMesh mesh = floor_mesh();
  mesh.uvs = {{0.0f, 0.0f}, {1.0f, 0.0f}, {0.0f, 1.0f}, {1.0f, 0.1f}};
  expect_refusal([&] { lay_out_mesh(mesh, 16); }, "overlap in texture coordinates near (");
  // Many small ones, each below the tolerance of a texel.
  TriangleMesh twice = tessellated_floor(40);
  for (const glm::uvec3& t : tessellated_floor(40).triangles) twice.triangles.push_back(t);
  expect_refusal([&] { lay_out_mesh(twice, 1); }, "overlap in texture coordinates near (");
  // The same place for the two halves of a mirrored shape.
  TriangleMesh mirrored = floor_mesh();
  mirrored.uvs = {{0.0f, 0.0f}, {1.0f, 0.0f}, {1.0f, 1.0f}, {1.0f, 0.0f}};
  expect_refusal([&] { lay_out_mesh(mirrored, 16); }, "triangles 0 and 1 overlap");
}

TEST(UvLayout, RefusesWhatHasNoPlaceInTheMap) {
  TriangleMesh mesh = floor_mesh();
  mesh.uvs[2] = {1.25f, 1.0f};
  expect_refusal([&] { lay_out_mesh(mesh, 4); },
                 "a corner of triangle 0 has the texture coordinates (1.25, 1), at x, y, z = 1, 0, -1");
  expect_refusal([&] { lay_out_mesh(box_mesh(Vec3d(0.0), Vec3d(1.0)), 4); }, "it has no texture coordinates");
  mesh.uvs.assign(4, Vec2(0.5f));
  expect_refusal([&] { lay_out_mesh(mesh, 4); }, "no area in texture coordinates");
  Scene scene;
  add_shape(scene, SphereShape{}, Lambertian{Rgb(0.5f)});
  add_shape(scene, floor_mesh(), Mirror{});
  add_shape(scene, floor_mesh(), Lambertian{Rgb(0.0f)});
  expect_refusal([&] { lay_out_light_map(scene, 0, 4); }, "it is no mesh");
  expect_refusal([&] { lay_out_light_map(scene, 1, 4); }, "its material stores no photons");
  expect_refusal([&] { lay_out_light_map(scene, 2, 4); }, "its material stores no photons");
}

TEST(UvLayout, CountsTrianglesThatNoTexelShows) {
  TriangleMesh mesh = floor_mesh();
  mesh.uvs[3] = mesh.uvs[0];
  const UvLayout layout = lay_out_mesh(mesh, 4);
  EXPECT_EQ(layout.flat_triangles, 1u);
  EXPECT_NEAR(std::accumulate(layout.areas.begin(), layout.areas.end(), 0.0), 2.0, 1e-6);
}

TEST(UvLayout, DilationReachesItsRingsAndChangesNothingElse) {
  TriangleMesh mesh = floor_mesh();
  mesh.uvs = {{0.5f, 0.5f}, {0.625f, 0.5f}, {0.625f, 0.625f}, {0.5f, 0.625f}};
  const UvLayout layout = lay_out_mesh(mesh, 8);  // one texel: column 4, row 3
  Image map(8, 8);
  map.at(4, 3) = Rgb(1.0f, 2.0f, 3.0f);
  const Image grown = dilated(map, layout, 2);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) {
      const bool near = std::abs(x - 4) <= 2 && std::abs(y - 3) <= 2;
      EXPECT_EQ(grown.at(x, y), near ? Rgb(1.0f, 2.0f, 3.0f) : Rgb(0.0f)) << x << ", " << y;
    }
}

}  // namespace
}  // namespace vpm
