// The whole path from lights to pixels: identities that need no reference, and ways to the same picture that must
// agree.
#include "vpm/integrators/photon_map/photon_pass.h"

#include <gtest/gtest.h>

#include "support/scenes.h"
#include "support/statistics.h"
#include "vpm/base/statistics/tails.h"
#include "vpm/estimate/photon_map.h"
#include "vpm/estimate/radius_schedule.h"
#include "vpm/film/film.h"
#include "vpm/integrators/path/path_tracer.h"
#include "vpm/integrators/render_scene.h"

namespace vpm {
namespace {

/// The mean over a render's pixels, pass by pass.
Moments pass_means(const Scene& scene, const RenderSettings& settings, int passes) {
  Moments means;
  for (int pass = 0; pass < passes; ++pass) {
    const Image image = render_photon_pass(scene, settings, pass).image;
    double sum = 0.0;
    for (const Rgb& p : image.pixels) sum += sum_channels(p) / 3.0;
    means.add(sum / static_cast<double>(image.pixels.size()));
  }
  return means;
}

RenderSettings settings_of(uint64_t photons, float radius) {
  RenderSettings settings;
  settings.photons.emitted = photons;
  settings.volume.radius = radius;
  settings.surface.radius = radius;
  settings.radii = RadiusSchedule::constant;
  return settings;
}

/// The ways to gather photons of media within a radius: around points of a ray and beside all of it, in both forms.
std::vector<std::pair<std::string, RenderSettings>> volume_estimates(RenderSettings settings) {
  std::vector<std::pair<std::string, RenderSettings>> all;
  for (const std::string type : {"radius", "beam"})
    for (const VolumeForm form : {VolumeForm::density_at_query, VolumeForm::density_at_photon}) {
      settings.volume.choose(type);
      settings.volume.form = form;
      const std::string where = type == "beam" ? "beside rays" : "around points";
      const std::string density = form == VolumeForm::density_at_query ? "query" : "photon";
      all.emplace_back(where + ", density at the " + density, settings);
    }
  return all;
}

/// A light over a floor, seen from above, in vacuum or fog. In fog the floor is black by default, so that only the fog
/// is seen.
Scene lamp_and_floor(const Medium* fog, const Rgb& floor_in_fog = Rgb(0.0f)) {
  Scene scene;
  if (fog) {
    scene.media.push_back(*fog);
    scene.world_medium = 0;
  }
  const QuadLight lamp{Vec3(-0.2f, 1.5f, -0.2f), Vec3(0.4f, 0, 0), Vec3(0, 0, 0.4f), Rgb(10.0f, 5.0f, 2.0f)};
  scene.lights.push_back(lamp);
  add_shape(scene, quad_mesh(lamp.corner, lamp.edge_u, lamp.edge_v), Lambertian{Rgb(0.0f)}, nullptr, 0);
  const Lambertian floor{fog ? floor_in_fog : Rgb(0.6f, 0.5f, 0.4f)};
  add_shape(scene, quad_mesh(Vec3(-3, 0, 3), Vec3(6, 0, 0), Vec3(0, 0, -6)), floor);
  scene.camera = make_camera(Vec3(1.5f, 1.2f, 1.5f), Vec3(0.2f, 0.0f, 0.2f), Vec3(0, 1, 0), 30.0f, {12, 12});
  scene.camera_medium = scene.world_medium;
  scene.geometry.commit();
  finish(scene);
  return scene;
}

/// A ball of albedo 1 in front of uniform light: it must vanish, whatever its density, phase function and the estimate.
Scene furnace(std::shared_ptr<const DensityGrid> grid, float sigma_t) {
  Scene scene;
  Medium medium = make_medium(std::move(grid), Rgb(sigma_t), 1.0f);
  medium.phase = HenyeyGreenstein{-0.3f};
  scene.media.push_back(medium);
  const Interface media{0, kVacuum};
  add_shape(scene, SphereShape{Vec3(0.0f), 1.0f}, Boundary{}, &media);
  scene.lights.push_back(ConstantEnvironment{Rgb(1.0f)});
  scene.camera = make_camera(Vec3(0, 0, 4), Vec3(0.0f), Vec3(0, 1, 0), 16.0f, {10, 10});
  scene.geometry.commit();
  finish(scene);
  return scene;
}

TEST(PhotonPass, AWhiteFurnaceIsUniformThroughGlass) {
  // Scattering glass of IOR 1.5: inside, radiance is 1.5^2 times as large, and must shrink again on its way out.
  Scene scene;
  scene.media.push_back(make_medium(nullptr, Rgb(1.0f), 1.0f));
  const Interface media{0, kVacuum};
  add_shape(scene, SphereShape{Vec3(0.0f), 1.0f}, Dielectric{1.5f}, &media);
  scene.lights.push_back(ConstantEnvironment{Rgb(1.0f)});
  scene.camera = make_camera(Vec3(0, 0, 4), Vec3(0.0f), Vec3(0, 1, 0), 16.0f, {10, 10});
  scene.geometry.commit();
  finish(scene);
  for (const auto& [name, settings] : volume_estimates(settings_of(10000, 0.1f))) {
    const Moments mean = pass_means(scene, settings, 12);
    // As above, the kernel's darkening at the surface.
    EXPECT_NEAR(mean.mean(), 1.0, 0.02 + normal_quantile(kFalseAlarms) * std::sqrt(mean.variance_of_mean())) << name;
  }
}

/// Fog of next to no albedo, in which a thin cone of light falls on black ground 2 m before the camera; a faint panel 2
/// m beyond it.
Scene cone_in_fog(float panel_radiance) {
  Scene scene;
  scene.media.push_back(make_medium(nullptr, Rgb(0.4f, 0.6f, 0.9f), 1e-15f));
  scene.world_medium = 0;
  scene.camera_medium = 0;
  scene.lights.push_back(SpotLight{Vec3(0.0f, 1.0f, 0.0f), Vec3(0, -1, 0), 0.99f, 0.985f, Rgb(1.0f)});
  const QuadLight panel{Vec3(-1, -1, -2), Vec3(2, 0, 0), Vec3(0, 2, 0), Rgb(panel_radiance)};
  scene.lights.push_back(panel);
  add_shape(scene, quad_mesh(panel.corner, panel.edge_u, panel.edge_v), Lambertian{Rgb(0.0f)}, nullptr, 1);
  add_shape(scene, quad_mesh(Vec3(-1, -1, 1), Vec3(2, 0, 0), Vec3(0, 0, -2)), Lambertian{Rgb(0.0f)});
  scene.camera = make_camera(Vec3(0, 0, 2), Vec3(0.0f), Vec3(0, 1, 0), 4.0f, {10, 10});
  scene.geometry.commit();
  finish(scene);
  return scene;
}

TEST(PhotonPass, FogDimsBeforeAndBehindThePhotons) {
  const Scene scene = cone_in_fog(1e-7f);  // too faint to send photons of its own, bright against what the fog scatters
  for (const DirectLight direct : {DirectLight::photons, DirectLight::shadow_rays, DirectLight::equiangular})
    for (auto [name, settings] : volume_estimates(settings_of(1000, 0.05f))) {
      settings.single_scattering.type = direct;
      const Image image = render_photon_pass(scene, settings, 0).image;
      for (const Rgb& pixel : image.pixels)
        for (int c = 0; c < 3; ++c) {
          // 4 m to the panel, up to 0.1 % more at the corners.
          const double exact = 1e-7 * std::exp(-4.0 * scene.media[0].sigma_t[c]);
          EXPECT_NEAR(pixel[c], exact, 0.02 * exact) << static_cast<int>(direct) << name;
        }
    }
}

TEST(PhotonPass, NoLightSpreadsBeyondItsMedium) {
  // Seen along a face of the medium, from outside but within the radius of photons inside: through glass they would
  // count without refraction.
  Scene scene = boxed_medium(make_medium(nullptr, Rgb(1.0f), 0.8f),
                             SpotLight{Vec3(0, 3, 0), Vec3(0, -1, 0), 0.9f, 0.9f, Rgb(1.0f)});
  scene.camera = make_camera(Vec3(1.05f, 0, 4), Vec3(1.05f, 0, 0), Vec3(0, 1, 0), 0.5f, {4, 4});
  for (const auto& [name, settings] : volume_estimates(settings_of(10000, 0.2f))) {
    EXPECT_EQ(pass_means(scene, settings, 1).mean(), 0.0) << name;
  }
}

TEST(PhotonPass, TellsWhichMapsDoNotShowTheirBias) {
  const Medium white = make_medium(nullptr, Rgb(1.0f));
  const Scene both = lamp_and_floor(&white, Rgb(0.5f));
  RenderSettings settings;
  for (const GatherMode mode : {GatherMode::radius, GatherMode::nearest}) {
    settings.volume.choose(mode == GatherMode::nearest ? "nearest" : "radius");
    settings.surface.mode = mode;
    EXPECT_TRUE(maps_of_unseen_bias(both, settings).empty());
  }
  settings.indirect.type = IndirectLight::final_gather;
  EXPECT_TRUE(maps_of_unseen_bias(both, settings).empty());
  settings.indirect.irradiance = EndIrradiance::precomputed;  // a number at a point, which does not tell its correction
  EXPECT_EQ(maps_of_unseen_bias(both, settings), std::vector<std::string>{"surface"});
  EXPECT_TRUE(gathers(both, settings));
  settings.integrator = Integrator::path;
  EXPECT_FALSE(gathers(both, settings));
}

TEST(PhotonPass, AMediumStandsOnAFloor) {
  // The boundary's lower face coincides with the floor: light and sight must meet the floor, not slip through between
  // the two.
  Scene scene;
  scene.media.push_back(make_medium(nullptr, Rgb(1e-6f)));
  const Interface media{0, kVacuum};
  add_shape(scene, box_mesh(Vec3(-1, 0, -1), Vec3(1, 1, 1)), Boundary{}, &media);
  add_shape(scene, quad_mesh(Vec3(-3, 0, 3), Vec3(6, 0, 0), Vec3(0, 0, -6)), Lambertian{Rgb(0.5f)});
  scene.lights.push_back(DirectionalLight{glm::normalize(Vec3(0.2f, -1.0f, 0.1f)), Rgb(1.0f)});
  scene.camera = make_camera(Vec3(0.3f, 3.0f, 0.2f), Vec3(0.0f), Vec3(0, 0, -1), 20.0f, {16, 16});
  scene.geometry.commit();
  finish(scene);
  RenderSettings settings = settings_of(1000, 0.05f);
  const double exact = 0.5 / kPiD * 1.0 / std::sqrt(1.05);
  for (const Rgb& pixel : render_photon_pass(scene, settings, 0).image.pixels) EXPECT_NEAR(pixel.r, exact, 1e-4);
}

TEST(PhotonPass, MajorantsGrowFromPassToPassAndViolationsAreCounted) {
  const GridFrame frame = centered_frame(8, 0.125);
  const auto grid = make_grid(frame, [](int x, int y, int z) { return lattice_noise(x, y, z); });
  Scene scene = boxed_medium(make_medium(grid, Rgb(2.0f)), PointLight{Vec3(0.2f, 1.8f, 0.1f), Rgb(1.0f)});
  scene.camera = make_camera(Vec3(0, 0, 4), Vec3(0.0f), Vec3(0, 1, 0), 30.0f, {8, 8});
  RenderSettings settings = settings_of(2000, 0.2f);
  settings.distance = {"progressive-null", {{"majorant", 0.25f}}};
  for (const Integrator integrator : {Integrator::photon, Integrator::path}) {
    std::vector<WalkCounters> walks;
    for (int pass = 0; pass < 3; ++pass) {
      const bool photons = integrator == Integrator::photon;
      const RenderStatistics s = photons ? render_photon_pass(scene, settings, pass).statistics
                                         : render_path_pass(scene, settings, pass).statistics;
      walks.push_back(photons ? s.ledger.walk : s.eye.walk);
    }
    const auto share_of_violations = [&](size_t pass) {
      return static_cast<double>(walks[pass].majorant_violations) / static_cast<double>(walks[pass].lookups);
    };
    EXPECT_GT(share_of_violations(0), share_of_violations(1));
    EXPECT_GT(walks[1].majorant_violations, 0u);
    EXPECT_EQ(walks[2].majorant_violations, 0u);
    EXPECT_GT(walks[2].null_collisions, 0u);
  }
}

TEST(PhotonPass, RunsOnlyWhatTheSceneNeeds) {
  const Scene no_medium = lamp_and_floor(nullptr);
  EXPECT_TRUE(plan_estimators(no_medium, {}, 0).volume.empty());
  EXPECT_TRUE(plan_estimators(no_medium, {}, 0).surface);
  const Scene no_surface = furnace(nullptr, 1.0f);
  EXPECT_EQ(plan_estimators(no_surface, {}, 0).volume.size(), 1u);
  EXPECT_FALSE(plan_estimators(no_surface, {}, 0).surface);
  EXPECT_FALSE(casts_shadow_rays(facts_of(no_surface), {}));
  const auto statistics = [](const Scene& scene) {
    return render_photon_pass(scene, settings_of(100, 0.1f), 0).statistics;
  };
  EXPECT_EQ(statistics(no_medium).last_volume_radius, 0.0f);
  EXPECT_EQ(statistics(no_medium).last_surface_radius, 0.1f);
  EXPECT_EQ(statistics(no_surface).last_volume_radius, 0.1f);
  EXPECT_EQ(statistics(no_surface).last_surface_radius, 0.0f);
}

/// The mean over the pixels of the variance of one pass.
double noise_of(const Scene& scene, const RenderSettings& settings) {
  constexpr int kPasses = 12;
  Film film(scene.camera.width, scene.camera.height);
  for (int pass = 0; pass < kPasses; ++pass) film.add(pass, render_photon_pass(scene, settings, pass).image);
  double sum = 0.0;
  for (const Rgb& v : film.variance_of_mean().pixels) sum += kPasses * v.g;
  return sum / static_cast<double>(scene.camera.width * scene.camera.height);
}

// Of the photons that pass a ray closely few collide there. The ratio is 221 with these seeds.
TEST(PhotonPass, BeamsHaveLessNoiseThanPhotonsInThinFog) {
  const Medium fog = make_medium(nullptr, Rgb(0.05f), 0.9f);
  const Scene scene = lamp_and_floor(&fog);
  RenderSettings settings = settings_of(5'000, 0.05f);
  settings.volume.choose("beam");
  const double photons = noise_of(scene, settings);
  settings.volume.choose("photon-beams");
  const double beams = noise_of(scene, settings);
  EXPECT_GT(photons, 100.0 * beams);
}

/// Where photons must be independent of each other, or are guided, the sequence makes no difference; elsewhere it does.
TEST(PhotonPass, PhotonsAreRandomWhereTheyMustBeIndependent) {
  const Medium fog = make_medium(nullptr, Rgb(0.05f), 0.9f);
  const Scene scene = lamp_and_floor(&fog, Rgb(0.5f));
  const auto differs = [&](auto change) {
    RenderSettings settings = settings_of(1000, 0.5f);
    change(settings);
    const Pass even = render_photon_pass(scene, settings, 0);
    settings.photons.sequence = PhotonSequence::random;
    return even.image.pixels != render_photon_pass(scene, settings, 0).image.pixels;
  };
  EXPECT_TRUE(differs([](RenderSettings&) {}));
  EXPECT_FALSE(differs([](RenderSettings& s) { s.volume.choose("nearest"); }));
  EXPECT_FALSE(differs([](RenderSettings& s) { s.surface.mode = GatherMode::nearest; }));
  EXPECT_TRUE(differs([](RenderSettings& s) { s.caustics.mode = GatherMode::nearest; })) << "there is no such map";
  EXPECT_FALSE(differs([](RenderSettings& s) {
    s.indirect.type = IndirectLight::final_gather;
    s.caustics.mode = GatherMode::nearest;
  }));
  EXPECT_FALSE(differs([](RenderSettings& s) { s.importance.importons = 100; }));
  EXPECT_FALSE(differs([](RenderSettings& s) {
    s.indirect.type = IndirectLight::final_gather;
    s.indirect.irradiance = EndIrradiance::precomputed;
  }));
}

/// What a pass finds of many flights has less noise where these are spread evenly. The variances are those of 144
/// pixels by 12 passes each.
TEST(PhotonPass, PointsOfASequenceHaveLessNoiseThanRandomNumbers) {
  const Medium fog = make_medium(nullptr, Rgb(0.05f), 0.9f);
  const Scene scene = lamp_and_floor(&fog);
  RenderSettings settings = settings_of(30'000, 0.3f);
  settings.samples_per_pixel = 16;  // what lies within a pixel varies, too
  settings.volume.choose("photon-beams");
  const double even = noise_of(scene, settings);
  settings.photons.sequence = PhotonSequence::random;
  EXPECT_GT(noise_of(scene, settings), 1.5 * even);
}

/// Rays to even places on lamps and skies: the same light, and less noise than as many rays to random places.
TEST(PhotonPass, ShadowRaysToEvenPlacesHaveLessNoise) {
  Scene scene = lamp_and_floor(nullptr);
  scene.camera.filter.radius = 0.01f;  // what lies within a pixel does not vary
  RenderSettings settings = settings_of(1, 0.1f);
  settings.direct.samples = 1;
  const Moments one = pass_means(scene, settings, 400);
  settings.direct.samples = 8;
  const Moments eight = pass_means(scene, settings, 400);
  expect_same_means({one}, {eight}, 1e-6, "even places");
  EXPECT_GT(one.variance(), 3.0 * 8.0 * eight.variance());
}

/// Of lamps of every shape and of a sky, also where their number is no power of two.
TEST(PhotonPass, SeveralShadowRaysBringTheSameLight) {
  Scene scene = lamp_and_floor(nullptr);
  scene.lights.push_back(SphereLight{Vec3(0.5f, 0.8f, 0.2f), 0.1f, Rgb(5.0f)});
  scene.lights.push_back(DiscLight{Vec3(-0.5f, 1.0f, 0.0f), Vec3(0.0f, -1.0f, 0.0f), 0.3f, Rgb(2.0f)});
  scene.lights.push_back(PointLight{Vec3(0.0f, 0.7f, 0.5f), Rgb(0.3f)});
  scene.lights.push_back(
      MeshLight{std::make_shared<const EmittingMesh>(box_mesh(Vec3d(-0.9, 0.4, 0), Vec3d(-0.7, 0.6, 0.2))), Rgb(4.0f)});
  scene.lights.push_back(ConstantEnvironment{Rgb(0.5f)});
  finish_again(scene);
  RenderSettings settings = settings_of(1, 0.1f);
  settings.direct.samples = 1;
  const auto shadow_rays = [&] { return render_photon_pass(scene, settings, 0).statistics.eye.shadow_rays; };
  const uint64_t rays = shadow_rays();  // one to each of six lights
  const Moments one = pass_means(scene, settings, 300);
  settings.direct.samples = 5;
  expect_same_means({one}, {pass_means(scene, settings, 300)}, 1e-6, "five rays");
  EXPECT_EQ(shadow_rays() * 6, rays * (5 * 5 + 1));
}

/// Sums by whole nodes of photons take memory, which only diffuse surfaces have a use for.
TEST(PhotonPass, PreparesSumsByNodesForDiffuseSurfaces) {
  const auto more_bytes_of_many = [](const Material& of_floor) {
    Scene scene = lamp_and_floor(nullptr);
    scene.materials[1] = of_floor;
    const auto bytes = [&](uint32_t count) {
      RenderSettings settings = settings_of(20'000, 0.5f);
      settings.surface.mode = GatherMode::nearest;
      settings.surface.count = count;
      settings.direct.type = DirectLight::photons;
      return render_photon_pass(scene, settings, 0).statistics.photon_map_bytes;
    };
    return bytes(NearestMap::kMany) - bytes(NearestMap::kMany - 1);
  };
  EXPECT_GT(more_bytes_of_many(Lambertian{Rgb(0.5f)}), 0u);
  EXPECT_EQ(more_bytes_of_many(Phong{}), 0u);
}

}  // namespace
}  // namespace vpm
