// Photon planes met by a ray: one plane by hand, alone and beside beams; what stands in its way; and beams beside it.
#include "vpm/integrators/photon_map/volume/photon_planes.h"

#include <gtest/gtest.h>

#include "support/grids.h"
#include "support/scenes.h"

namespace vpm {
namespace {

constexpr float kPlaneRadius = 0.1f;  // m
const Vec3 kEye(1.0f, 0.0f, 0.0f), kCrossing(1.0f, 0.0f, 0.0f);
const Rgb kPower(3.0f, 2.0f, 1.0f);

/// The plane that the estimator makes of a flight: its ray meets the one along x at x = 1 m, 0.6 m after a collision
/// that is 0.5 m along the flight.
PhotonPlane one_plane(const Medium& medium, float length) {
  const Vec3 direction = glm::normalize(Vec3(0.3f, 0.4f, 0.5f));
  Rng rng(1, rng_stream(RngUse::plane, 0), 0);
  const Vec3 scattered = phase_sample(medium.phase, direction, rng.uniform2());
  return {kCrossing - 0.6f * scattered - 0.5f * direction, length, direction, scattered, kPower, 0};
}

/// The world of a medium. Half way between the collision and the crossing may stand an opaque cube, or a mere boundary.
enum class Between { nothing, wall, boundary };
Scene world_of(const Medium& medium, Between between) {
  Scene scene;
  scene.media.push_back(medium);
  scene.world_medium = 0;
  scene.lights.push_back(ConstantEnvironment{Rgb(1.0f)});
  const Vec3d middle = Vec3d(kCrossing) - 0.3 * Vec3d(one_plane(medium, 1.0f).scattered);
  const auto cube = box_mesh(middle - Vec3d(0.1), middle + Vec3d(0.1));
  const Interface media{0, 0};
  if (between == Between::wall) add_shape(scene, cube, Lambertian{Rgb(0.5f)}, &media);
  if (between == Between::boundary) add_shape(scene, cube, Boundary{}, &media);
  scene.geometry.commit();
  finish(scene);
  return scene;
}

/// The light of a plane and of beams, if any.
Rgb light_of(const Scene& scene, const PhotonPlane* plane, bool alone, const std::vector<PhotonBeam>& beams = {}) {
  VolumeSettings settings("photon-planes", {.radius = kPlaneRadius});
  settings.share = alone ? PlaneUse::alone : PlaneUse::combined;
  PhotonPlanes estimator(scene, make_transmittance_estimator({}), settings, {});
  const Recorders recorders = estimator.recorders();
  static_cast<BeamRecorder*>(recorders.front())->beams[0] = beams;
  if (plane)
    static_cast<BeamRecorder*>(recorders.back())->beams[0] = {
        {plane->origin, plane->length, plane->direction, plane->power}};
  RenderStatistics statistics;
  estimator.build(1, statistics);
  EyeCounters counters;
  EyeScratch scratch;
  Rng rng(1, 0, 0);
  EyeWork work{rng, counters, scratch};
  const EyeSegment segment(scene, {{Vec3(0.0f), kEye}, {0.0f, 2.0f}, 0}, {});
  return estimator.along(segment, work).value;
}

float determinant_of(const PhotonPlane& plane) {
  return std::abs(glm::dot(plane.direction, glm::cross(plane.scattered, kEye)));
}

/// The light of a plane, of all from planes.
Rgb by_hand(const Medium& medium, const PhotonPlane& plane) {
  const Rgb come = glm::exp(-medium.sigma_t * 0.5f);
  const Rgb weight = come / glm::dot(plane.power / sum_channels(plane.power), come);
  const float phase = phase_value(medium.phase, plane.scattered, -kEye);
  return plane.power * weight * medium.sigma_s * medium.sigma_s * glm::exp(-medium.sigma_t * 1.6f) * phase /
         determinant_of(plane);
}

/// The share of planes in light that beams find, too: in proportion to the densities with which the two cross the ray.
float share_of_planes(const PhotonPlane& plane, float sigma_s) {
  const float beams =
      sigma_s * kernel_size_1d(KernelKind::epanechnikov, kPlaneRadius) * glm::length(glm::cross(plane.scattered, kEye));
  return determinant_of(plane) / (determinant_of(plane) + beams);
}

TEST(PhotonPlanes, OnePlaneIsItsFactors) {
  for (const Rgb& sigma_t : {Rgb(0.7f), Rgb(0.2f, 1.0f, 3.0f)}) {
    Medium medium = make_medium(nullptr, sigma_t);
    medium.sigma_s = Rgb(0.9f, 0.5f, 0.1f) * sigma_t;
    medium.phase = HenyeyGreenstein{0.4f};
    const Scene scene = world_of(medium, Between::nothing);
    const PhotonPlane plane = one_plane(medium, 0.51f), shorter = one_plane(medium, 0.49f);
    const Rgb found = light_of(scene, &plane, true), light = by_hand(medium, plane);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], light[c], 1e-4f * light[c]);
    EXPECT_EQ(light_of(scene, &shorter, true).g, 0.0f) << "the photon collides before";
  }
}

