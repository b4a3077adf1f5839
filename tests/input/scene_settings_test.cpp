// Scene files: ranges, the camera, the film and how to render; defaults.
#include "vpm/input/scene_file.h"

#include <gtest/gtest.h>

#include "input/scene_text.h"

namespace vpm {
namespace {

TEST(SceneFile, ClosedRangesHoldTheirEnds) {
  const RenderJob loaded = load_with(
      "[materials.a]\ntype = 'conductor'\neta = 1e-3\nk = 1e-6\n[materials.b]\ntype = 'dielectric'\nior = 1000\n"
      "[render]\nmax_optical_step = 1e-4\n[distance]\nstep = 1e-3\n");
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
          "[render]\nintegrator = 'photon'\npasses = 3\nseconds = 1.5\nseed = 9\nsamples_per_pixel = 2\nmax_events = "
          "77\nradii = 'constant'\n"
          "max_optical_step = 0.25\n[photons]\nemitted = 1000\nstored = 500\nin_cube = 4\n[importance]\nimportons = "
          "70\n"
          "aim = false\nsplit = false\nscatter = true\n[distance]\nstrategy = 'ray-march'\nstep "
          "= 0.5\noptical_step = 0.02\nextinction_floor = 0.2\nmajorant = 0.125\n"
          "[transmittance]\nestimator = 'ray-march'\nstep = 0.75\nsamples = 2.5\n"
          "[media.fog]\ntype = 'homogeneous'\nsigma_s = 1\nsigma_a = 0\n"
          "[volume]\ngather = 'nearest'\nradius = 0.1\ncount = 40\nkernel = 'biweight'\nform = "
          "'density-at-photon'\ndirect = 'shadow-rays'\n"
          "[surface]\ngather = 'nearest'\nradius = 0.3\ncount = 60\nkernel = 'constant'\ndirect = 'photons'\n"
          "indirect = 'final-gather'\ngather_rays = 5\ngather_by = 'photons'\nirradiance = 'precomputed'\n"
          "[caustics]\nradius = 0.01\nemitted = 800\n")
          .settings;
  EXPECT_EQ(s.integrator, Integrator::photon);
  EXPECT_EQ(s.until.passes, 3);
  EXPECT_EQ(s.until.seconds, 1.5);
  EXPECT_EQ(s.seed, 9u);
  EXPECT_EQ(s.samples_per_pixel, 2);
  EXPECT_EQ(s.max_events, 77);
  EXPECT_EQ(s.radii, RadiusSchedule::constant);
  EXPECT_EQ(s.max_optical_step, 0.25f);
  EXPECT_EQ(s.photons_emitted, 1000u);
  EXPECT_EQ(s.photons_stored, 500u);
  EXPECT_EQ(s.photons_in_cube, 4u);
  EXPECT_EQ(s.guide.importons, 70u);
  EXPECT_FALSE(s.guide.aim);
  EXPECT_FALSE(s.guide.split);
  EXPECT_TRUE(s.guide.scatter);
  EXPECT_EQ(s.caustics.radius.metres(), 0.01f);
  EXPECT_EQ(s.caustics_emitted, 800u);
  EXPECT_EQ(s.distance.strategy, "ray-march");
  EXPECT_EQ(s.distance.step, 0.5f);
  EXPECT_EQ(s.distance.optical_step, 0.02f);
  EXPECT_EQ(s.distance.extinction_floor, 0.2f);
  EXPECT_EQ(s.distance.majorant, 0.125f);
  EXPECT_EQ(s.transmittance.estimator, "ray-march");
  EXPECT_EQ(s.transmittance.step, 0.75f);
  EXPECT_EQ(s.transmittance.samples, 2.5f);
  EXPECT_EQ(s.volume.mode, GatherMode::nearest);
  EXPECT_EQ(s.volume.radius.metres(), 0.1f);
  EXPECT_EQ(s.volume.count, 40u);
  EXPECT_EQ(s.volume.kernel, KernelKind::biweight);
  EXPECT_EQ(s.volume_form, VolumeForm::density_at_photon);
  EXPECT_EQ(s.volume_direct, DirectLight::shadow_rays);
  EXPECT_EQ(s.surface.mode, GatherMode::nearest);
  EXPECT_EQ(s.surface.radius.metres(), 0.3f);
  EXPECT_EQ(s.surface.count, 60u);
  EXPECT_EQ(s.surface.kernel, KernelKind::constant);
  EXPECT_EQ(s.surface_direct, DirectLight::photons);
  EXPECT_EQ(s.surface_indirect, IndirectLight::final_gather);
  EXPECT_EQ(s.gather_rays, 5);
  EXPECT_EQ(s.gather_by, GatherBy::photons);
  EXPECT_EQ(s.end_irradiance, EndIrradiance::precomputed);
}

TEST(SceneFile, CorrectsAtBordersWhereAsked) {
  const RenderSettings volume = load_with("[volume]\nboundary = 'corrected'\n").settings;
  EXPECT_EQ(volume.volume.boundary, BoundaryRule::corrected);
  EXPECT_EQ(volume.surface.boundary, BoundaryRule::none);
  EXPECT_EQ(volume.caustics.boundary, BoundaryRule::none);
  const RenderSettings surface = load_with("[surface]\nboundary = 'corrected'\n").settings;
  EXPECT_EQ(surface.volume.boundary, BoundaryRule::ends);  // the default
  EXPECT_EQ(surface.surface.boundary, BoundaryRule::corrected);
  EXPECT_EQ(surface.caustics.boundary, BoundaryRule::corrected);  // goes with the surface's
  const RenderSettings plain = load_with("[volume]\nboundary = 'none'\n[surface]\nboundary = 'none'\n").settings;
  EXPECT_EQ(plain.volume.boundary, BoundaryRule::none);
  EXPECT_EQ(plain.surface.boundary, BoundaryRule::none);
}

TEST(SceneFile, SingleScatteringMayBeEquiangular) {
  const RenderSettings usual = load_with("[volume]\ndirect = 'equiangular'\n").settings;
  EXPECT_EQ(usual.volume_direct, DirectLight::equiangular);
  EXPECT_EQ(usual.direct_samples, RenderSettings{}.direct_samples);
  EXPECT_EQ(load_with("[volume]\ndirect = 'equiangular'\ndirect_samples = 7\n").settings.direct_samples, 7);
}

TEST(SceneFile, AMethodChoosesDirectAndIndirectLight) {
  const auto with = [](const std::string& method) {
    return load_with("[surface]\nmethod = '" + method + "'\n").settings;
  };
  EXPECT_EQ(with("visualise").surface_direct, DirectLight::photons);
  EXPECT_EQ(with("visualise").surface_indirect, IndirectLight::photons);
  EXPECT_EQ(with("progressive").surface_direct, DirectLight::shadow_rays);
  EXPECT_EQ(with("progressive").surface_indirect, IndirectLight::photons);
  EXPECT_EQ(with("final-gather").surface_direct, DirectLight::shadow_rays);
  EXPECT_EQ(with("final-gather").surface_indirect, IndirectLight::final_gather);
}

TEST(SceneFile, RadiiAreOfAllPassesOrShrinkByPassOrByPixel) {
  const auto with = [](const std::string& radii) { return load_with("[render]\nradii = '" + radii + "'\n").settings; };
  EXPECT_EQ(load_with("").settings.radii, RadiusSchedule::per_pass);
  EXPECT_EQ(with("constant").radii, RadiusSchedule::constant);
  EXPECT_EQ(with("per-pass").radii, RadiusSchedule::per_pass);
  EXPECT_EQ(with("per-pixel").radii, RadiusSchedule::per_pixel);
}

TEST(SceneFile, DefaultsAreThoseOfTheSettings) {
  const RenderSettings s = load_with("[render]\n[photons]\n[distance]\n[transmittance]\n[volume]\n[surface]\n")
                               .settings,
                       d;
  EXPECT_EQ(s.until.passes, d.until.passes);
  EXPECT_EQ(s.seed, d.seed);
  EXPECT_EQ(s.max_events, d.max_events);
  EXPECT_EQ(s.photons_emitted, d.photons_emitted);
  EXPECT_EQ(s.photons_stored, d.photons_stored);
  EXPECT_EQ(s.transmittance.estimator, d.transmittance.estimator);
  EXPECT_EQ(s.transmittance.samples, d.transmittance.samples);
  EXPECT_EQ(s.volume.count, d.volume.count);
  EXPECT_EQ(s.volume.kernel, d.volume.kernel);
  EXPECT_EQ(s.surface_direct, d.surface_direct);
  EXPECT_EQ(s.gather_by, d.gather_by);
  EXPECT_EQ(s.end_irradiance, d.end_irradiance);
  EXPECT_EQ(load_with("[photons]\nstored = 10\n").settings.photons_emitted, 0u);  // until the maps are full
}

TEST(SceneFile, PhotonsFlyByNullCollisionsWhereNothingIsSaid) {
  EXPECT_EQ(load_with("").settings.distance.strategy, "delta-local");
  EXPECT_EQ(load_with("[distance]\nstep = 2\n[render]\nintegrator = \"photon\"\n").settings.distance.strategy,
            "delta-local");
  for (const char* integrator : {"path", "combined"})
    EXPECT_EQ(load_with(fmt::format("[render]\nintegrator = \"{}\"\n", integrator)).settings.distance.strategy,
              "regular");
  EXPECT_EQ(load_with("[distance]\nstrategy = \"delta\"\n").settings.distance.strategy, "delta");
  // Where the integrator is chosen so is the strategy, unless it is given.
  EXPECT_TRUE(load_with("[render]\nintegrator = \"auto\"\n").automatic.has("distance.strategy"));
  EXPECT_FALSE(load_with("[render]\nintegrator = \"auto\"\n[distance]\nstrategy = \"delta\"\n")
                   .automatic.has("distance.strategy"));
}

using Keys = AutomaticSettings::Keys;

TEST(SceneFile, AutoIsReadWhereItIsWritten) {
  const RenderJob loaded = load_with("[volume]\nradius = 'auto'\n[photons]\nemitted = 'auto'\n[surface]\nradius = 2\n");
  EXPECT_EQ(loaded.automatic.keys, (Keys{"photons.emitted", "volume.radius"}));
  EXPECT_FALSE(loaded.settings.volume.radius.is_given());
  EXPECT_EQ(loaded.settings.photons_emitted, RenderSettings{}.photons_emitted);
  EXPECT_EQ(load_with("", {"distance.strategy=auto", "caustics.radius=auto", "volume.gather=auto"}).automatic.keys,
            (Keys{"caustics.radius", "distance.strategy", "volume.gather"}));
  EXPECT_TRUE(load_with("").automatic.keys.empty());
}

TEST(SceneFile, RadiiThatAreLeftOutAreKnown) {
  EXPECT_EQ(load_with("").automatic.left_out, (Keys{"caustics.radius", "surface.radius", "volume.radius"}));
  const RenderJob loaded = load_with("[volume]\nradius = 'auto'\n[surface]\nradius = 2\n");
  EXPECT_EQ(loaded.automatic.left_out, Keys{"caustics.radius"});
}

TEST(SceneFile, WhatIsLeftOutMayBeAutomatic) {
  const std::string path = write_scene(kCamera + kLight + "[surface]\nradius = 2\n[photons]\nstored = 70\n");
  const RenderJob loaded = load_scene(path, {"distance.strategy=delta"}, LeftOut::automatic);
  EXPECT_EQ(loaded.automatic.keys, (Keys{"caustics.radius", "render.integrator", "volume.radius"}));
  EXPECT_EQ(loaded.settings.surface.radius.metres(), 2.0f);
  EXPECT_EQ(loaded.settings.distance.strategy, "delta");
  EXPECT_TRUE(load_scene(path, {"volume.gather=auto"}, LeftOut::automatic).automatic.has("volume.gather"));
  EXPECT_TRUE(load_scene(path, {"photons.stored=9"}, LeftOut::automatic).automatic.has("distance.strategy"));
  EXPECT_TRUE(load_scene(write_scene(kCamera + kLight), {}, LeftOut::automatic).automatic.has("photons.emitted"));
  EXPECT_NE(load_scene(path, {}, LeftOut::automatic).hash, load_scene(path).hash);
}

TEST(SceneFile, TechniquesThatAreLeftOutAreAutomaticBesideTheirIntegrator) {
  const std::string path = write_scene(kCamera + kLight);
  const auto chooses_techniques = [&](const std::string& integrator) {
    return load_scene(path, {"render.integrator=" + integrator}, LeftOut::automatic)
        .automatic.has("combined.techniques");
  };
  EXPECT_TRUE(chooses_techniques("combined"));
  EXPECT_FALSE(chooses_techniques("photon"));
}

}  // namespace
}  // namespace vpm
