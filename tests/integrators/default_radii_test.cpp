// Radii that hold as many photons as they promise, within their bounds.
#include "vpm/integrators/default_radii.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/borders.h"
#include "tune/pilot_scenes.h"
#include "vpm/estimate/photon_map.h"
#include "vpm/integrators/combined/combined_pass.h"

namespace vpm {
namespace {

/// 16 photons of 100,000 lie within 0.2 m.
MapDensity density(int dimension) { return {0.2, 16.0, 1e5, dimension, 0.01}; }

TEST(DefaultRadii, RadiusHoldsSoManyPhotonsWhateverIsEmitted) {
  // As many photons per emitted as in the pilot: (0.5 / 16)^(1/2) of its reach under 100 times the photons.
  const float surface = choose_radius(density(2), kPhotonsWithin / 0.5 * 1e5, 10.0).radius;
  EXPECT_FLOAT_EQ(surface, 0.0354f);  // 0.2 sqrt(1/32) = 0.035355
  const float volume = choose_radius(density(3), kPhotonsWithin / 2.0 * 1e5, 10.0).radius;
  EXPECT_FLOAT_EQ(volume, 0.1f);  // 0.2 (1/8)^(1/3)
  EXPECT_NE(choose_radius(density(3), 1e6, 10.0).reason.find("of the first pass"), std::string::npos);
}

TEST(DefaultRadii, RadiusStaysBetweenHalfAPixelAndATwentiethOfTheScene) {
  const ChosenRadius fine = choose_radius(density(2), 1e12, 10.0);
  EXPECT_FLOAT_EQ(fine.radius, 0.005f);
  EXPECT_EQ(fine.reason.substr(0, 12), "half a pixel");
  const ChosenRadius wide = choose_radius(density(2), 1e3, 3.0);
  EXPECT_FLOAT_EQ(wide.radius, 0.15f);
  EXPECT_EQ(wide.reason.substr(0, 11), "a twentieth");
}

TEST(DefaultRadii, RadiusStaysWithinTheMediumUnlessTooFewPhotonsWouldBeWithin) {
  MapDensity thin = density(3);  // 0.1 m hold two of 100,000, 0.09 m hold 1.458
  thin.thickness = 1.0;
  const ChosenRadius tenth = choose_radius(thin, 6.0 * 1e5, 10.0);
  EXPECT_FLOAT_EQ(tenth.radius, 0.1f);
  EXPECT_EQ(tenth.reason.substr(0, 40), "a tenth of the medium's thickness; 0.161");
  thin.free_path = 0.09;
  const ChosenRadius path = choose_radius(thin, 8.0 * 1e5, 10.0);
  EXPECT_FLOAT_EQ(path.radius, 0.09f);
  EXPECT_EQ(path.reason.substr(0, 24), "the mean free path there");
  thin.thickness = kInfinity;
  const ChosenRadius few = choose_radius(thin, 5.0 * 1e5, 10.0);
  EXPECT_FLOAT_EQ(few.radius, 0.1f);
  EXPECT_EQ(few.reason.substr(0, 3), "10 ");
  EXPECT_NE(few.reason.find("fewer within the mean free path"), std::string::npos) << few.reason;
}

/// As many photons lie within the radius chosen as the rule says, in air so thin that light stays what it is.
TEST(DefaultRadii, TheRadiusOfAMediumHoldsThePhotonsThatItPromises) {
  const Scene scene = lit_evenly(0.01f);
  RenderSettings settings;
  settings.single_scattering.type = DirectLight::photons;
  settings.photons.emitted = 1'000'000;
  choose_default_radii(scene, {{"integrator.volume.radius"}}, settings);
  // Of a cylinder through the box, 2 m long, that a share of 1 - exp(-0.02) collides in; few do so twice.
  const double collisions = -std::expm1(-0.02) * settings.photons.emitted;
  const double share = 4.0 / 3.0 * std::pow(settings.volume.radius.metres(), 3.0) / (0.9 * 0.9 * 2.0);
  EXPECT_NEAR(share * collisions, kPhotonsWithin, 0.15 * kPhotonsWithin);
}

/// Of two media the thinner bounds radii, though most places lie in the other; as thick as it is across, not along
/// axes.
TEST(DefaultRadii, MediaAreAsThickAsTheThinnestIsAcross) {
  Scene scene;
  const Interface slab{0, kVacuum}, box{1, kVacuum};
  scene.media.push_back(make_medium(nullptr, Rgb(5.0f), 0.9f));
  scene.media.push_back(make_medium(nullptr, Rgb(2.0f), 0.9f));
  const float half = std::sqrt(0.5f);
  const glm::mat3 askew(half, half, 0.0f, -half, half, 0.0f, 0.0f, 0.0f, 1.0f);
  add_shape(scene, turned(box_mesh(Vec3d(-1.0, -0.05, -1.0), Vec3d(1.0, 0.05, 1.0)), askew), Boundary{}, &slab);
  add_shape(scene, box_mesh(Vec3d(-1.0, -1.0, -4.0), Vec3d(1.0, 1.0, -2.0)), Boundary{}, &box);
  scene.lights.push_back(BeamLight{Vec3(0.0f, 2.0f, 0.0f), Vec3(0.0f, -1.0f, 0.0f), 0.9f, Rgb(1.0f)});
  scene.camera = make_camera(Vec3(0.0f, 0.0f, 3.0f), Vec3(0.0f), Vec3(0.0f, 1.0f, 0.0f), 20.0f, {64, 64});
  scene.geometry.commit();
  finish(scene);
  const MapDensities found = map_densities(scene, {}, 2000);
  EXPECT_NEAR(found.volume->thickness, 0.1, 1e-4);
  EXPECT_NEAR(found.volume->free_path, 0.2, 1e-6);
}

/// A grid of 2 m in a box of 8 m.
TEST(DefaultRadii, MediaEndWithTheirGrids) {
  Scene scene;
  scene.media.push_back(make_medium(make_grid(centered_frame(16, 1.0 / 16.0), lattice_noise), Rgb(2.0f), 0.9f));
  const Interface media{0, kVacuum};
  add_shape(scene, box_mesh(Vec3d(-4.0), Vec3d(4.0)), Boundary{}, &media);
  scene.lights.push_back(PointLight{Vec3(0.0f, 3.0f, 0.0f), Rgb(10.0f)});
  scene.camera = make_camera(Vec3(0.0f, 0.0f, 5.0f), Vec3(0.0f), Vec3(0.0f, 1.0f, 0.0f), 10.0f, {16, 16});
  scene.geometry.commit();
  finish(scene);
  const MapDensities found = map_densities(scene, {}, 20'000);
  EXPECT_GT(found.volume->thickness, 0.6);
  EXPECT_LT(found.volume->thickness, 2.1);
}

TEST(DefaultRadii, AreTheSameWhateverTimeIsAskedFor) {
  const AssembledScene room = foggy_room(4.0f);
  RenderSettings unhurried, hurried;
  hurried.until.seconds = 0.1;
  const AutomaticSettings automatic{.default_radii = {"integrator.volume.radius"}};
  choose_default_radii(room.scene, automatic, unhurried);
  choose_default_radii(room.scene, automatic, hurried);
  EXPECT_EQ(hurried.volume.radius, unhurried.volume.radius);
}

/// Flights pass within the radius chosen as the rule says: all through the same box, along one direction.
TEST(DefaultRadii, TheRadiusOfBeamsHoldsTheFlightsThatItPromises) {
  const Scene scene = lit_evenly(0.01f);
  RenderSettings settings;
  settings.volume.choose("photon-beams");
  settings.photons.emitted = 1'000'000;
  choose_default_radii(scene, {{"integrator.volume.radius"}}, settings);
  const double share = std::pow(settings.volume.radius.metres() / 0.9, 2.0);  // of the photons
  EXPECT_NEAR(share * settings.photons.emitted, kPhotonsWithin, 0.15 * kPhotonsWithin);
}

/// The photons within the radius chosen, at a place that is lit evenly and seen straight, are as many as the rule says:
/// power over area of an even parallel light tells how many there are.
TEST(DefaultRadii, TheRadiusHoldsThePhotonsThatItPromises) {
  Scene scene;
  add_shape(scene, quad_mesh(Vec3d(-1.0, 0.0, 1.0), Vec3d(2.0, 0.0, 0.0), Vec3d(0.0, 0.0, -2.0)),
            Lambertian{Rgb(0.5f)});
  scene.lights.push_back(BeamLight{Vec3(0.0f, 2.0f, 0.0f), Vec3(0.0f, -1.0f, 0.0f), 0.9f, Rgb(1.0f)});
  scene.camera = make_camera(Vec3(0.0f, 3.0f, 0.0f), Vec3(0.0f), Vec3(0.0f, 0.0f, -1.0f), 20.0f, {64, 64});
  scene.geometry.commit();
  finish(scene);
  RenderSettings settings;
  settings.direct.type = DirectLight::photons;
  settings.photons.emitted = 400'000;
  choose_default_radii(scene, {{"integrator.surface.radius"}}, settings);
  const double share = std::pow(settings.surface.radius.metres() / 0.9, 2.0);  // of the photons
  // The median over 512 places of densities told by 16 photons each: off by 2 % or so, and by 4 % as the median of a
  // gamma distribution is; a tenth is four standard deviations at least.
  EXPECT_NEAR(share * 400'000, kPhotonsWithin, 0.1 * kPhotonsWithin);
}

/// Few photons want wide radii, within which merges at borders would lose light.
TEST(DefaultRadii, MergesAreByDefaultNoWiderThanWhereNobodyChooses) {
  const Scene scene = cloud_over_floor(true);
  const AutomaticSettings automatic{.default_radii = {"integrator.volume.radius", "integrator.surface.radius"}};
  RenderSettings maps, combined;
  maps.photons.emitted = combined.photons.emitted = 2000;
  combined.integrator = Integrator::combined;
  choose_default_radii(scene, automatic, maps);
  for (const Choice& choice : choose_default_radii(scene, automatic, combined))
    EXPECT_EQ(choice.reason.substr(0, 34), "1 % of the scene's or the grid's d") << choice.reason;
  const float merges = first_radius_of_merges({}, scene);
  EXPECT_GT(maps.volume.radius.metres(), merges);
  EXPECT_EQ(combined.volume.radius.metres(), merges);
  EXPECT_EQ(combined.surface.radius.metres(), first_radius({}, scene));
}

}  // namespace
}  // namespace vpm
