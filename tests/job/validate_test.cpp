// Settings that contradict themselves or the scene are refused from code, too, by the key that is wrong.
#include "vpm/job/validate.h"

#include <gtest/gtest.h>

#include <functional>

#include "vpm/job/bake.h"
#include "vpm/job/render.h"

namespace vpm {
namespace {

constexpr SceneFacts kEverything{.grids = true, .scattering_media = true, .rough_surfaces = true};

/// The key that is refused; "" where none is.
std::string refused(const RenderSettings& settings, const SceneFacts& facts) {
  try {
    validate(settings, facts);
  } catch (const SettingError& error) {
    EXPECT_EQ(std::string(error.what()).find(error.key() + ": " + error.wrong()), 0u) << error.what();
    return error.key();
  }
  return "";
}

struct Contradiction {
  const char* key;
  std::function<void(RenderSettings&)> make;
};
using S = RenderSettings;

S& combine(S& s) {
  s.integrator = Integrator::combined;
  return s;
}

S& by_blocks(S& s) {
  s.photons_block = 1000;
  return s;
}

S& gather_finally(S& s) {
  s.surface_indirect = IndirectLight::final_gather;
  return s;
}

const Contradiction kContradictions[] = {
    {"photons.emitted", [](S& s) { s.photons_emitted = 0; }},
    {"photons.in_cube", [](S& s) { s.photons_in_cube = 4, s.radii = RadiusSchedule::per_pixel; }},
    {"photons.flights", [](S& s) { s.flights = 100; }},
    {"photons.planes", [](S& s) { s.volume.mode = GatherMode::photon_beams, s.planes = 100; }},
    {"photons.in_cube", [](S& s) { s.volume.mode = GatherMode::photon_beams, s.photons_in_cube = 4; }},
    {"photons.stored", [](S& s) { s.volume.mode = GatherMode::beams_points, s.photons_stored = 1000; }},
    {"volume.density_floor", [](S& s) { s.volume.mode = GatherMode::beams_points, s.density_floor = 0.2f; }},
    {"volume.planes", [](S& s) { s.volume.mode = GatherMode::photon_beams, s.plane_use = PlaneUse::alone; }},
    {"volume.beams", [](S& s) { s.volume.mode = GatherMode::beam, s.beam_length = BeamLength::long_beams; }},
    {"distance.strategy",
     [](S& s) { s.volume.mode = GatherMode::photon_planes, s.distance.strategy = "mean-extinction"; }},
    {"distance.strategy",
     [](S& s) { s.volume.mode = GatherMode::photon_beams, s.distance.strategy = "mean-extinction"; }},
    {"volume.count", [](S& s) { s.volume.mode = GatherMode::photon_beams, s.volume.beam_count = 20; }},
    {"combined.heuristic", [](S& s) { s.combined.heuristic = Heuristic::power; }},
    {"combined.techniques", [](S& s) { s.combined.techniques.set(Technique::points_3d, false); }},
    {"distance.strategy", [](S& s) { combine(s).distance.strategy = "mean-extinction"; }},
    {"distance.strategy", [](S& s) { combine(s).distance.strategy = "ray-march"; }},
    {"transmittance.estimator", [](S& s) { combine(s).transmittance.estimator = "ratio"; }},
    {"importance.importons", [](S& s) { combine(s).guide.importons = 100; }},
    {"photons.stored", [](S& s) { combine(s).photons_stored = 100; }},
    {"photons.in_cube", [](S& s) { combine(s).photons_in_cube = 4; }},
    {"render.radii", [](S& s) { combine(s).radii = RadiusSchedule::per_pixel; }},
    {"importance.aim", [](S& s) { s.guide.aim = false; }},
    {"importance.split", [](S& s) { s.guide.split = false; }},
    {"importance.scatter", [](S& s) { s.guide.scatter = true; }},
    {"distance.strategy", [](S& s) { s.distance.strategy = "homogeneous"; }},
    {"distance.strategy", [](S& s) { s.distance.strategy = "weighted"; }},
    {"distance.strategy", [](S& s) { s.distance.strategy = "woodcock"; }},
    {"transmittance.estimator",
     [](S& s) { s.transmittance.estimator = "ratio", s.surface_direct = DirectLight::photons; }},
    {"photons.block", [](S& s) { combine(s).photons_block = 100; }},
    {"photons.stored", [](S& s) { by_blocks(s).photons_stored = 100; }},
    {"photons.stored", [](S& s) { by_blocks(s).photons_stored = 100, s.photons_emitted = 0; }},
    {"photons.in_cube", [](S& s) { by_blocks(s).photons_in_cube = 4; }},
    {"photons.flights", [](S& s) { by_blocks(s).volume.mode = GatherMode::photon_beams, s.flights = 100; }},
    {"volume.gather", [](S& s) { by_blocks(s).volume.mode = GatherMode::nearest; }},
    {"volume.gather", [](S& s) { by_blocks(s).volume.mode = GatherMode::photon_planes; }},
    {"volume.gather", [](S& s) { by_blocks(s).volume.mode = GatherMode::beams_points; }},
    {"volume.count", [](S& s) { by_blocks(s).volume.mode = GatherMode::beam, s.volume.beam_count = 20; }},
    {"surface.gather", [](S& s) { by_blocks(s).surface.mode = GatherMode::nearest; }},
    {"caustics.gather", [](S& s) { gather_finally(by_blocks(s)).caustics.mode = GatherMode::nearest; }},
    {"caustics.emitted", [](S& s) { gather_finally(by_blocks(s)).caustics_emitted = 100; }},
    {"surface.gather_by", [](S& s) { gather_finally(by_blocks(s)).gather_by = GatherBy::photons; }},
    {"surface.irradiance", [](S& s) { gather_finally(by_blocks(s)).end_irradiance = EndIrradiance::precomputed; }},
    {"volume.boundary", [](S& s) { s.volume.boundary = BoundaryRule::corrected, s.photons_in_cube = 4; }},
    {"surface.boundary", [](S& s) { s.surface.boundary = BoundaryRule::corrected, s.photons_in_cube = 4; }},
    {"volume.count", [](S& s) { s.volume.count = 20; }},
    {"volume.density_floor", [](S& s) { s.density_floor = 0.2f, s.distance.strategy = "local-extinction"; }},
    {"caustics.count", [](S& s) { s.caustics.count = 20; }},
    {"volume.direct_samples", [](S& s) { s.direct_samples = 3; }},
    {"surface.direct_samples", [](S& s) { s.surface_direct_samples = 3, s.surface_direct = DirectLight::photons; }},
    {"surface.direct", [](S& s) { s.surface_direct = DirectLight::equiangular; }},
    {"surface.gather", [](S& s) { s.surface.mode = GatherMode::beam; }},
    {"surface.gather_rays", [](S& s) { s.gather_rays = 64; }},
    {"surface.gather_by", [](S& s) { s.gather_by = GatherBy::photons; }},
    {"caustics.emitted", [](S& s) { s.caustics_emitted = 100; }},
    {"surface.irradiance", [](S& s) { s.end_irradiance = EndIrradiance::precomputed; }},
    {"surface.irradiance",
     [](S& s) {
       s.end_irradiance = EndIrradiance::precomputed, s.surface.boundary = BoundaryRule::corrected;
       s.surface_indirect = IndirectLight::final_gather;
     }},
    {"surface.gather", [](S& s) { s.radii = RadiusSchedule::per_pixel, s.surface.mode = GatherMode::nearest; }},
    {"surface.indirect",
     [](S& s) { s.radii = RadiusSchedule::per_pixel, s.surface_indirect = IndirectLight::final_gather; }},
    {"surface.kernel", [](S& s) { s.radii = RadiusSchedule::per_pixel, s.surface.kernel = KernelKind::order_4; }},
    {"surface.kernel",
     [](S& s) {
       s.surface_indirect = IndirectLight::final_gather, s.end_irradiance = EndIrradiance::precomputed;
       s.surface.kernel = KernelKind::order_4;
     }},
    {"surface.boundary",
     [](S& s) { s.radii = RadiusSchedule::per_pixel, s.surface.boundary = BoundaryRule::corrected; }},
    {"render.passes", [](S& s) { s.until.passes = 0; }},
    {"render.max_optical_step", [](S& s) { s.max_optical_step = 0.0f; }},
    {"volume.radius", [](S& s) { s.volume.radius = -1.0f; }},
    {"volume.density_floor", [](S& s) { s.density_floor = std::numeric_limits<float>::quiet_NaN(); }},
};

TEST(Validate, LongBeamsNeedAnEnd) {
  RenderSettings s;
  s.volume.mode = GatherMode::photon_beams;
  s.beam_length = BeamLength::long_beams;
  EXPECT_EQ(refused(s, {.scattering_media = true}), "");
  EXPECT_EQ(refused(s, {.scattering_media = true, .endless = true}), "volume.beams");
  s.beam_length = BeamLength::short_beams;
  EXPECT_EQ(refused(s, {.scattering_media = true, .endless = true}), "");
  EXPECT_EQ(refused(s, {.scattering_media = true, .endless = true, .endless_flights = true}), "volume.gather");
}

TEST(Validate, BeamsOfCombinedTechniquesNeedAnEndInEveryChannel) {
  RenderSettings s;
  combine(s);
  const SceneFacts endless{.scattering_media = true, .endless = true, .endless_flights = true};
  EXPECT_EQ(refused(s, endless), "combined.techniques");
  s.combined.techniques.set(Technique::short_beams, false);
  EXPECT_EQ(refused(s, endless), "");
}

TEST(Validate, LongBeamsOfCombinedTechniquesNeedAnEnd) {
  RenderSettings s;
  combine(s);
  const SceneFacts endless{.scattering_media = true, .endless = true};
  EXPECT_EQ(refused(s, endless), "");
  s.combined.techniques.set(Technique::long_beams, true);
  EXPECT_EQ(refused(s, {.scattering_media = true}), "");
  EXPECT_EQ(refused(s, endless), "combined.techniques");
}

TEST(Validate, PlanesAreCountedWhereThereAreAny) {
  RenderSettings s;
  combine(s);
  s.planes = 10;
  s.combined.techniques.set(Technique::planes, true);
  EXPECT_EQ(refused(s, {.scattering_media = true}), "");
  s.combined.techniques.set(Technique::planes, false);
  EXPECT_EQ(refused(s, {.scattering_media = true}), "photons.planes");
}

TEST(Validate, FactsTellWhetherFlightsEnd) {
  Medium medium;
  medium.sigma_s = Rgb(0.1f, 0.2f, 0.0f);
  for (const float blue : {0.0f, 1e-6f}) {
    medium.sigma_t = Rgb(0.1f, 0.2f, blue);
    SceneFacts facts;
    facts.add_world(medium);
    EXPECT_TRUE(facts.endless);
    EXPECT_EQ(facts.endless_flights, blue == 0.0f);
  }
  SceneFacts facts;
  medium.sigma_s = Rgb(0.0f);
  facts.add_world(medium);
  EXPECT_FALSE(facts.endless || facts.endless_flights) << "nothing scatters";
}

TEST(Validate, PlanesCastShadowRays) {
  RenderSettings s;
  s.surface_direct = DirectLight::photons;
  s.transmittance.estimator = "ratio";
  EXPECT_EQ(refused(s, {.scattering_media = true}), "transmittance.estimator");
  s.volume.mode = GatherMode::photon_planes;
  EXPECT_EQ(refused(s, {.scattering_media = true}), "");
}

// Where paths are traced, settings of photons may stand.
TEST(Validate, BlocksGoWithSumsOverPhotons) {
  for (const GatherMode mode : {GatherMode::radius, GatherMode::beam, GatherMode::photon_beams})
    for (const BoundaryRule rule : {BoundaryRule::none, BoundaryRule::ends, BoundaryRule::corrected}) {
      RenderSettings s;
      by_blocks(s).volume.mode = mode;
      s.volume.boundary = rule;
      EXPECT_EQ(refused(s, kEverything), "");
    }
  for (const IndirectLight indirect : {IndirectLight::photons, IndirectLight::final_gather}) {
    RenderSettings s;
    by_blocks(s).surface.boundary = BoundaryRule::corrected;
    s.surface_indirect = indirect;
    s.guide.importons = 100;
    EXPECT_EQ(refused(s, kEverything), "");
  }
  RenderSettings s;
  by_blocks(s).radii = RadiusSchedule::per_pixel;
  EXPECT_EQ(refused(s, kEverything), "");
  s = {};
  by_blocks(s).integrator = Integrator::path;
  s.volume.mode = GatherMode::nearest;
  EXPECT_EQ(refused(s, kEverything), "");
}

// The default of volume.boundary goes with everything; and beams know all its words.
TEST(Validate, BordersOfMediaRefuseNoOtherSetting) {
  for (const GatherMode mode : {GatherMode::radius, GatherMode::nearest, GatherMode::beam, GatherMode::photon_beams,
                                GatherMode::photon_planes, GatherMode::beams_points})
    for (const VolumeForm form : {VolumeForm::density_at_query, VolumeForm::density_at_photon})
      for (const uint32_t in_cube : {0u, 4u})
        for (const BoundaryRule rule : {BoundaryRule::none, BoundaryRule::ends, BoundaryRule::corrected}) {
          RenderSettings s;
          EXPECT_EQ(s.volume.boundary, BoundaryRule::ends);
          s.volume.mode = mode;
          s.volume.boundary = rule;
          s.volume_form = form;
          s.photons_in_cube = in_cube;
          const bool asks_merged =
              in_cube > 0 && (s.volume.crosses_beams() || (rule == BoundaryRule::corrected && !s.volume.along_rays()));
          if (!asks_merged) {
            EXPECT_NO_THROW(validate(s, {.scattering_media = true}));
          }
        }
}

TEST(Validate, NamesTheKeyOfEachContradiction) {
  for (const Contradiction& each : kContradictions) {
    RenderSettings settings;
    each.make(settings);
    EXPECT_EQ(refused(settings, kEverything), each.key);
  }
}

TEST(Validate, AllowsDefaultsInAnyScene) {
  for (const bool grids : {false, true})
    for (const bool media : {false, true})
      for (const bool surfaces : {false, true}) EXPECT_EQ(refused({}, {grids, media, surfaces}), "");
}

TEST(Validate, AsksTheSceneWhereThatDecides) {
  RenderSettings s;
  s.distance.strategy = "homogeneous";
  EXPECT_EQ(refused(s, {.scattering_media = true}), "");
  s = {};
  s.transmittance.estimator = "ratio";
  EXPECT_EQ(refused(s, {.rough_surfaces = true}), "");
  EXPECT_EQ(refused(s, {.scattering_media = true}), "transmittance.estimator");
  s.volume_direct = DirectLight::shadow_rays;
  EXPECT_EQ(refused(s, {.scattering_media = true}), "");
  s = {};
  s.integrator = Integrator::path;
  s.transmittance.estimator = "ratio";
  s.distance.strategy = "weighted";
  EXPECT_EQ(refused(s, {}), "");
}

TEST(Validate, TakesACountWhereGathersGoByIt) {
  RenderSettings s;
  s.volume.mode = GatherMode::beam;
  s.volume.beam_count = 20;
  s.surface.mode = GatherMode::nearest;
  s.surface.count = 20;
  s.volume_direct = DirectLight::equiangular;
  s.direct_samples = 3;
  EXPECT_EQ(refused(s, kEverything), "");
  s.surface.count = 1;
  EXPECT_EQ(refused(s, kEverything), "surface.count");
}

/// A render from code is refused before its first pass.
TEST(Validate, StandsBeforeEveryRender) {
  const Scene scene;
  RenderSettings s;
  s.guide.scatter = true;
  EXPECT_THROW(render(scene, s, {Film(1, 1), {}, 0.0, {}}), SettingError);
  EXPECT_THROW(bake_light_map(scene, s, {}, {}), SettingError);
  for (const auto& change : std::vector<std::function<void(RenderSettings&)>>{
           [](RenderSettings& other) { other.integrator = Integrator::path; },
           [](RenderSettings& other) { other.radii = RadiusSchedule::per_pixel; },
           [](RenderSettings& other) { other.until.error = 0.1; }}) {
    RenderSettings of_light_map;
    change(of_light_map);
    EXPECT_THROW(bake_light_map(scene, of_light_map, {}, {}), SettingError);
  }
}

}  // namespace
}  // namespace vpm
