// Settings that contradict themselves or the scene are refused from code, too, by the key that is wrong.
#include "vpm/integrators/render_scene.h"

#include <gtest/gtest.h>

#include <functional>

#include "vpm/integrators/photon_map/volume/estimator_info.h"
#include "vpm/job/bake.h"
#include "vpm/render/render.h"

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
  s.photons.block = 1000;
  return s;
}

S& gather_finally(S& s) {
  s.indirect.type = IndirectLight::final_gather;
  return s;
}

const Contradiction kContradictions[] = {
    {"integrator.photons.emitted", [](S& s) { s.photons.emitted = 0; }},
    {"integrator.photons.in_cube", [](S& s) { s.photons.in_cube = 4, s.radii = RadiusSchedule::per_pixel; }},
    {"integrator.photons.in_cube", [](S& s) { s.volume.choose("photon-beams"), s.photons.in_cube = 4; }},
    {"integrator.photons.stored", [](S& s) { s.volume.choose("beams-points"), s.photons.stored = 1000; }},
    {"integrator.distance.type",
     [](S& s) { s.volume.choose("photon-planes"), s.distance.strategy = "mean-extinction"; }},
    {"integrator.distance.type",
     [](S& s) { s.volume.choose("photon-beams"), s.distance.strategy = "mean-extinction"; }},
    {"integrator.distance.type", [](S& s) { combine(s).distance.strategy = "mean-extinction"; }},
    {"integrator.distance.type", [](S& s) { combine(s).distance.strategy = "ray-march"; }},
    {"integrator.radii", [](S& s) { combine(s).radii = RadiusSchedule::per_pixel; }},
    {"integrator.distance.type", [](S& s) { s.distance.strategy = "homogeneous"; }},
    {"integrator.distance.type", [](S& s) { s.distance.strategy = "weighted"; }},
    {"integrator.distance.type", [](S& s) { s.distance.strategy = "woodcock"; }},
    {"integrator.transmittance.type",
     [](S& s) { s.transmittance.estimator = "ratio", s.direct.type = DirectLight::photons; }},
    {"integrator.photons.stored", [](S& s) { by_blocks(s).photons.stored = 100; }},
    {"integrator.photons.stored", [](S& s) { by_blocks(s).photons.stored = 100, s.photons.emitted = 0; }},
    {"integrator.photons.in_cube", [](S& s) { by_blocks(s).photons.in_cube = 4; }},
    {"integrator.volume.flights", [](S& s) { by_blocks(s).volume.choose("photon-beams"), s.volume.flights = 100; }},
    {"integrator.volume.type", [](S& s) { by_blocks(s).volume.choose("nearest"); }},
    {"integrator.volume.type", [](S& s) { by_blocks(s).volume.choose("photon-planes"); }},
    {"integrator.volume.type", [](S& s) { by_blocks(s).volume.choose("beams-points"); }},
    {"integrator.volume.count", [](S& s) { by_blocks(s).volume.choose("beam"), s.volume.beam_count = 20; }},
    {"integrator.surface.type", [](S& s) { by_blocks(s).surface.mode = GatherMode::nearest; }},
    {"integrator.caustics.type", [](S& s) { gather_finally(by_blocks(s)).caustics.mode = GatherMode::nearest; }},
    {"integrator.caustics.emitted", [](S& s) { gather_finally(by_blocks(s)).caustics.emitted = 100; }},
    {"integrator.indirect.rays_by", [](S& s) { gather_finally(by_blocks(s)).indirect.rays_by = GatherBy::photons; }},
    {"integrator.indirect.irradiance",
     [](S& s) { gather_finally(by_blocks(s)).indirect.irradiance = EndIrradiance::precomputed; }},
    {"integrator.volume.boundary", [](S& s) { s.volume.boundary = BoundaryRule::corrected, s.photons.in_cube = 4; }},
    {"integrator.surface.boundary", [](S& s) { s.surface.boundary = BoundaryRule::corrected, s.photons.in_cube = 4; }},
    {"integrator.direct.type", [](S& s) { s.direct.type = DirectLight::equiangular; }},
    {"integrator.indirect.irradiance",
     [](S& s) {
       s.indirect.irradiance = EndIrradiance::precomputed, s.surface.boundary = BoundaryRule::corrected;
       s.indirect.type = IndirectLight::final_gather;
     }},
    {"integrator.surface.type",
     [](S& s) { s.radii = RadiusSchedule::per_pixel, s.surface.mode = GatherMode::nearest; }},
    {"integrator.indirect.type",
     [](S& s) { s.radii = RadiusSchedule::per_pixel, s.indirect.type = IndirectLight::final_gather; }},
    {"integrator.surface.kernel",
     [](S& s) { s.radii = RadiusSchedule::per_pixel, s.surface.kernel = KernelKind::order_4; }},
    {"integrator.surface.kernel",
     [](S& s) {
       s.indirect.type = IndirectLight::final_gather, s.indirect.irradiance = EndIrradiance::precomputed;
       s.surface.kernel = KernelKind::order_4;
     }},
    {"integrator.surface.boundary",
     [](S& s) { s.radii = RadiusSchedule::per_pixel, s.surface.boundary = BoundaryRule::corrected; }},
    {"render.passes", [](S& s) { s.until.passes = 0; }},
    {"integrator.photons.emitted", [](S& s) { combine(s).photons.emitted = 0; }},
    {"integrator.max_optical_step", [](S& s) { s.max_optical_step = 0.0f; }},
    {"integrator.volume.radius", [](S& s) { s.volume.radius = -1.0f; }},
    {"integrator.volume.density_floor", [](S& s) { s.volume.density_floor = std::numeric_limits<float>::quiet_NaN(); }},
};

