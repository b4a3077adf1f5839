// What is said before a first pass: that it takes longer than the time asked for, and that its photons do not fit.
#include "vpm/job/forecast.h"

#include <gtest/gtest.h>

#include "support/scenes.h"
#include "support/simulated_clock.h"
#include "vpm/base/error.h"
#include "vpm/integrators/photon_map/photon_pass.h"
#include "vpm/job/render_job.h"
#include "vpm/render/render.h"

namespace vpm {
namespace {

RenderSettings within(double seconds, uint64_t photons) {
  RenderSettings settings;
  settings.until.seconds = seconds;
  settings.photons.emitted = photons;
  return settings;
}

/// Fog around a point light, each of whose photons is stored about twice at the usual extinction (1/m).
RenderJob fog(float sigma_t = 100.0f) {
  AssembledScene parts;
  Scene& scene = parts.scene;
  scene.media.push_back(make_medium(nullptr, Rgb(sigma_t), 0.5f));
  const Interface media{0, kVacuum};
  add_shape(scene, box_mesh(Vec3d(-1.0), Vec3d(1.0)), Boundary{}, &media);
  scene.lights.push_back(PointLight{Vec3(0.0f), Rgb(1.0f)});
  scene.camera = make_camera(Vec3(0.0f, 0.0f, 4.0f), Vec3(0.0f), Vec3(0.0f, 1.0f, 0.0f), 40.0f, {8, 8});
  scene.geometry.commit();
  finish(scene);
  return make_job(std::move(parts));
}

TEST(Forecast, TellsHowManyPhotonsFit) {
  const RenderSettings settings;
  const ForeseenPass pass{.seconds = 21.0, .of_rays = 1.0, .photons = 2e6};
  EXPECT_EQ(photons_that_fit(pass, settings, 5.0), "about 400000 integrator.photons.emitted");  // 4 s of 20
  EXPECT_EQ(photons_that_fit(pass, settings, 1.0), "");
  EXPECT_EQ(photons_that_fit({.seconds = 18.0, .of_rays = 9.0, .photons = 1e5}, settings, 5.0), "");
}

/// Fog of which a radius of a metre takes in nearly all photons.
TEST(Forecast, TellsARadiusThatFits) {
  Scene scene = fog(1.0f).scene;
  scene.camera.width = scene.camera.height = 256;  // so that rays take most of the time
  RenderSettings settings = within(1.0, 20'000);
  settings.volume.radius = 1.0f;
  const double seconds = 0.3 * foresee_pass(scene, settings, 1.0).seconds;
  const std::string text = radius_that_fits(scene, settings, seconds, 6.0);
  const std::string key = "integrator.volume.radius = ";
  ASSERT_TRUE(text.starts_with(key)) << text;
  settings.volume.radius = std::stof(text.substr(key.size()));
  EXPECT_LT(settings.volume.radius.metres(), 1.0f);
  settings.volume.choose("nearest");
  EXPECT_EQ(radius_that_fits(scene, settings, seconds, 6.0), "");
  settings.integrator = Integrator::path;
  EXPECT_EQ(radius_that_fits(scene, settings, seconds, 6.0), "");
}

TEST(Forecast, RefusesPhotonsThatDoNotFitIntoMemory) {
  const RenderJob job = fog();
  RenderSettings settings;
  settings.photons.emitted = 100'000'000;  // 2e8 stored, 12.8 GB
  EXPECT_NO_THROW(check_memory(job.scene, settings, PassOf::picture, 15e9));
  EXPECT_NO_THROW(check_memory(job.scene, settings, PassOf::light_map, 8e9));  // which shows no medium
  try {
    check_memory(job.scene, settings, PassOf::picture, 8e9);
    ADD_FAILURE() << "it fits";
  } catch (const InputError& error) {
    const std::string text = error.what();
    for (const char* part : {"integrator.photons.emitted", "2e+08 photons", "13 GB", "8 GB",
                             "000 integrator.photons.emitted would fit", "integrator.photons.block gathers as many"})
      EXPECT_NE(text.find(part), std::string::npos) << text;
  }
  settings.photons.stored = 50'000'000;  // tracing stops there
  EXPECT_NO_THROW(check_memory(job.scene, settings, PassOf::picture, 8e9));
  settings.photons.stored = 0;
  settings.photons.emitted = 10'000'000;  // 2e7 stored, 1.3 GB; with flights, of which there are more, at least 12 GB
  EXPECT_NO_THROW(check_memory(job.scene, settings, PassOf::picture, 8e9));
  settings.volume.choose("photon-beams");
  EXPECT_THROW(check_memory(job.scene, settings, PassOf::picture, 8e9), InputError);
  EXPECT_NO_THROW(check_memory(job.scene, settings, PassOf::light_map, 8e9));
  settings.volume.flights = 1000;
  EXPECT_NO_THROW(check_memory(job.scene, settings, PassOf::picture, 8e9));
  settings.integrator = Integrator::path;
  EXPECT_NO_THROW(check_memory(job.scene, settings, PassOf::picture, 1e6));
}

// Of 1e9 photons, memory holds a block at a time.
TEST(Forecast, CountsTheBlockOfPhotonsThatMemoryHolds) {
  const RenderJob job = fog();
  RenderSettings settings;
  settings.photons.emitted = 1'000'000'000;
  EXPECT_THROW(check_memory(job.scene, settings, PassOf::picture, 8e9), InputError);
  settings.photons.block = 50'000'000;  // 1e8 stored, 6.4 GB
  EXPECT_NO_THROW(check_memory(job.scene, settings, PassOf::picture, 8e9));
  try {
    check_memory(job.scene, settings, PassOf::picture, 4e9);
    ADD_FAILURE() << "it fits";
  } catch (const InputError& error) {
    const std::string text = error.what();
    for (const char* part : {"integrator.photons.block: the maps of a block", "1e+08 photons", "4 GB",
                             "000000 integrator.photons.block would"})
      EXPECT_NE(text.find(part), std::string::npos) << text;
  }
}

TEST(Forecast, LooksAheadOnlyWhereATimeIsAskedFor) {
  RenderJob job = fog();
  foresee(job);
  EXPECT_TRUE(job.notes.empty());
  job.settings = within(0.5, 50'000'000);
  foresee(job);
  ASSERT_EQ(job.notes.size(), 1u);
  EXPECT_EQ(job.notes[0].substr(0, 14), "one pass takes") << job.notes[0];
  EXPECT_GT(job.foreseen_pass, 0.5);
}

/// A glass ball over a floor, whose caustic has photons of its own.
RenderJob glass_over_floor(uint64_t photons, uint64_t aimed) {
  AssembledScene parts;
  Scene& scene = parts.scene;
  add_shape(scene, quad_mesh(Vec3d(-3.0, -1.5, 3.0), Vec3d(6.0, 0.0, 0.0), Vec3d(0.0, 0.0, -6.0)),
            Lambertian{Rgb(0.5f)});
  add_shape(scene, SphereShape{Vec3(0.0f), 0.5f}, Dielectric{1.5f});
  scene.lights.push_back(PointLight{Vec3(0.0f, 3.0f, 0.0f), Rgb(1.0f)});
  scene.camera = make_camera(Vec3(0.0f, 0.5f, 5.0f), Vec3(0.0f, -1.0f, 0.0f), Vec3(0.0f, 1.0f, 0.0f), 40.0f, {8, 8});
  scene.geometry.commit();
  finish(scene);
  RenderJob job = make_job(std::move(parts));
  job.settings.photons.emitted = photons;
  job.settings.indirect.type = IndirectLight::final_gather;
  job.settings.caustics.emitted = aimed;
  return job;
}

TEST(Forecast, SeesCausticPhotonsThatTakeTooLong) {
  RenderJob job = glass_over_floor(1000, 100'000'000);
  // The eye's rays take far less, also where others work beside: they are few, and find few photons.
  job.settings.until.seconds = 0.5;
  job.settings.indirect.rays = 1;
  job.settings.caustics.radius = 1e-3f;
  foresee(job);
  ASSERT_EQ(job.notes.size(), 1u);
  EXPECT_EQ(job.notes[0].substr(0, 14), "one pass takes");
  EXPECT_NE(job.notes[0].find("integrator.caustics.emitted would fit"), std::string::npos) << job.notes[0];
}

/// From a part of either kind, of which the caustic ones are many more.
TEST(Forecast, CountsThePhotonsOfEitherKindThatAPassStores) {
  const RenderJob job = glass_over_floor(20'000, 400'000);
  const RenderStatistics s = render_photon_pass(job.scene, job.settings, 0).statistics;
  EXPECT_GT(s.aimed_photons, s.surface_photons);
  const double stored = static_cast<double>(s.surface_photons + s.caustic_photons);
  EXPECT_NEAR(bytes_of_maps(job.scene, job.settings, PassOf::picture), kMapBytes * stored, 0.1 * kMapBytes * stored);
}

TEST(Forecast, RefusesCausticPhotonsThatDoNotFitIntoMemory) {
  RenderJob job = glass_over_floor(1000, 100'000'000);  // of which seven in ten are stored: 4.6 GB
  EXPECT_NO_THROW(check_memory(job.scene, job.settings, PassOf::picture, 8e9));
  EXPECT_THROW(check_memory(job.scene, job.settings, PassOf::light_map, 3e9), InputError);
  try {
    check_memory(job.scene, job.settings, PassOf::picture, 3e9);
    ADD_FAILURE() << "it fits";
  } catch (const InputError& error) {
    const std::string text = error.what();
    for (const char* part : {"integrator.caustics.emitted: ", "3 GB", "0000 integrator.caustics.emitted would fit"})
      EXPECT_NE(text.find(part), std::string::npos) << text;
  }
}

/// In a ball as large as the fog, all that are stored.
TEST(Forecast, TellsWhereARayGathersVeryMany) {
  RenderJob job = fog();
  job.settings.volume.radius = 1.0f;
  job.settings.photons.emitted = 10'000;
  EXPECT_EQ(wide_gather_text(job.scene, job.settings), "");
  job.settings.photons.emitted = 1'000'000;
  const std::string text = wide_gather_text(job.scene, job.settings);
  EXPECT_EQ(text.substr(0, 30), "a ray from the eye gathers abo") << text;
  foresee(job);
  EXPECT_EQ(job.notes, (std::vector{text}));
  job.settings.volume.radius = 1e-3f;
  EXPECT_EQ(wide_gather_text(job.scene, job.settings), "");
}

TEST(Forecast, SaysWhatItsLooksHadNoTimeFor) {
  RenderJob job = fog();
  job.settings = within(2.0, 1'000'000);
  foresee(job, HastyClock());
  ASSERT_EQ(job.notes.size(), 2u);
  EXPECT_EQ(job.notes[0], "a look of 0.2 s is too short to count the photons that a ray gathers");
  EXPECT_EQ(job.notes[1], "a look of 0.4 s is too short to time a pass");
  EXPECT_EQ(job.foreseen_pass, 0.0);
}

}  // namespace
}  // namespace vpm
