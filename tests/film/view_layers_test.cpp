// Layers of what the camera sees, from samples to films to pictures.
#include "vpm/film/view_layers.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/scenes.h"
#include "vpm/integrators/combined/combined_pass.h"
#include "vpm/integrators/path/path_tracer.h"
#include "vpm/integrators/photon_map/photon_pass.h"
#include "vpm/integrators/render_scene.h"
#include "vpm/study/estimates/glowing.h"

namespace vpm {
namespace {

constexpr int kSize = 24;
const Rgb kFloor(0.25f, 0.5f, 0.75f);

ViewLayerSet all_layers() {
  ViewLayerSet all;
  for (const ViewLayerInfo& info : kViewLayers) all.set(info.layer, true);
  return all;
}

RenderSettings few_photons(Integrator integrator, const ViewLayerSet& layers) {
  RenderSettings settings;
  settings.integrator = integrator;
  settings.photons.emitted = 500;
  settings.samples_per_pixel = 3;
  settings.layers = layers;
  return settings;
}

Pass render_pass(const Scene& scene, const RenderSettings& settings, int pass) {
  if (settings.integrator == Integrator::path) return render_path_pass(scene, settings, pass);
  if (settings.integrator == Integrator::combined) return render_combined_pass(scene, settings, pass);
  return render_photon_pass(scene, settings, pass);
}

/// A box of fog that fills the middle of the picture, before a wall that fills its lower half.
Scene fog_before_a_wall() {
  Scene scene = unfinished_box(make_medium(nullptr, Rgb(0.5f, 1.0f, 2.0f), 0.8f));
  scene.lights = {PointLight{Vec3(0, 3, 3), Rgb(9.0f)}};
  add_shape(scene, quad_mesh(Vec3(-99, -99, -2), Vec3(198, 0, 0), Vec3(0, 99, 0)), Lambertian{kFloor});
  scene.camera = make_camera(Vec3(0, 0, 4), Vec3(0.0f), Vec3(0, 1, 0), 60.0f, {kSize, kSize});
  scene.geometry.commit();
  finish(scene);
  return scene;
}

class ViewLayers : public ::testing::Test {
 protected:
  /// The layers after so many passes.
  void render_passes(const RenderSettings& settings, int passes) {
    Film picture(kSize, kSize);
    std::vector<Film> films(view_films(settings.layers), picture);
    for (int pass = 0; pass < passes; ++pass) {
      const Pass rendered = render_pass(scene_, settings, pass);
      picture.add(pass, rendered.image);
      ASSERT_EQ(rendered.layers.size(), films.size());
      for (size_t i = 0; i < films.size(); ++i) films[i].add(pass, rendered.layers[i]);
    }
    layers_ = named_view_layers(settings, picture, films);
  }
  const NamedLayer& layer(const std::string& name) const {
    for (const NamedLayer& each : layers_)
      if (each.name == name) return each;
    ADD_FAILURE() << "there is no layer " << name;
    return layers_.front();
  }
  const Rgb& value(const std::string& name, int x, int y) const { return layer(name).image.at(x, y); }

