// Where the eye, the light and the borders are: on boundaries, in media, inside solids; nested and touching glass;
// total internal reflection at grazing angles.
#include "hard/hard_scenes.h"
#include "vpm/path/direct_light.h"

namespace vpm {
namespace {

/// A box of a grey medium of z in [-1, 1] before a panel of radiance 1 at z = -2.
Scene box_and_panel(float sigma, float albedo) {
  Scene scene;
  scene.media.push_back(make_medium(nullptr, Rgb(sigma), albedo));
  const Interface media{0, kVacuum};
  add_shape(scene, box_mesh(Vec3d(-1.0), Vec3d(1.0)), Boundary{}, &media);
  const QuadLight panel{Vec3(-9, -9, -2), Vec3(18, 0, 0), Vec3(0, 18, 0), Rgb(1.0f)};
  scene.lights.push_back(panel);
  add_shape(scene, quad_mesh(Vec3d(panel.corner), Vec3d(panel.edge_u), Vec3d(panel.edge_v)), Lambertian{Rgb(0.0f)},
            nullptr, 0);
  return scene;
}

void look(Scene& scene, const Vec3& from, const Vec3& at) {
  scene.camera = make_camera(from, at, Vec3(0, 1, 0), 1e-2f, {4, 4});
  scene.geometry.commit();
  scene.camera_medium = medium_around(scene, from);
  finish(scene);
}

TEST(BoundariesExtremes, TheEyeInAMediumOnItsBorderAndOutside) {
  // What is left of the panel behind the box: dimmed by exactly the way through it, from wherever the eye is.
  const float sigma = 0.7f;
  Worst worst("relative error of the panel from all places");
  for (const auto& [z, inside] :
       {std::pair(3.0, 2.0), std::pair(1.0, 2.0), std::pair(double(0x1.000002p0), 2.0),
        std::pair(double(0x1.fffffep-1), 2.0), std::pair(0.25, 1.25), std::pair(-1.0, 0.0), std::pair(-1.5, 0.0)}) {
    Scene scene = box_and_panel(sigma, 0.0f);
    look(scene, Vec3(0.1f, 0.2f, static_cast<float>(z)), Vec3(0.1f, 0.2f, -2.0f));
    for (const Rgb& pixel : clean_image(scene, settings_of(10, 0.1f)).pixels) {
      EXPECT_NEAR(pixel.r, std::exp(-sigma * inside), 2e-6) << z;
      worst.see(pixel.r / std::exp(-sigma * inside) - 1.0);
    }
  }
  // Along a border's face and edge the way leads through the medium or not; nothing else may come out.
  for (const Vec3& from : {Vec3(1, 0, 3), Vec3(1, 1, 3), Vec3(-1, 1, 1)}) {
    Scene scene = box_and_panel(sigma, 0.0f);
    look(scene, from, Vec3(from.x, from.y, -2.0f));
    for (const Rgb& pixel : clean_image(scene, settings_of(10, 0.1f)).pixels)
      EXPECT_TRUE(std::abs(pixel.r - 1.0) < 1e-3 || std::abs(pixel.r - std::exp(-1.4)) < 1e-3) << pixel.r;
  }
}

TEST(BoundariesExtremes, TheEyeInsideASolid) {
  // Inside an opaque ball it is dark, whatever shines outside.
  Scene dark;
  dark.media.push_back(make_medium(nullptr, Rgb(0.5f), 0.9f));
  dark.world_medium = 0;
  const Interface around{kVacuum, 0};  // else photons outside would shine in, as far as the radius reaches
  add_shape(dark, SphereShape{Vec3(0.0f), 1.0f}, Lambertian{Rgb(0.8f)}, &around);
  dark.lights.push_back(PointLight{Vec3(3, 0, 0), Rgb(100.0f)});
  dark.camera = make_camera(Vec3(0.2f, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), 90.0f, {8, 8});
  dark.geometry.commit();
  finish(dark);
  RenderSettings by_rays = settings_of(20000, 0.05f);
  by_rays.single_scattering.type = DirectLight::shadow_rays;
  for (const Rgb& pixel : clean_image(dark, by_rays).pixels) EXPECT_EQ(pixel, Rgb(0.0f));
}

TEST(BoundariesExtremes, NestedAndTouchingGlassIsInvisibleInUniformLight) {
  // Every ray ends in the same light, and the squares of the indices it passes cancel: 1, to the last digits. A ball in
  // a ball, a hollow one, and two that touch at a point where the eye looks.
  std::vector<std::vector<std::pair<SphereShape, float>>> cases{
      {{SphereShape{Vec3(0), 1.0f}, 1.5f}, {SphereShape{Vec3(0.1f, 0, 0), 0.5f}, 1.33f / 1.5f}},
      {{SphereShape{Vec3(0), 1.0f}, 1.5f}, {SphereShape{Vec3(0), 0.999f}, 1.0f / 1.5f}},
      {{SphereShape{Vec3(-1, 0, 0), 1.0f}, 1.5f}, {SphereShape{Vec3(1, 0, 0), 1.0f}, 2.4f}},
      {{SphereShape{Vec3(0), 1.0f}, 1.5f}, {SphereShape{Vec3(0.5f, 0, 0), 0.5f}, 2.4f / 1.5f}}};  // touches inside
  Worst worst("error of the radiance 1 through glass"), cut("samples cut of 1024");
  for (const auto& balls : cases) {
    Scene scene;
    for (const auto& [ball, ior] : balls) add_shape(scene, ball, Dielectric{ior});
    scene.lights.push_back(ConstantEnvironment{Rgb(1.0f)});
    scene.camera = make_camera(Vec3(0, 0, 5), Vec3(0.0f), Vec3(0, 1, 0), 30.0f, {32, 32});
    scene.geometry.commit();
    finish(scene);
    RenderSettings settings = settings_of(10, 0.1f);
    settings.max_events = 100;  // light may circle for ever in a hollow ball: cut there, and counted
    const Pass pass = render_photon_pass(scene, settings, 0);
    uint64_t darker = 0;  // than 1: a branch of their paths was cut
    double lost = 0.0;
    for (const Rgb& pixel : pass.image.pixels) {
      const bool whole = std::abs(pixel.r - 1.0f) < 1e-5f;
      if (whole) worst.see(pixel.r - 1.0);
      EXPECT_TRUE(whole || (pixel.r >= 0.0f && pixel.r < 1.0f)) << pixel.r;
      darker += !whole;
      lost += 1.0 - pixel.r;
    }
    EXPECT_LE(darker, pass.statistics.eye.cut_paths);
    EXPECT_EQ(pass.statistics.eye.non_finite, 0u);
    EXPECT_LE(lost, 5.0);
    cut.see(lost);
  }
}

TEST(BoundariesExtremes, NestedGlassWithMediaClosesItsLedger) {
  // Milk in a glass ball in fog, and a second ball of juice that touches it: photons end absorbed or gone, and no path
  // loses its medium.
  Scene scene;
  scene.media.push_back(make_medium(nullptr, Rgb(4.0f), 0.9f));  // milk
  scene.media.push_back(make_medium(nullptr, Rgb(0.1f), 0.8f));  // fog
  scene.media.push_back(make_medium(nullptr, Rgb(2.0f), 0.5f));  // juice
  scene.world_medium = 1;
  const Interface glass{kVacuum, 1}, milk{0, kVacuum}, juice{2, 1};
  add_shape(scene, SphereShape{Vec3(0), 1.0f}, Dielectric{1.5f}, &glass);
  add_shape(scene, SphereShape{Vec3(0), 0.9f}, Dielectric{1.33f / 1.5f}, &milk);
  add_shape(scene, SphereShape{Vec3(1.5f, 0, 0), 0.5f}, Dielectric{1.33f}, &juice);
  scene.lights.push_back(PointLight{Vec3(1.0f, 1.5f, 0), Rgb(1.0f)});
  scene.geometry.commit();
  finish(scene);
  const Ledger ledger = clean_ledger(scene, "regular", 20000);
  EXPECT_EQ(ledger.walk.medium_mismatches, 0u);
  const double gone = ledger.absorbed_in_media.r + ledger.escaped.r;
  Worst("ledger's gap over what was emitted").see(gone / ledger.emitted.r - 1.0);
  EXPECT_NEAR(gone / ledger.emitted.r, 1.0, 0.01);
}

TEST(BoundariesExtremes, GrazingTotalInternalReflectionKeepsEveryPhoton) {
  // A beam in a glass bar at angles just beyond the critical one, and next to parallel to its walls: nothing leaves by
  // the sides.
  for (const double cosine : {1e-6, 1e-4, 1e-2, 0.1, 0.7, std::sqrt(5.0) / 3.0 - 1e-4}) {  // to the wall's normal
    Scene scene;
    add_shape(scene, box_mesh(Vec3d(-50, -1, -1), Vec3d(50, 1, 1)), Dielectric{1.5f});
    add_shape(scene, quad_mesh(Vec3d(60, -9, -9), Vec3d(0, 18, 0), Vec3d(0, 0, 18)), Lambertian{Rgb(0.0f)});
    add_shape(scene, quad_mesh(Vec3d(-60, -9, -9), Vec3d(0, 0, 18), Vec3d(0, 18, 0)), Lambertian{Rgb(0.0f)});
    const Vec3 direction(Vec3d(std::sqrt(1.0 - cosine * cosine), cosine, 0.0));
    scene.lights.push_back(BeamLight{Vec3(-40, 0, 0), direction, 0.5f, Rgb(1.0f)});
    scene.geometry.commit();
    finish(scene);
    // At the bar's ends the angle to their normal is the complement: where that is beyond the critical angle too, the
    // light circles for ever, and is cut and counted; nothing escapes sideways in any case.
    ListSettings settings;
    settings.emitted = 1000;
    settings.max_events = 2000;
    const Ledger ledger = trace_with(scene, "regular", settings).ledger;
    EXPECT_EQ(ledger.non_finite, 0u);
    EXPECT_EQ(ledger.escaped, Rgbd(0.0)) << cosine;
    EXPECT_NEAR((ledger.absorbed_on_surfaces.r + ledger.cut.r) / ledger.emitted.r, 1.0, 1e-6);
  }
}

TEST(BoundariesExtremes, ALightInTheMediumOnItsBorderAndOutside) {
  // A medium so thick that all that enters it stays: half of the light on its border, all of the light inside.
  constexpr uint64_t kPhotons = 20000;
  for (const Vec3& at : {Vec3(0.1f, 1.0f, 0.2f), Vec3(1.0f, 0.1f, -0.3f), Vec3(0.2f, -0.1f, -1.0f)}) {
    const Ledger ledger =
        clean_ledger(boxed_medium(make_medium(nullptr, Rgb(1e5f), 0.0f), PointLight{at}), "regular", kPhotons);
    expect_share(ledger.absorbed_in_media.r / ledger.emitted.r, 0.5, kPhotons, "on a face");
  }
  const Ledger corner =
      clean_ledger(boxed_medium(make_medium(nullptr, Rgb(1e5f), 0.0f), PointLight{Vec3(1.0f)}), "regular", kPhotons);
  expect_share(corner.absorbed_in_media.r / corner.emitted.r, 0.125, kPhotons, "on a corner");
  const Ledger inside =
      clean_ledger(boxed_medium(make_medium(nullptr, Rgb(1e5f), 0.0f), PointLight{Vec3(0.5f)}), "regular", kPhotons);
  EXPECT_NEAR(inside.absorbed_in_media.r / inside.emitted.r, 1.0, 1e-6);
  // From a point 6 m above a face 2 m wide: the solid angle of a square, 4 asin(a^2 / (a^2 + h^2)) with a half edge a.
  const Ledger outside =
      clean_ledger(boxed_medium(make_medium(nullptr, Rgb(1e5f), 0.0f), PointLight{Vec3(0, 7, 0)}), "regular", kPhotons);
  expect_share(outside.absorbed_in_media.r / outside.emitted.r, 4.0 * std::asin(1.0 / 37.0) / (4.0 * kPiD), kPhotons,
               "outside");
}

TEST(BoundariesExtremes, ShadowRaysToALightOnTheBorderCrossTheWayInside) {
  // From a point of the medium to lights before, on and behind its face: the way inside counts, to the last digits.
  const float sigma = 1.3f;
  Worst worst("relative error of the light at a point");
  for (const float y : {0.5f, 0x1.fffffep-1f, 1.0f, 0x1.000002p0f, 4.0f}) {
    const Scene scene = boxed_medium(make_medium(nullptr, Rgb(sigma)), PointLight{Vec3(0.1f, y, 0.2f), Rgb(1.0f)});
    const auto regular = make_transmittance_estimator({});
    WalkCounters counters;
    Rng rng(1, 0, 0);
    const Vec3 point(0.1f, -0.5f, 0.2f);
    const DirectSample light = sample_direct({scene, *regular, rng, counters}, 0, {point, 0});
    const double way = std::min(y, 1.0f) + 0.5;
    const double square = (double(y) + 0.5) * (double(y) + 0.5);
    EXPECT_NEAR(light.irradiance.r * square / std::exp(-sigma * way), 1.0, 2e-6) << y;
    worst.see(light.irradiance.r * square / std::exp(-sigma * way) - 1.0);
    EXPECT_EQ(counters.medium_mismatches, 0u);
  }
}

}  // namespace
}  // namespace vpm