TEST(PhotonPlanes, ShareTheirLightWithBeams) {
  const Medium medium = make_medium(nullptr, Rgb(0.7f));
  const Scene scene = world_of(medium, Between::nothing);
  const PhotonPlane plane = one_plane(medium, 0.51f);
  const Rgb found = light_of(scene, &plane, false), all = by_hand(medium, plane);
  EXPECT_NEAR(found.g, all.g * share_of_planes(plane, medium.sigma_s.g), 1e-4f * all.g);
}

// The beam that begins where the plane's photon might have collided has the rest; all, if it began elsewhere.
TEST(PhotonPlanes, LeaveTheRestToBeams) {
  const Medium medium = make_medium(nullptr, Rgb(0.7f));
  const Scene scene = world_of(medium, Between::nothing);
  const PhotonPlane plane = one_plane(medium, 0.51f);
  PhotonBeam beam{kCrossing - 0.6f * plane.scattered, 0.7f, plane.scattered, kPower};
  const float sine = glm::length(glm::cross(plane.scattered, kEye));
  const float all = kPower.g * medium.sigma_s.g * std::exp(-0.7f) *
                    kernel_norm_1d(KernelKind::epanechnikov, kPlaneRadius) / (4.0f * kPi * sine);
  beam.turned_from = PackedDirection(plane.direction);
  beam.scattering_rate = medium.sigma_s.g;
  EXPECT_NEAR(light_of(scene, nullptr, false, {beam}).g, all * (1.0f - share_of_planes(plane, medium.sigma_s.g)),
              3e-4f * all);
  beam.scattering_rate = 0.0f;
  const BeamBalance balance{kernel_size_1d(KernelKind::epanechnikov, kPlaneRadius),
                            kernel_size_2d(KernelKind::epanechnikov, kPlaneRadius), 1.0f};
  EXPECT_NEAR(light_of(scene, nullptr, false, {beam}).g, all * sine * balance.of_beams_over_sine(sine, 0.7f),
              1e-4f * all);
}

// In a grid whose density rises evenly the integral along a line is its length times the density at its middle.
TEST(PhotonPlanes, GoByTheDensitiesOfAGrid) {
  const auto density = [](const Vec3& p) { return 1.0f + 0.1f * p.x - 0.05f * p.y + 0.08f * p.z; };
  for (const Rgb& sigma_t : {Rgb(0.7f), Rgb(0.2f, 1.0f, 3.0f)}) {
    Medium medium = make_medium(
        make_grid(centered_frame(16, 0.25), [&](int x, int y, int z) { return density(0.25f * Vec3(x, y, z)); }),
        sigma_t, 0.8f);
    medium.phase = HenyeyGreenstein{0.4f};
    const Scene scene = world_of(medium, Between::nothing);
    const PhotonPlane plane = one_plane(medium, 0.51f);
    const Vec3 turn = plane.origin + 0.5f * plane.direction;
    const auto between = [&](const Vec3& a, const Vec3& b) { return glm::distance(a, b) * density(0.5f * (a + b)); };
    const Rgb come = glm::exp(-sigma_t * between(plane.origin, turn));
    const Rgb weight = come / glm::dot(plane.power / sum_channels(plane.power), come);
    const Rgb passed = glm::exp(-sigma_t * (between(turn, kCrossing) + between(Vec3(0.0f), kCrossing)));
    const float phase = phase_value(medium.phase, plane.scattered, -kEye);
    const Rgb light = plane.power * weight * medium.sigma_s * medium.sigma_s * density(turn) * density(kCrossing) *
                      passed * phase / determinant_of(plane);
    const Rgb found = light_of(scene, &plane, true), shared = light_of(scene, &plane, false);
    const float share = share_of_planes(plane, mean_channel(medium.sigma_s) * density(turn));
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(found[c], light[c], 2e-4f * light[c]);
      EXPECT_NEAR(shared[c], light[c] * share, 3e-4f * light[c]);
    }
  }
}

TEST(PhotonPlanes, DoNotPassWalls) {
  const Medium medium = make_medium(nullptr, Rgb(0.7f));
  const PhotonPlane plane = one_plane(medium, 0.51f);
  EXPECT_EQ(light_of(world_of(medium, Between::wall), &plane, true).g, 0.0f);
  const Rgb light = by_hand(medium, plane);
  EXPECT_NEAR(light_of(world_of(medium, Between::boundary), &plane, true).g, light.g, 1e-4f * light.g);
}

// Where a ray lies along the light, or the medium ends, there is a share still.
TEST(BeamBalance, SharesSumToOne) {
  const BeamBalance balance{0.2f, 0.03f, 0.1f};
  for (const float sine : {0.0f, 1e-6f, 0.3f, 1.0f})
    for (const float sigma : {0.0f, 1e-3f, 5.0f}) {
      const float collisions = balance.of_collisions(sine, sigma);
      EXPECT_TRUE(collisions >= 0.0f && collisions <= 1.0f) << sine << " " << sigma;
      if (sine == 0.0f) continue;
      EXPECT_NEAR(sine * balance.of_beams_over_sine(sine, sigma) + collisions, 1.0f, 1e-6f);
      if (sigma == 0.0f) continue;
      for (const float volume : {1e-6f, 0.2f * sine, sine})
        EXPECT_NEAR(sine * balance.of_beams_beside_planes_over_sine(sine, sigma, volume) +
                        volume * balance.of_planes_over_determinant(sine, sigma, volume),
                    1.0f, 1e-6f);
    }
}

}  // namespace
}  // namespace vpm
