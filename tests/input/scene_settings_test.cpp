// Scene files: ranges, the camera, the film and how to render; defaults.
#include "vpm/input/scene_file.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "input/expectations.h"
#include "input/scene_text.h"

namespace vpm {
namespace {

TEST(SceneFile, ClosedRangesHoldTheirEnds) {
  const RenderJob loaded = load_with(
      "[materials.a]\ntype = 'conductor'\neta = 1e-3\nk = 1e-6\n"
      "[materials.b]\ntype = 'dielectric'\nior = 1000\n"
      "[integrator]\nmax_optical_step = 1e-4\n"
      "[integrator.distance]\ntype = 'ray-march'\nstep = 1e-3\n");
  EXPECT_EQ(std::get<Conductor>(loaded.scene.materials[0]).k, Rgb(1e-6f));
  EXPECT_EQ(loaded.settings.max_optical_step, 1e-4f);
}

TEST(SceneFile, ReadsCameraAndFilm) {
  const Camera camera = load_with("[film]\nwidth = 30\nheight = 20\nfilter = 'tent'\n", {"camera.fov=90"}).scene.camera;
  EXPECT_EQ(camera.position, Vec3(0, 0, 3));
  EXPECT_LT(glm::length(camera.forward - Vec3(0, 0, -1)), 1e-6f);
  EXPECT_NEAR(camera.tan_half_fov, 1.0f, 1e-6f);
  EXPECT_EQ(camera.width, 30);
  EXPECT_EQ(camera.height, 20);
  EXPECT_EQ(camera.filter.kind, FilterKind::tent);
  EXPECT_EQ(camera.filter.radius, 1.0f);
}

TEST(SceneFile, ReadsEverySetting) {
  const RenderSettings s =
      load_with(
          "[render]\npasses = 3\nseconds = 1.5\nseed = 9\nsamples_per_pixel = 2\nmax_events = 77\n"
          "[integrator]\ntype = 'photon-map'\nradii = 'constant'\nmax_optical_step = 0.25\n"
          "[integrator.photons]\nemitted = 1000\nstored = 500\nin_cube = 4\n"
          "[integrator.importance]\nimportons = 70\naim = false\nsplit = false\nscatter = true\n"
          "[integrator.distance]\ntype = 'ray-march-adaptive'\nstep = 0.5\noptical_step = 0.02\n"
          "[integrator.transmittance]\ntype = 'unbiased-ray-march'\nsamples = 2.5\n"
          "[integrator.volume]\ntype = 'nearest'\nradius = 0.1\ncount = 40\nkernel = 'biweight'\nform = "
          "'density-at-photon'\n"
          "[integrator.single_scattering]\ntype = 'shadow-rays'\n"
          "[integrator.surface]\ntype = 'nearest'\nradius = 0.3\ncount = 60\nkernel = 'constant'\n"
          "[integrator.direct]\ntype = 'photons'\n"
          "[integrator.indirect]\ntype = 'final-gather'\nrays = 5\nrays_by = 'photons'\nirradiance = 'precomputed'\n"
          "[integrator.caustics]\nradius = 0.01\nemitted = 800\n"
          "[media.fog]\ntype = 'homogeneous'\nsigma_s = 1\nsigma_a = 0\n")
          .settings;
  EXPECT_EQ(s.integrator, Integrator::photon);
  EXPECT_EQ(s.until.passes, 3);
  EXPECT_EQ(s.until.seconds, 1.5);
  EXPECT_EQ(s.seed, 9u);
  EXPECT_EQ(s.samples_per_pixel, 2);
  EXPECT_EQ(s.max_events, 77);
  EXPECT_EQ(s.radii, RadiusSchedule::constant);
  EXPECT_EQ(s.max_optical_step, 0.25f);
  EXPECT_EQ(s.photons.emitted, 1000u);
  EXPECT_EQ(s.photons.stored, 500u);
  EXPECT_EQ(s.photons.in_cube, 4u);
  EXPECT_EQ(s.importance.importons, 70u);
  EXPECT_FALSE(s.importance.aim);
  EXPECT_FALSE(s.importance.split);
  EXPECT_TRUE(s.importance.scatter);
  EXPECT_EQ(s.caustics.radius.metres(), 0.01f);
  EXPECT_EQ(s.caustics.emitted, 800u);
  EXPECT_EQ(s.distance.strategy, "ray-march-adaptive");
  EXPECT_EQ(s.distance.parameters, (Parameters{{"step", 0.5f}, {"optical_step", 0.02f}}));
  EXPECT_EQ(s.transmittance.estimator, "unbiased-ray-march");
  EXPECT_EQ(s.transmittance.parameters, (Parameters{{"samples", 2.5f}}));
  EXPECT_EQ(s.volume.type(), "nearest");
  EXPECT_EQ(s.volume.radius.metres(), 0.1f);
  EXPECT_EQ(s.volume.count, 40u);
  EXPECT_EQ(s.volume.kernel, KernelKind::biweight);
  EXPECT_EQ(s.volume.form, VolumeForm::density_at_photon);
  EXPECT_EQ(s.single_scattering.type, DirectLight::shadow_rays);
  EXPECT_EQ(s.surface.mode, GatherMode::nearest);
  EXPECT_EQ(s.surface.radius.metres(), 0.3f);
  EXPECT_EQ(s.surface.count, 60u);
  EXPECT_EQ(s.surface.kernel, KernelKind::constant);
  EXPECT_EQ(s.direct.type, DirectLight::photons);
  EXPECT_EQ(s.indirect.type, IndirectLight::final_gather);
  EXPECT_EQ(s.indirect.rays, 5);
  EXPECT_EQ(s.indirect.rays_by, GatherBy::photons);
  EXPECT_EQ(s.indirect.irradiance, EndIrradiance::precomputed);
}

TEST(SceneFile, CorrectsAtBordersWhereAsked) {
  const RenderSettings volume = load_with("[integrator.volume]\nboundary = 'corrected'\n").settings;
  EXPECT_EQ(volume.volume.boundary, BoundaryRule::corrected);
  EXPECT_EQ(volume.surface.boundary, BoundaryRule::none);
  const RenderSettings surface = load_with("[integrator.surface]\nboundary = 'corrected'\n").settings;
  EXPECT_EQ(surface.volume.boundary, BoundaryRule::ends);  // the default
  EXPECT_EQ(surface.surface.boundary, BoundaryRule::corrected);
  const RenderSettings plain = load_with(
                                   "[integrator.volume]\nboundary = 'none'\n"
                                   "[integrator.surface]\nboundary = 'none'\n")
                                   .settings;
  EXPECT_EQ(plain.volume.boundary, BoundaryRule::none);
  EXPECT_EQ(plain.surface.boundary, BoundaryRule::none);
}

TEST(SceneFile, SingleScatteringMayBeEquiangular) {
  const RenderSettings usual = load_with("[integrator.single_scattering]\ntype = 'equiangular'\n").settings;
  EXPECT_EQ(usual.single_scattering.type, DirectLight::equiangular);
  EXPECT_EQ(usual.single_scattering.samples, RenderSettings{}.single_scattering.samples);
  EXPECT_EQ(load_with("[integrator.single_scattering]\ntype = 'equiangular'\nsamples = 7\n")
                .settings.single_scattering.samples,
            7);
}

TEST(SceneFile, RadiiAreOfAllPassesOrShrinkByPassOrByPixel) {
  const auto with = [](const std::string& radii) {
    return load_with("[integrator]\nradii = '" + radii + "'\n").settings;
  };
  EXPECT_EQ(load_with("").settings.radii, RadiusSchedule::per_pass);
  EXPECT_EQ(with("constant").radii, RadiusSchedule::constant);
  EXPECT_EQ(with("per-pass").radii, RadiusSchedule::per_pass);
  EXPECT_EQ(with("per-pixel").radii, RadiusSchedule::per_pixel);
}

TEST(SceneFile, DefaultsAreThoseOfTheSettings) {
  const RenderSettings s = load_with(
                               "[render]\n[integrator]\n[integrator.photons]\n[integrator.distance]\n"
                               "[integrator.transmittance]\n[integrator.volume]\n[integrator.surface]\n")
                               .settings,
                       d;
  EXPECT_EQ(s.until.passes, d.until.passes);
  EXPECT_EQ(s.seed, d.seed);
  EXPECT_EQ(s.max_events, d.max_events);
  EXPECT_EQ(s.photons.emitted, d.photons.emitted);
  EXPECT_EQ(s.photons.stored, d.photons.stored);
  EXPECT_EQ(s.transmittance.estimator, d.transmittance.estimator);
  EXPECT_EQ(s.volume.count, d.volume.count);
  EXPECT_EQ(s.volume.kernel, d.volume.kernel);
  EXPECT_EQ(s.direct.type, d.direct.type);
  EXPECT_EQ(s.indirect.rays_by, d.indirect.rays_by);
  EXPECT_EQ(s.indirect.irradiance, d.indirect.irradiance);
  EXPECT_EQ(load_with("[integrator.photons]\nstored = 10\n").settings.photons.emitted, 0u);  // until the maps are full
}

TEST(SceneFile, PhotonsFlyByNullCollisionsWhereNothingIsSaid) {
  EXPECT_EQ(load_with("").settings.distance.strategy, "delta-local");
  EXPECT_EQ(load_with("[integrator]\ntype = 'photon-map'\n").settings.distance.strategy, "delta-local");
  for (const char* integrator : {"path", "combined"})
    EXPECT_EQ(load_with(fmt::format("[integrator]\ntype = '{}'\n", integrator)).settings.distance.strategy, "regular");
  EXPECT_EQ(load_with("[integrator.distance]\ntype = 'delta'\n").settings.distance.strategy, "delta");
}

using Keys = AutomaticSettings::Keys;

TEST(SceneFile, AutoIsReadWhereItIsWritten) {
  const RenderJob loaded = load_with(
      "[integrator.photons]\nemitted = 'auto'\n"
      "[integrator.volume]\nradius = 'auto'\n"
      "[integrator.surface]\nradius = 2\n");
  EXPECT_EQ(loaded.automatic.keys, (Keys{"integrator.photons.emitted", "integrator.volume.radius"}));
  EXPECT_FALSE(loaded.settings.volume.radius.is_given());
  EXPECT_EQ(loaded.settings.photons.emitted, RenderSettings{}.photons.emitted);
  EXPECT_EQ(load_with("", {"integrator.indirect.type=final-gather", "integrator.caustics.radius=auto",
                           "integrator.volume.type=auto"})
                .automatic.keys,
            (Keys{"integrator.caustics.radius", "integrator.volume.type"}));
  EXPECT_TRUE(load_with("").automatic.keys.empty());
}

const Keys kAll{"integrator.photons.emitted", "integrator.surface.radius", "integrator.type",
                "integrator.volume.radius"};

TEST(SceneFile, AnAutomaticIntegratorIsChosenWithAllThatItHas) {
  const RenderJob loaded = load_with("[integrator]\ntype = 'auto'\n");
  EXPECT_EQ(loaded.automatic.keys, kAll);
  EXPECT_TRUE(loaded.notes.empty());
}

TEST(SceneFile, RadiiThatAreLeftOutAreKnown) {
  EXPECT_EQ(load_with("").automatic.default_radii, (Keys{"integrator.surface.radius", "integrator.volume.radius"}));
  const RenderJob loaded = load_with(
      "[integrator.volume]\nradius = 'auto'\n"
      "[integrator.indirect]\ntype = 'final-gather'\n"
      "[integrator.surface]\nradius = 2\n");
  EXPECT_EQ(loaded.automatic.default_radii, Keys{"integrator.caustics.radius"});
  EXPECT_TRUE(load_with("[integrator]\ntype = 'path'\n").automatic.default_radii.empty());
}

const char* const kPhotons =
    "[integrator]\ntype = 'photon-map'\n"
    "[integrator.photons]\nstored = 70\n"
    "[integrator.surface]\nradius = 2\n";

TEST(SceneFile, WhatIsLeftOutMayBeAutomatic) {
  const std::string path = write_scene(kCamera + kLight + kPhotons);
  const RenderJob loaded = load_scene(path, {"integrator.distance.type=delta"}, LeftOut::automatic);
  EXPECT_EQ(loaded.automatic.keys, Keys{"integrator.volume.radius"});
  EXPECT_EQ(loaded.settings.surface.radius.metres(), 2.0f);
  EXPECT_EQ(loaded.settings.distance.strategy, "delta");
  EXPECT_TRUE(
      load_scene(path, {"integrator.volume.type=auto"}, LeftOut::automatic).automatic.has("integrator.volume.type"));
  EXPECT_NE(load_scene(path, {}, LeftOut::automatic).hash, load_scene(path).hash);
}

/// A file that says something of an integrator without naming it.
TEST(SceneFile, WhereNothingNamesTheIntegratorAllMayBeAutomatic) {
  const std::string path = write_scene(kCamera + kLight + "[integrator.surface]\nradius = 2\n");
  EXPECT_EQ(load_scene(path, {"render.seconds=2"}, LeftOut::automatic).automatic.keys, kAll);
  const RenderJob without_time = load_scene(path, {}, LeftOut::automatic);
  EXPECT_EQ(without_time.automatic.keys, (Keys{"integrator.photons.emitted", "integrator.volume.radius"}));
  EXPECT_EQ(without_time.settings.surface.radius.metres(), 2.0f);
  const RenderJob loaded = load_scene(path, {}, LeftOut::all_automatic);
  EXPECT_EQ(loaded.automatic.keys, kAll);
  EXPECT_EQ(loaded.notes,
            std::vector<std::string>{"integrator.type is \"auto\" in place of \"photon-map\": left out are "
                                     "integrator.surface.radius"});
  EXPECT_FALSE(loaded.settings.surface.radius.is_given());
  EXPECT_THROW(load_scene(path, {"integrator.surface.radius=3"}, LeftOut::all_automatic), InputError);
  EXPECT_TRUE(load_scene(path, {"integrator.type=path"}, LeftOut::all_automatic).automatic.keys.empty());
}

TEST(SceneFile, TechniquesThatAreLeftOutAreAutomaticWithTheirIntegrator) {
  const std::string path = write_scene(kCamera + kLight);
  const auto chooses_techniques = [&](const std::string& integrator) {
    return load_scene(path, {"integrator.type=" + integrator}, LeftOut::automatic)
        .automatic.has("integrator.techniques");
  };
  EXPECT_TRUE(chooses_techniques("combined"));
  EXPECT_FALSE(chooses_techniques("photon-map"));
}

TEST(SceneFile, AnotherComponentLeavesOutWhatItDoesNotHave) {
  const std::string path = write_scene(kCamera + kLight +
                                       "[integrator.photons]\nemitted = 900\nin_cube = 3\n[integrator.volume]\ntype = "
                                       "'nearest'\ncount = 9\nradius = 2\n");
  const RenderJob combined = load_scene(path, {"integrator.type=combined"});
  EXPECT_EQ(combined.notes,
            std::vector<std::string>{"integrator.type is \"combined\" in place of \"photon-map\": left out are "
                                     "integrator.photons.in_cube, integrator.volume.type, integrator.volume.count"});
  EXPECT_EQ(combined.settings.photons.emitted, 900u);
  EXPECT_EQ(combined.settings.volume.radius.metres(), 2.0f);
  const RenderJob beam = load_scene(path, {"integrator.volume.type=radius"});
  EXPECT_EQ(beam.notes,
            std::vector<std::string>{"integrator.volume.type is \"radius\" in place of \"nearest\": left out "
                                     "are integrator.volume.count"});
  EXPECT_TRUE(load_scene(path, {"integrator.type=photon-map"}).notes.empty());
  // What options say is not left out.
  EXPECT_THROW(load_scene(path, {"integrator.type=path", "integrator.photons.emitted=7"}), InputError);
  EXPECT_EQ(load_scene(path, components_first({"integrator.photons.emitted=7", "integrator.type=combined"}))
                .settings.photons.emitted,
            7u);
  EXPECT_EQ(components_first({"a=1", "integrator.volume.type=beam", "b=2", "integrator.type=path"}),
            (std::vector<std::string>{"integrator.type=path", "integrator.volume.type=beam", "a=1", "b=2"}));
}

/// Options leave out what was a setting, and nothing else.
TEST(SceneFile, OptionsDoNotHideMistakesOfTheFile) {
  const auto message = [](const std::string& text, const std::vector<std::string>& options) {
    return message_of([&] { load_with(text, options); });
  };
  EXPECT_NE(message("[integrator.volume]\nraduis = 0.05\n", {"integrator.volume.type=beam"})
                .find("unknown key 'raduis' in [integrator.volume]"),
            std::string::npos);
  EXPECT_NE(message("[integrator.nonsense]\n", {"integrator.type=path"}).find("unknown key 'nonsense'"),
            std::string::npos);
  const std::string by_option =
      message("[integrator.surface]\nradius = 2\n", {"integrator.type=auto", "integrator.surface.radius=3"});
  EXPECT_NE(by_option.find("--set integrator.surface.radius=3"), std::string::npos) << by_option;
}

/// Each option is seen by itself: only those that leave out something are named, and what stands behind them stays.
TEST(SceneFile, OptionsLeaveOutOneAfterAnother) {
  const std::string photons = "[integrator.photons]\nemitted = 900\n";
  EXPECT_EQ(load_with(photons, {"integrator.type=path", "integrator.distance.type=delta"}).replaced,
            "integrator.type is \"path\" in place of \"photon-map\": left out are integrator.photons.emitted");
  EXPECT_THROW(
      load_with("", {"integrator.type=path", "integrator.photons.emitted=7", "integrator.distance.type=delta"}),
      InputError);
  // Keys that an option made settings, as the common keys of an experiment do.
  EXPECT_EQ(
      load_with("", {"integrator.volume.type=photon-beams", "integrator.volume.flights=7", "integrator.type=path"})
          .replaced,
      "integrator.type is \"path\" in place of \"photon-map\": left out are integrator.volume.type, "
      "integrator.volume.flights");
}

TEST(SceneFile, AnyOptionLeavesOutKeysThatAreNoneAnyMore) {
  const std::string guided = "[integrator.importance]\nimportons = 9\nscatter = true\n";
  EXPECT_EQ(load_with(guided, {"integrator.importance.importons=0"}).replaced,
            "integrator.importance.importons is \"0\" in place of \"9\": left out are integrator.importance.scatter");
  const std::string gathered = "[integrator.indirect]\ntype = 'final-gather'\n[integrator.caustics]\nemitted = 5\n";
  EXPECT_EQ(load_with(gathered, {"integrator.indirect.type=photons"}).replaced,
            "integrator.indirect.type is \"photons\" in place of \"final-gather\": left out are "
            "integrator.caustics.emitted");
  const RenderJob combined = load_with("[integrator]\nradii = 'per-pixel'\n", {"integrator.type=combined"});
  EXPECT_EQ(combined.replaced,
            "integrator.type is \"combined\" in place of \"photon-map\": left out are integrator.radii");
  EXPECT_EQ(combined.settings.radii, RadiusSchedule::per_pass);
}

}  // namespace
}  // namespace vpm