TEST(Validate, LongBeamsNeedAnEnd) {
  RenderSettings s;
  s.volume.choose("photon-beams");
  s.volume.length = BeamLength::long_beams;
  EXPECT_EQ(refused(s, {.scattering_media = true}), "");
  EXPECT_EQ(refused(s, {.scattering_media = true, .endless = true}), "integrator.volume.length");
  s.volume.length = BeamLength::short_beams;
  EXPECT_EQ(refused(s, {.scattering_media = true, .endless = true}), "");
  EXPECT_EQ(refused(s, {.scattering_media = true, .endless = true, .endless_flights = true}), "integrator.volume.type");
}

TEST(Validate, BeamsOfCombinedTechniquesNeedAnEndInEveryChannel) {
  RenderSettings s;
  combine(s);
  EXPECT_EQ(refused(s, {.scattering_media = true, .endless = true}), "");
  const SceneFacts endless{.scattering_media = true, .endless = true, .endless_flights = true};
  EXPECT_EQ(refused(s, endless), "integrator.techniques");
  s.combined.techniques.set(Technique::short_beams, false);
  EXPECT_EQ(refused(s, endless), "");
}

/// What the chosen components do not have is not looked at.
TEST(Validate, LooksAtTheChosenComponentsAlone) {
  RenderSettings s;
  s.volume.flights = 100;
  s.volume.length = BeamLength::long_beams;
  s.single_scattering.samples = -1;
  s.volume.count = 0;
  s.indirect.rays = 0;
  s.combined.heuristic = Heuristic::power;
  EXPECT_EQ(refused(s, {.scattering_media = true, .endless = true}), "");
  for (const Integrator integrator : {Integrator::path, Integrator::combined}) {
    s = {};
    s.integrator = integrator;
    s.photons.in_cube = 4;
    s.radii = integrator == Integrator::path ? RadiusSchedule::per_pixel : RadiusSchedule::constant;
    by_blocks(s).photons.stored = 7;
    EXPECT_EQ(refused(s, kEverything), "");
  }
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
  s.direct.type = DirectLight::photons;
  s.transmittance.estimator = "ratio";
  EXPECT_EQ(refused(s, {.scattering_media = true}), "integrator.transmittance.type");
  s.volume.choose("photon-planes");
  EXPECT_EQ(refused(s, {.scattering_media = true}), "");
}

// Where paths are traced, settings of photons may stand.
TEST(Validate, BlocksGoWithSumsOverPhotons) {
  for (const char* type : {"radius", "beam", "photon-beams"})
    for (const BoundaryRule rule : {BoundaryRule::none, BoundaryRule::ends, BoundaryRule::corrected}) {
      RenderSettings s;
      by_blocks(s).volume.choose(type);
      s.volume.boundary = rule;
      EXPECT_EQ(refused(s, kEverything), "");
    }
  for (const IndirectLight indirect : {IndirectLight::photons, IndirectLight::final_gather}) {
    RenderSettings s;
    by_blocks(s).surface.boundary = BoundaryRule::corrected;
    s.indirect.type = indirect;
    s.importance.importons = 100;
    EXPECT_EQ(refused(s, kEverything), "");
  }
  RenderSettings s;
  by_blocks(s).radii = RadiusSchedule::per_pixel;
  EXPECT_EQ(refused(s, kEverything), "");
  s = {};
  by_blocks(s).integrator = Integrator::path;
  s.volume.choose("nearest");
  EXPECT_EQ(refused(s, kEverything), "");
}

// The default of volume.boundary goes with everything; and beams know all its words.
TEST(Validate, BordersOfMediaRefuseNoOtherSetting) {
  for (const VolumeEstimatorInfo& info : volume_estimators())
    for (const VolumeForm form : {VolumeForm::density_at_query, VolumeForm::density_at_photon})
      for (const uint32_t in_cube : {0u, 4u})
        for (const BoundaryRule rule : {BoundaryRule::none, BoundaryRule::ends, BoundaryRule::corrected}) {
          RenderSettings s;
          EXPECT_EQ(s.volume.boundary, BoundaryRule::ends);
          s.volume.choose(info.name);
          s.volume.boundary = rule;
          s.volume.form = form;
          s.photons.in_cube = in_cube;
          const bool asks_merged = in_cube > 0 && ((info.flights && info.along_rays) ||
                                                   (rule == BoundaryRule::corrected && !info.along_rays));
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
  EXPECT_EQ(refused(s, {.scattering_media = true}), "integrator.transmittance.type");
  s.single_scattering.type = DirectLight::shadow_rays;
  EXPECT_EQ(refused(s, {.scattering_media = true}), "");
  s = {};
  s.integrator = Integrator::path;
  s.transmittance.estimator = "ratio";
  s.distance.strategy = "weighted";
  EXPECT_EQ(refused(s, {}), "");
}

TEST(Validate, TakesACountWhereGathersGoByIt) {
  RenderSettings s;
  s.volume.choose("beam");
  s.volume.beam_count = 20;
  s.surface.mode = GatherMode::nearest;
  s.surface.count = 20;
  s.single_scattering.type = DirectLight::equiangular;
  s.single_scattering.samples = 3;
  EXPECT_EQ(refused(s, kEverything), "");
  s.surface.count = 1;
  EXPECT_EQ(refused(s, kEverything), "integrator.surface.count");
}

/// A render from code is refused before its first pass.
TEST(Validate, StandsBeforeEveryRender) {
  const Scene scene;
  RenderSettings s;
  s.photons.emitted = 0;
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
