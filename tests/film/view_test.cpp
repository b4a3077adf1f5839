// What rays from the camera see, against closed forms.
#include "vpm/film/view_layers.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/scenes.h"
#include "vpm/surface/material/fresnel.h"

namespace vpm {
namespace {

constexpr float kGlassIor = 1.5f;
const Ray kAhead{Vec3(0.1f, 0.2f, 3.0f), Vec3(0, 0, -1)};

template <class Shape>
void add_quad_at(Scene& scene, float z, const Shape& material) {
  add_shape(scene, quad_mesh(Vec3(-9, -9, z), Vec3(18, 0, 0), Vec3(0, 18, 0)), material);
}

void be_ready(Scene& scene) {
  scene.geometry.commit();
  finish(scene);
}

void expect_near(const Rgbd& value, const Rgbd& expected, double tolerance) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(value[c], expected[c], tolerance) << "channel " << c;
}

/// The distance along `ray` to the unit sphere about the origin.
double distance_to_unit_sphere(const Ray& ray) {
  const Vec3d o(ray.origin), d(ray.direction);
  const double b = glm::dot(o, d);
  return -b - std::sqrt(b * b - glm::dot(o, o) + 1.0);
}

TEST(View, HasDistanceAndNormalOfASphere) {
  Scene scene;
  add_shape(scene, SphereShape{Vec3(0.0f), 1.0f}, Lambertian{Rgb(0.2f, 0.4f, 0.6f)});
  be_ready(scene);
  for (const Vec3& target : {Vec3(0.0f), Vec3(0.3f, -0.5f, 0.1f), Vec3(0.0f, 0.8f, 0.0f)}) {
    const Ray ray{Vec3(0.5f, 1.0f, 3.0f), glm::normalize(target - Vec3(0.5f, 1.0f, 3.0f))};
    const View view = view_along(scene, ray);
    const double distance = distance_to_unit_sphere(ray);
    EXPECT_NEAR(view.distance, distance, 1e-6);
    EXPECT_LT(glm::distance(Vec3d(view.normal), Vec3d(ray.origin) + distance * Vec3d(ray.direction)), 2e-6);
    expect_near(view.albedo, {0.2, 0.4, 0.6}, 1e-7);
    expect_near(view.passage.transmittance, Rgbd(1.0), 0.0);
  }
  const View beside = view_along(scene, {Vec3(0, 0, 3), Vec3(0, 1, 0)});
  EXPECT_FALSE(beside.passage.surface);
  EXPECT_EQ(beside.distance, 0.0);
  EXPECT_EQ(beside.normal, Vec3(0.0f));
  EXPECT_EQ(beside.albedo, Rgbd(0.0));
}

TEST(View, HasTheNormalOnTheSideOfTheCamera) {
  Scene scene;
  add_quad_at(scene, 0.0f, Lambertian{});
  be_ready(scene);
  const View front = view_along(scene, kAhead), back = view_along(scene, {Vec3(0.1f, 0.2f, -2.0f), Vec3(0, 0, 1)});
  EXPECT_EQ(front.normal, Vec3(0, 0, 1));
  EXPECT_FLOAT_EQ(static_cast<float>(front.distance), 3.0f);
  EXPECT_EQ(back.normal, Vec3(0, 0, -1));
  EXPECT_FLOAT_EQ(static_cast<float>(back.distance), 2.0f);
}

TEST(View, OfASlabIsExponential) {
  Medium fog;
  fog.sigma_t = Rgb(0.5f, 2.0f, 0.0f);
  fog.sigma_s = Rgb(0.4f, 0.5f, 0.0f);
  Scene scene = boxed_medium(fog, PointLight{});
  const Ray slanted{Vec3(0.0f, 0.0f, 3.0f), glm::normalize(Vec3(0.2f, 0.1f, -1.0f))};
  const double length = 2.0 / -slanted.direction.z;
  const Passage passage = view_along(scene, slanted).passage;
  const Rgbd left(std::exp(-0.5 * length), std::exp(-2.0 * length), 1.0);
  expect_near(passage.transmittance, left, 1e-6);
  expect_near(passage.lost, 1.0 - left, 1e-6);
  expect_near(passage.scattered, Rgbd(0.8, 0.25, 0.0) * (1.0 - left), 1e-6);
}

/// Thin fog: what is lost is far below the rounding of a transmittance in single precision.
TEST(View, TellsWhatThinMediaScatter) {
  Scene scene = boxed_medium(make_medium(nullptr, Rgb(1e-12f), 0.7f), PointLight{});
  const Passage passage = view_along(scene, kAhead).passage;
  expect_near(passage.lost * 1e12, Rgbd(2.0), 1e-5);
  expect_near(passage.scattered / passage.lost, Rgbd(0.7), 1e-6);
}

/// Of media behind each other, that one counts more which takes more of the light.
TEST(View, WeighsMediaByTheLightTheyTake) {
  Scene scene;
  scene.media = {make_medium(nullptr, Rgb(1.0f), 0.9f), make_medium(nullptr, Rgb(0.5f), 0.1f)};
  const Interface first{0, kVacuum}, second{1, kVacuum};
  add_shape(scene, box_mesh(Vec3d(-1, -1, 1), Vec3d(1, 1, 2)), Boundary{}, &first);
  add_shape(scene, box_mesh(Vec3d(-1, -1, -2), Vec3d(1, 1, 0)), Boundary{}, &second);
  be_ready(scene);
  const Passage passage = view_along(scene, kAhead).passage;
  const double by_first = 1.0 - std::exp(-1.0), by_second = std::exp(-1.0) - std::exp(-2.0);
  expect_near(passage.scattered, Rgbd(0.9 * by_first + 0.1 * by_second), 1e-6);
  expect_near(passage.lost, Rgbd(by_first + by_second), 1e-6);
}

TEST(View, OfAGridIsThatOfItsDensityIntegral) {
  const Medium smoke = make_medium(
      make_grid(centered_frame(7, 0.125), [](int x, int y, int z) { return lattice_noise(x, y, z); }), Rgb(1, 2, 4));
  Scene scene = unfinished_box(smoke);
  add_quad_at(scene, -0.37f, Lambertian{});  // in the midst of the grid
  be_ready(scene);
  const Ray ray{Vec3(0.3f, 0.2f, 3.0f), glm::normalize(Vec3(-0.1f, 0.05f, -1.0f))};
  const View view = view_along(scene, ray);
  constexpr int kPoints = 200'000;
  double integral = 0.0;  // by the midpoint rule
  for (int i = 0; i < kPoints; ++i)
    integral += double{smoke.density(ray.at(static_cast<float>(view.distance * (i + 0.5) / kPoints)))};
  integral *= view.distance / kPoints;
  EXPECT_GT(integral, 0.3);
  expect_near(view.passage.transmittance, glm::exp(-integral * Rgbd(1, 2, 4)), 1e-5);
  expect_near(view.passage.scattered, 0.5 * view.passage.lost, 1e-7);
}

TEST(View, OfAMediumWithoutEndIsWhatIsNotAttenuated) {
  Scene scene;
  Medium fog;
  fog.sigma_t = Rgb(0.5f, 1e-6f, 0.0f);
  fog.sigma_s = Rgb(0.2f, 1e-6f, 0.0f);
  scene.media = {fog};
  scene.world_medium = scene.camera_medium = 0;
  be_ready(scene);
  const View view = view_along(scene, kAhead);
  expect_near(view.passage.transmittance, {0, 0, 1}, 0.0);
  expect_near(view.passage.scattered, {0.4, 1.0, 0.0}, 1e-7);
  expect_near(view.albedo, {0.4, 1.0, 0.0}, 1e-7);
}

TEST(View, SeesAlbedoThroughMirrorsAndGlass) {
  const Rgb front(0.9f, 0.5f, 0.1f), behind(0.2f, 0.3f, 0.4f);
  const auto albedo_by = [&](const Material& material) {
    Scene scene;
    add_quad_at(scene, 5.0f, Lambertian{front});
    add_quad_at(scene, 0.0f, material);
    add_quad_at(scene, -5.0f, Lambertian{behind});
    be_ready(scene);
    const View view = view_along(scene, kAhead);
    EXPECT_FLOAT_EQ(static_cast<float>(view.distance), 3.0f);  // of the first surface, whatever that shows
    EXPECT_EQ(view.normal, Vec3(0, 0, 1));
    return view.albedo;
  };
  expect_near(albedo_by(Mirror{Rgb(0.8f, 1.0f, 0.5f)}), Rgbd(front) * Rgbd(0.8, 1.0, 0.5), 1e-6);
  const Rgb eta(0.2f, 0.9f, 1.2f), k(3.9f, 2.4f, 2.0f);
  const Rgb of_metal = fresnel_conductor(1.0f, eta, k);
  expect_near(albedo_by(Conductor{eta, k}), Rgbd(front) * Rgbd(of_metal), 1e-6);
  expect_near(albedo_by(RoughConductor{eta, k}), Rgbd(of_metal), 1e-7);
  expect_near(albedo_by(RoughDielectric{kGlassIor}), Rgbd(1.0), 0.0);
  expect_near(albedo_by(Phong{Rgb(0.5f), Rgb(0.3f)}), Rgbd(0.8), 1e-7);
  const double of_face = fresnel_dielectric(1.0f, kGlassIor), of_pane = 2.0 * of_face / (1.0 + of_face);
  expect_near(albedo_by(ThinDielectric{kGlassIor}), of_pane * Rgbd(front) + (1.0 - of_pane) * Rgbd(behind), 1e-6);
  expect_near(albedo_by(Mirror{Rgb(0.0f)}), Rgbd(0.0), 0.0);
}

/// At the center of a ball of glass every branch comes back along the same line: a geometric series, cut where the
/// weaker side is worth little.
TEST(View, SeesAlbedoThroughABallOfGlass) {
  Scene scene;
  add_shape(scene, SphereShape{Vec3(0.0f), 1.0f}, Dielectric{kGlassIor});
  add_quad_at(scene, 5.0f, Lambertian{Rgb(0.9f)});
  add_quad_at(scene, -5.0f, Lambertian{Rgb(0.2f)});
  be_ready(scene);
  const double r = fresnel_dielectric(1.0f, kGlassIor), through = (1.0 - r) * (1.0 - r) / (1.0 - r * r);
  expect_near(view_along(scene, {Vec3(0, 0, 3), Vec3(0, 0, -1)}).albedo, Rgbd(0.2 * through + 0.9 * (1.0 - through)),
              1.0 / 256.0);
}

TEST(View, IsWhiteWhereMirrorsShowEachOtherWithoutEnd) {
  Scene scene;
  add_quad_at(scene, 5.0f, Mirror{Rgb(0.5f, 1.0f, 1.0f)});
  add_quad_at(scene, 0.0f, Mirror{Rgb(1.0f, 1.0f, 0.5f)});
  be_ready(scene);
  const double left = std::pow(0.5, kMostSpecular / 2);
  expect_near(view_along(scene, kAhead).albedo, {left, 1.0, left}, 1e-7);
}

TEST(View, HasTheAlbedoOfFogAsFarAsItHides) {
  Scene scene = unfinished_box(make_medium(nullptr, Rgb(0.5f), 0.8f));
  add_quad_at(scene, -2.0f, Lambertian{Rgb(0.25f)});
  be_ready(scene);
  const double left = std::exp(-0.5 * 2.0);
  expect_near(view_along(scene, kAhead).albedo, Rgbd(0.8 * (1.0 - left) + 0.25 * left), 1e-6);
}

}  // namespace
}  // namespace vpm
