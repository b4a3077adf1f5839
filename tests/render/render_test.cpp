// Jobs made in code, and the loop over passes: when it ends, and what it leaves.
#include "vpm/render/render.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/simulated_clock.h"
#include "vpm/base/cancel.h"
#include "vpm/base/progress.h"
#include "vpm/image/exr.h"
#include "vpm/integrators/render_scene.h"
#include "vpm/job/identity.h"
#include "vpm/job/messages.h"
#include "vpm/job/picture.h"
#include "vpm/job/render_job.h"
#include "vpm/job/report.h"
#include "vpm/surface/procedural_mesh.h"

namespace vpm {
namespace {

/// A light over a floor, seen from above, by photons within 0.5 m in every pass.
RenderJob lit_floor() {
  SceneParts parts;
  parts.materials = {{Lambertian{Rgb(0.6f, 0.5f, 0.4f)}}};
  parts.shapes = {{.name = "floor", .surface = quad_mesh(Vec3(-3, 0, 3), Vec3(6, 0, 0), Vec3(0, 0, -6))}};
  parts.lights = {{"lamp", PointLight{Vec3(0.2f, 1.5f, 0.1f), Rgb(10.0f, 5.0f, 2.0f)}}};
  parts.camera = make_camera(Vec3(1.5f, 1.2f, 1.5f), Vec3(0.2f, 0.0f, 0.2f), Vec3(0, 1, 0), 30.0f, {12, 12});
  RenderSettings settings;
  settings.photons.emitted = 2000;
  settings.surface.radius = 0.5f;
  settings.radii = RadiusSchedule::constant;
  settings.direct.type = DirectLight::photons;
  return make_job(assemble(std::move(parts)), settings);
}

RenderResult render_until(const RenderJob& job, const StopRule& until) {
  RenderSettings settings = job.settings;
  settings.until = until;
  return render(job.scene, settings, nothing_rendered(job.scene.camera));
}

TEST(Render, StopsByCountAndWhereItIsGivenUp) {
  const RenderJob job = lit_floor();
  const RenderResult counted = render_until(job, {.passes = 3});
  EXPECT_EQ(counted.film.passes(), 3);
  ASSERT_TRUE(counted.errors);
  for (const Rgb& v : counted.errors->variance.pixels) EXPECT_GT(v.g, 0.0f);  // passes have random numbers of their own
  const std::atomic<bool> stop{true};
  const CancelScope scope(stop);
  const RenderResult stopped = render_until(job, {.passes = 3});
  EXPECT_EQ(stopped.film.passes(), 0);
  EXPECT_FALSE(stopped.errors);
}

TEST(Render, ACropTellsAJobFromAnother) {
  const RenderJob whole = lit_floor();
  RenderJob part = lit_floor();
  EXPECT_EQ(identity_of(part), identity_of(whole));
  part.scene.camera.crop = PixelRect{2, 3, 7, 9};
  EXPECT_NE(identity_of(part), identity_of(whole));
  const RenderResult result = render(part.scene, part.settings, nothing_rendered(part.scene.camera));
  EXPECT_EQ(result.film.width(), 5);
  EXPECT_EQ(result.film.height(), 6);
}

TEST(Render, TellsThatAnErrorIsNotReached) {
  RenderJob job = lit_floor();
  job.settings.until = {.seconds = 0.1, .error = 1e-12};
  const auto clock = std::make_shared<SimulatedClock>();
  const auto finished = [&](const RenderResult&) { clock->work(0.03); };
  const std::vector<std::string> warnings = warnings_of(
      job, render(job.scene, job.settings, nothing_rendered(job.scene.camera), {.finished = finished, .clock = clock}));
  ASSERT_FALSE(warnings.empty());
  EXPECT_NE(warnings.back().find("below 1e-12 is not reached after "), std::string::npos) << warnings.back();
}

/// By a kernel with a negative rim and few photons, some pixels see the rim alone.
TEST(Render, TellsOfNegativePixels) {
  RenderJob job = lit_floor();
  const auto told = [&] {
    std::string all;
    for (const std::string& warning : warnings_of(job, render_until(job, {.passes = 1}))) all += warning;
    return all.find("pixels are negative in a channel") != std::string::npos;
  };
  job.settings.surface.radius = 0.03f;
  EXPECT_FALSE(told());
  job.settings.surface.kernel = KernelKind::order_4;
  EXPECT_TRUE(told());
}

TEST(Render, StopsOnceTheEstimatedErrorIsReached) {
  const RenderJob job = lit_floor();
  const double asked = highest_error(render_until(job, {.passes = 20}));
  const RenderResult result = render_until(job, {.error = asked});
  EXPECT_LE(highest_error(result), asked);
  EXPECT_LE(result.film.passes(), 20);
  EXPECT_GE(result.film.passes(), kLeastPasses);
}

TEST(Render, ReadsErrorsOnceTheyTellEnough) {
  const RenderJob job = lit_floor();
  RenderSettings settings = job.settings;
  settings.until = {.error = highest_error(render_until(job, {.passes = kLeastPasses + 2}))};
  const auto finished = [&](const RenderResult& so_far) {
    EXPECT_EQ(so_far.errors.has_value(), so_far.film.passes() >= kLeastPasses) << so_far.film.passes();
  };
  render(job.scene, settings, nothing_rendered(job.scene.camera), {ProgressMode::never, finished});
}

TEST(Render, GoesOnToTheSameBits) {
  const RenderJob job = lit_floor();
  RenderSettings settings = job.settings;
  settings.until.passes = 5;
  const RenderResult whole = render(job.scene, settings, nothing_rendered(job.scene.camera));
  const RenderResult resumed = render(job.scene, settings, render_until(job, {.passes = 2}));
  EXPECT_EQ(resumed.film.sums(), whole.film.sums());
  EXPECT_EQ(resumed.statistics.passes, 5);
}

TEST(Render, CorrectsEstimatesAtBorders) {
  RenderJob job = lit_floor();
  job.settings.surface.boundary = BoundaryRule::corrected;
  job.settings.surface.radius = 4.0f;  // beyond the floor's edges from all of its points
  const GatherCounters gather = render_until(job, {.passes = 1}).statistics.eye.gather;
  EXPECT_GT(gather.corrected, 0u);
  EXPECT_EQ(gather.least_shares, 0u);
}

/// Two passes, and two more: the picture's layers are parts of it, with variances.
TEST(Render, KeepsLayersFromPassToPass) {
  RenderJob job = lit_floor();
  job.settings.integrator = Integrator::combined;
  job.settings.photons.emitted = 500;
  job.settings.combined.layers = true;
  RenderResult result = render_until(job, {.passes = 2});
  job.settings.until = {.passes = 4};
  result = render(job.scene, job.settings, std::move(result));
  const std::string path = ::testing::TempDir() + "/layers.exr";
  write_picture(path, job, result);
  const ExrChannels picture = read_exr_channels(path);
  const std::vector<float>& whole = picture.planes.at("G");
  std::vector<float> sum(whole.size(), 0.0f);
  for (const TechniqueInfo& info : kTechniques) {
    const std::string name = "combined." + std::string(info.name);
    const std::vector<float>& part = picture.planes.at(name + ".weighted.G");
    for (size_t i = 0; i < sum.size(); ++i) sum[i] += part[i];
    EXPECT_TRUE(picture.planes.contains(name + ".weighted.variance.G"));
    EXPECT_TRUE(picture.planes.contains(name + ".unweighted.G"));
  }
  for (size_t i = 0; i < sum.size(); ++i) EXPECT_NEAR(sum[i], whole[i], 1e-5f * (1.0f + whole[i]));
  const auto report = nlohmann::json::parse(render_report(job, path, result));
  double shares = 0.0;
  for (const auto& technique : report.at("techniques")) {
    shares += technique.at("share_of_light").get<double>();
    EXPECT_GE(technique.at("found_alone"), technique.at("share_of_light")) << technique.at("name");
    EXPECT_EQ(technique.at("variance") > 0.0, technique.at("share_of_light") > 0.0) << technique.at("name");
  }
  EXPECT_NEAR(shares, 1.0, 1e-12);
  job.settings.combined.layers = false;
  job.settings.until = {.passes = 5};
  EXPECT_THROW(render(job.scene, job.settings, std::move(result)), InputError);
}

TEST(RenderJob, OfCodeBecomesPictureReportAndMessages) {
  const RenderJob job = lit_floor();
  const RenderResult result = render_until(job, {.passes = kLeastPasses});
  const std::string path = ::testing::TempDir() + "/lit_floor.exr";
  write_picture(path, job, result);
  const ExrChannels picture = read_exr_channels(path);
  EXPECT_TRUE(picture.planes.contains("R"));
  EXPECT_TRUE(picture.planes.contains("variance.G"));
  EXPECT_TRUE(picture.planes.contains("bias.G"));
  EXPECT_EQ(picture.metadata.at("vpm.passes"), std::to_string(kLeastPasses));
  EXPECT_NE(render_report(job, path, result).find("\"lamp\""), std::string::npos);
  EXPECT_TRUE(nlohmann::json::parse(render_report(job, path, result)).at("techniques").is_null());
  double most = 0.0;
  ASSERT_EQ(std::sscanf(error_text(job, result).c_str(), "relative MSE at most %lf (expected about ", &most), 1);
  EXPECT_GE(most, stated_error_of(result)->highest * (1.0 - 1e-9));
  EXPECT_LE(most, stated_error_of(result)->highest * 1.1);
  EXPECT_TRUE(warnings_of(job, result).empty());
}

TEST(RenderJob, TellsWhereTheEnergyOfPhotonsWent) {
  RenderJob job = lit_floor();
  const auto energy = [&] {
    return nlohmann::json::parse(render_report(job, "a.exr", render_until(job, {.passes = 1}))).at("energy");
  };
  const nlohmann::json of_photons = energy();
  for (size_t c = 0; c < 3; ++c) {
    const auto flow = [&](const char* name) { return of_photons.at(name).at(c).get<double>(); };
    EXPECT_NEAR(of_photons.at("imbalance").at("value").at(c).get<double>(),
                (flow("absorbed_on_surfaces") + flow("escaped") - flow("emitted")) / flow("emitted"), 1e-9);
    EXPECT_GT(of_photons.at("imbalance").at("standard_error").at(c).get<double>(), 0.0);
  }
  job.settings.integrator = Integrator::path;
  EXPECT_TRUE(energy().is_null());
}

TEST(RenderJob, TellsItsErrorsAfterEachPass) {
  const RenderJob job = lit_floor();
  RenderSettings settings = job.settings;
  settings.until.passes = kLeastPasses + 1;
  const std::string path = ::testing::TempDir() + "/after_each_pass.exr";
  int told = 0;
  const auto finished = [&](const RenderResult& so_far) {
    ++told;
    EXPECT_EQ(so_far.film.passes(), told);
    EXPECT_EQ(error_text(job, so_far).empty(), told < kLeastPasses);
    write_picture(path, job, so_far);
    EXPECT_EQ(read_exr_channels(path).planes.contains("variance.R"), told > 1);
    EXPECT_FALSE(render_report(job, path, so_far).empty());
  };
  render(job.scene, settings, nothing_rendered(job.scene.camera), {ProgressMode::never, finished});
  EXPECT_EQ(told, kLeastPasses + 1);
}

TEST(Render, DropsThePassUnderWayWhenItIsStopped) {
  const RenderJob job = lit_floor();
  std::atomic<bool> stop{false};
  const auto make = [&](int, const RenderResult& so_far, const PassProgress&) {
    stop = so_far.film.passes() == 2;
    cancellation_point();
    return Pass(12, 12);
  };
  const CancelScope scope(stop);
  const RenderResult result = run_passes({.passes = 5}, {make, 1}, nothing_rendered(job.scene.camera), {});
  EXPECT_EQ(result.film.passes(), 2);
}

// It is finished, and the picture that it joins is whole.
TEST(Render, KeepsThePassAtWhoseEndItIsStopped) {
  const RenderJob job = lit_floor();
  std::atomic<bool> stop{false};
  const auto make = [&](int, const RenderResult& so_far, const PassProgress&) {
    stop = so_far.film.passes() == 2;
    return Pass(12, 12);
  };
  const CancelScope scope(stop);
  const RenderResult result = run_passes({.passes = 5}, {make, 1}, nothing_rendered(job.scene.camera), {});
  EXPECT_EQ(result.film.passes(), 3);
}

TEST(Render, MakesThePassesOfAPieceByTheirNumbers) {
  std::vector<int> made;
  const auto make = [&](int number, const RenderResult&, const PassProgress&) {
    made.push_back(number);
    return Pass(12, 12);
  };
  const StopRule piece{.passes = 3, .first = 5};
  const RenderJob job = lit_floor();
  RenderResult begun = nothing_rendered(job.scene.camera);
  begun.film.add(5, Image(12, 12));
  const RenderResult result = run_passes(piece, {make, 1}, std::move(begun), {});
  EXPECT_EQ(made, (std::vector<int>{6, 7}));
  EXPECT_EQ(result.film.sums().passes.ranges(), (std::vector<PassRange>{{5, 8}}));
}

TEST(Render, RefusesToGoOnWithAPictureOfAnotherSize) {
  const RenderJob job = lit_floor();
  EXPECT_THROW(render(job.scene, job.settings, {Film(12, 11), {}, 0.0, {}}), InputError);
}

TEST(RenderJob, ChoosesAgainWhatWasChosen) {
  RenderJob job = lit_floor(), again = lit_floor();
  for (RenderJob* each : {&job, &again}) each->automatic.keys = {"integrator.surface.radius"};
  choose(job);
  ASSERT_EQ(job.choices.size(), 1u);
  EXPECT_NE(job.settings.surface.radius, lit_floor().settings.surface.radius);
  choose_again(again, job.choices);
  EXPECT_EQ(again.settings.surface.radius, job.settings.surface.radius);
  ASSERT_EQ(again.choices.size(), 1u);
  EXPECT_EQ(again.choices[0].value, job.choices[0].value);
  EXPECT_THROW(choose_again(again, {{"integrator.surface.kernel", "cone", ""}}), InputError);  // it is never chosen
}

TEST(RenderJob, ChoosingByTheTimeThatIsLeftLeavesTheTimeThatIsAskedFor) {
  RenderJob job = lit_floor();
  job.automatic.keys = {"integrator.surface.radius"};
  job.settings.until = {.seconds = 100.0};
  const SimulatedClock clock;
  clock.work(60.0);
  choose(job, clock);
  EXPECT_EQ(job.choices.size(), 1u);
  EXPECT_EQ(job.settings.until.seconds, 100.0);
}

TEST(RenderJob, DefaultRadiiGoByPhotonsAndNotByTime) {
  const auto radius_of = [](double seconds, GatherMode mode) {
    RenderJob job = lit_floor();
    job.automatic.default_radii = {"integrator.surface.radius"};
    job.settings.surface.radius = {};
    job.settings.surface.mode = mode;
    if (seconds > 0.0) job.settings.until = {.seconds = seconds};
    choose(job, SimulatedClock());
    EXPECT_EQ(job.choices.size(), mode == GatherMode::nearest ? 0u : 1u);
    return job.settings.surface.radius.metres();
  };
  const float radius = radius_of(0.0, GatherMode::radius);
  EXPECT_GT(radius, 0.0f);
  EXPECT_EQ(radius_of(0.1, GatherMode::radius), radius);
  EXPECT_EQ(radius_of(0.0, GatherMode::nearest), 0.0f);  // the largest radius keeps its default
}

/// A default radius belongs to the first pass, which may take twice the time: what is over then is the render.
TEST(RenderJob, EndsWhereTheTimeDoesNotAllowADefaultRadius) {
  RenderJob job = lit_floor();
  job.automatic.default_radii = {"integrator.surface.radius"};
  job.settings.surface.radius = {};
  job.settings.until = {.seconds = 2.0};
  const HastyClock clock;
  EXPECT_THROW(choose(job, clock), NoPassFits);
  EXPECT_EQ(clock.seconds(), 4.0);
  EXPECT_FALSE(job.settings.surface.radius.is_given());
  choose_default_radii(job);
  EXPECT_TRUE(job.settings.surface.radius.is_given()) << "it depends on no time";
}

TEST(RenderJob, OfScenesMadeInCodeRadiiAreChosenThatNobodyGives) {
  const AutomaticSettings::Keys others{"integrator.caustics.radius", "integrator.volume.radius"};
  EXPECT_EQ(lit_floor().automatic.default_radii, others);
  RenderJob job = make_job({lit_floor().scene, {}, {}});
  EXPECT_TRUE(job.automatic.default_radii.contains("integrator.surface.radius"));
  job.settings = lit_floor().settings;  // a radius that is given later stays
  choose(job);
  EXPECT_EQ(job.automatic.default_radii, others);
  EXPECT_EQ(job.settings.surface.radius, lit_floor().settings.surface.radius);
}

TEST(RenderJob, ChoosesNothingForSettingsThatContradictThemselves) {
  RenderJob job = lit_floor();
  job.automatic.keys = {"integrator.surface.radius"};
  job.settings.photons.emitted = 0;
  EXPECT_THROW(choose(job), SettingError);
}

}  // namespace
}  // namespace vpm
