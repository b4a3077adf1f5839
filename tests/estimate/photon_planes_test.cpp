// Photon planes met by a ray: one plane by hand, alone and beside beams; what stands in its way.
#include "vpm/estimate/volume/photon_planes.h"

#include <gtest/gtest.h>

#include "support/grids.h"
#include "support/scenes.h"

namespace vpm {
namespace {

constexpr float kPlaneRadius = 0.1f;  // m
const Vec3 kEye(1.0f, 0.0f, 0.0f);

/// The world of a medium; an opaque or a merely dividing square at x = 1 m may stand in it.
enum class Between { nothing, wall, boundary };
Scene world_of(const Medium& medium, Between between) {
  Scene scene;
  scene.media.push_back(medium);
  scene.world_medium = 0;
  scene.lights.push_back(ConstantEnvironment{Rgb(1.0f)});
  const auto square = box_mesh(Vec3d(0.9, 0.2, -1.0), Vec3d(1.1, 0.3, 1.0));
  const Interface media{0, 0};
  if (between == Between::wall) add_shape(scene, square, Lambertian{Rgb(0.5f)}, &media);
  if (between == Between::boundary) add_shape(scene, square, Boundary{}, &media);
  scene.geometry.commit();
  finish(scene);
  return scene;
}

/// Meets the ray along x at x = 1 m: 0.5 m along a flight that comes from below, then 0.6 m along its scattered light.
PhotonPlane one_plane(float length) {
  const Vec3 scattered = glm::normalize(Vec3(0.1f, -1.0f, 0.3f)), direction = glm::normalize(Vec3(0.3f, 0.4f, 0.5f));
  const Vec3 crossing(1.0f, 0.0f, 0.0f);
  return {crossing - 0.6f * scattered - 0.5f * direction, length, direction, scattered, Rgb(3.0f, 2.0f, 1.0f)};
}

Rgb light_of(const Scene& scene, const PhotonPlane& plane, bool alone) {
  VolumeMapSettings maps;
  maps.gather = {.mode = GatherMode::photon_planes, .radius = kPlaneRadius};
  PhotonPlanes estimator(scene, make_transmittance_estimator({}), {.beams = {.maps = maps}, .alone = alone});
  const Recorders recorders = estimator.recorders();
  static_cast<PlaneRecorder*>(recorders.back())->planes[0] = {plane};
  RenderStatistics statistics;
  estimator.build(1, statistics);
  EyeCounters counters;
  EyeScratch scratch;
  Rng rng(1, 0, 0);
  EyeWork work{rng, counters, scratch};
  const EyeSegment segment(scene, {Vec3(0.0f), kEye}, {0.0f, 2.0f}, 0, Rgb(1.0f), {});
  return estimator.along(segment, work).value;
}

/// Its light, of all from planes, in a medium of that density everywhere.
Rgb by_hand(const Medium& medium, const PhotonPlane& plane, float density) {
  const Rgb sigma_s = medium.sigma_s * density, sigma_t = medium.sigma_t * density;
  const float determinant = std::abs(glm::dot(plane.direction, glm::cross(plane.scattered, kEye)));
  const Rgb come = glm::exp(-sigma_t * 0.5f);
  const Rgb weight = come / glm::dot(plane.power / sum_channels(plane.power), come);
  const float phase = phase_value(medium.phase, plane.scattered, -kEye);
  return plane.power * weight * sigma_s * sigma_s * glm::exp(-sigma_t * 1.6f) * phase / determinant;
}

TEST(PhotonPlanes, OnePlaneIsItsFactors) {
  for (const Rgb& sigma_t : {Rgb(0.7f), Rgb(0.2f, 1.0f, 3.0f)}) {
    Medium medium = make_medium(nullptr, sigma_t);
    medium.sigma_s = Rgb(0.9f, 0.5f, 0.1f) * sigma_t;
    medium.phase = HenyeyGreenstein{0.4f};
    const Scene scene = world_of(medium, Between::nothing);
    const Rgb found = light_of(scene, one_plane(0.51f), true), light = by_hand(medium, one_plane(0.51f), 1.0f);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], light[c], 1e-4f * light[c]);
    EXPECT_EQ(light_of(scene, one_plane(0.49f), true).g, 0.0f) << "the photon collides before";
  }
}

TEST(PhotonPlanes, ShareTheirLightWithBeams) {
  const Medium medium = make_medium(nullptr, Rgb(0.7f));
  const Scene scene = world_of(medium, Between::nothing);
  const PhotonPlane plane = one_plane(0.51f);
  const Rgb found = light_of(scene, plane, false), all = by_hand(medium, plane, 1.0f);
  const float determinant = std::abs(glm::dot(plane.direction, glm::cross(plane.scattered, kEye)));
  const float sine = glm::length(glm::cross(plane.scattered, kEye));
  const float beams = medium.sigma_s.g * kernel_size_1d(KernelKind::epanechnikov, kPlaneRadius) * sine;
  EXPECT_NEAR(found.g, all.g * determinant / (determinant + beams), 1e-4f * all.g);
}

TEST(PhotonPlanes, DoNotPassWalls) {
  const Medium medium = make_medium(nullptr, Rgb(0.7f));
  EXPECT_EQ(light_of(world_of(medium, Between::wall), one_plane(0.51f), true).g, 0.0f);
  const Rgb light = by_hand(medium, one_plane(0.51f), 1.0f);
  EXPECT_NEAR(light_of(world_of(medium, Between::boundary), one_plane(0.51f), true).g, light.g, 1e-4f * light.g);
}

}  // namespace
}  // namespace vpm