  Scene scene_ = fog_before_a_wall();
  std::vector<NamedLayer> layers_;
};

TEST_F(ViewLayers, HaveNamesLettersAndVariances) {
  const RenderSettings settings = few_photons(Integrator::path, all_layers());
  render_passes(settings, 2);
  std::string told;
  size_t channels = 0;
  for (const NamedLayer& each : layers_) {
    told += each.name + ":" + each.letters + " ";
    channels += each.letters.size();
  }
  EXPECT_EQ(told,
            "depth:Z normal:XYZ normal-variance:XYZ albedo:RGB albedo-variance:RGB transmittance:RGB "
            "transmittance-variance:RGB single-scattering-albedo:RGB emission:RGB emission-variance:RGB samples:X ");
  EXPECT_EQ(channels, layer_channels(settings));
  render_passes(settings, 1);
  EXPECT_EQ(layers_.size(), kViewLayers.size());
  ViewLayerSet one;
  one.set(ViewLayer::transmittance, true);
  render_passes(few_photons(Integrator::path, one), 2);
  ASSERT_EQ(layers_.size(), 2u);
  EXPECT_EQ(layers_[0].name, "transmittance");
}

TEST_F(ViewLayers, TellWhatPixelsSee) {
  render_passes(few_photons(Integrator::path, all_layers()), 2);
  constexpr int kMiddle = kSize / 2;
  EXPECT_EQ(value("samples", 1, 2), Rgb(6.0f));
  // The sky, through no fog.
  EXPECT_EQ(value("depth", 0, 0).r, kNoDepth);
  EXPECT_EQ(value("normal", 0, 0), Rgb(0.0f));
  EXPECT_EQ(value("albedo", 0, 0), Rgb(0.0f));
  EXPECT_EQ(value("transmittance", 0, 0), Rgb(1.0f));
  EXPECT_EQ(value("single-scattering-albedo", 0, 0), Rgb(0.0f));
  // The wall, through no fog and through it. Rays of a pixel differ in length by what the pixel is wide.
  const auto slant = [](int x, int y) {
    const double pixel = 2.0 * std::tan(kPiD / 6.0) / kSize;
    return std::hypot(1.0, (x + 0.5 - kMiddle) * pixel, (y + 0.5 - kMiddle) * pixel);
  };
  EXPECT_NEAR(value("depth", 0, kSize - 1).r, 6.0 * slant(0, kSize - 1), 0.2);
  EXPECT_EQ(value("normal", 0, kSize - 1), Rgb(0, 0, 1));
  EXPECT_EQ(value("normal-variance", 0, kSize - 1), Rgb(0.0f));
  EXPECT_EQ(value("albedo", 0, kSize - 1), kFloor);
  EXPECT_NEAR(value("depth", kMiddle, kMiddle + 1).r, 6.0 * slant(kMiddle, kMiddle + 1), 0.02);
  for (int c = 0; c < 3; ++c) {
    const double left = std::exp(-0.5 * (1 << c) * 2.0 * slant(kMiddle, kMiddle + 1));
    EXPECT_NEAR(value("transmittance", kMiddle, kMiddle + 1)[c], left, 1e-3);
    EXPECT_NEAR(value("albedo", kMiddle, kMiddle + 1)[c], 0.8 * (1.0 - left) + double{kFloor[c]} * left, 1e-3);
    EXPECT_NEAR(value("single-scattering-albedo", kMiddle, kMiddle + 1)[c], 0.8f, 1e-6f);
  }
}

/// The row of pixels that the wall's edge runs through: some of their samples see nothing.
TEST_F(ViewLayers, GiveTheDepthOfTheSamplesThatSeeASurface) {
  scene_.camera = make_camera(Vec3(0, 0.05f, 4), Vec3(0, 0.05f, 0), Vec3(0, 1, 0), 60.0f, {kSize, kSize});
  render_passes(few_photons(Integrator::path, all_layers()), 4);
  int partly = 0;
  for (int x = 0; x < kSize; ++x)
    for (int y = 0; y < kSize; ++y) {
      const float depth = value("depth", x, y).r;
      EXPECT_TRUE(depth == kNoDepth || (depth >= 6.0f && depth < 9.0f)) << depth;
      if (const float seen = value("normal", x, y).b; seen > 0.0f && seen < 1.0f) {
        EXPECT_GT(value("normal-variance", x, y).b, 0.0f);
        ++partly;
      }
    }
  EXPECT_GT(partly, 0);
}

TEST_F(ViewLayers, LeaveTheLightAloneAndAreThoseOfAnyIntegrator) {
  std::vector<Image> first;
  for (const Integrator integrator : {Integrator::photon, Integrator::path, Integrator::combined}) {
    const Pass without = render_pass(scene_, few_photons(integrator, {}), 1);
    const Pass with = render_pass(scene_, few_photons(integrator, all_layers()), 1);
    EXPECT_TRUE(without.layers.empty());
    EXPECT_EQ(with.image.pixels, without.image.pixels);
    EXPECT_EQ(with.statistics.eye.walk.rays, without.statistics.eye.walk.rays);
    if (first.empty()) first = with.layers;
    ASSERT_EQ(with.layers.size(), first.size());
    for (size_t i = 0; i < first.size(); ++i) EXPECT_EQ(with.layers[i].pixels, first[i].pixels);
  }
}

TEST_F(ViewLayers, StandBehindThoseOfTechniques) {
  RenderSettings settings = few_photons(Integrator::combined, all_layers());
  const size_t of_view = render_pass(scene_, settings, 0).layers.size();
  settings.combined.layers = true;
  const Pass both = render_pass(scene_, settings, 0);
  ASSERT_EQ(both.layers.size(), layer_films(settings));
  EXPECT_EQ(of_view, view_films(settings.layers));
  EXPECT_EQ(both.layers.back().pixels,
            render_pass(scene_, few_photons(Integrator::path, all_layers()), 0).layers.back().pixels);
}

/// What media emit on the way, in closed form through the middle of a ball.
TEST_F(ViewLayers, HaveWhatMediaEmit) {
  Medium glowing = make_medium(nullptr, Rgb(0.5f, 1.0f, 2.0f), 0.0f);
  glowing.emission = MediumEmission{.colour = Rgb(3.0f)};
  scene_ = glowing_ball(glowing, {Vec3(0.0f), 1.0f});
  const View view = view_along(scene_, {Vec3(0, 0, 4), Vec3(0, 0, -1)});
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(view.passage.emission[c], 3.0 * -std::expm1(-2.0 * glowing.sigma_t[c]), 1e-5);
  scene_.camera = make_camera(Vec3(0, 0, 4), Vec3(0.0f), Vec3(0, 1, 0), 60.0f, {kSize, kSize});
  render_passes(few_photons(Integrator::path, all_layers()), 1);
  constexpr int kMiddle = kSize / 2;
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(value("emission", kMiddle, kMiddle)[c], view.passage.emission[c], 0.05);  // a mean over the pixel
  EXPECT_EQ(value("emission", 0, 0), Rgb(0.0f));
}

}  // namespace
}  // namespace vpm
