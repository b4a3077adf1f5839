// The ball's image by the distance of rays from its centre, tabulated.
#include "study/compare/exact_picture.h"

#include <fmt/format.h>

#include "base/error.h"
#include "base/parallel.h"
#include "study/exact/sphere.h"

namespace vpm {
namespace {

[[noreturn]] void refuse(const char* what) {
  throw InputError(
      fmt::format("no exact picture is known of this scene: {}; known is that of a ball of homogeneous, isotropic fog "
                  "in vacuum, with a constant environment for its only light",
                  what));
}

void check(const Scene& scene) {
  if (scene.shapes.size() != 1) refuse("it has not one shape");
  const bool round = scene.geometry.triangle_count(0) == 0 && scene.geometry.has_uvs(0);
  if (!round) refuse("its shape is no sphere");
  if (!is_boundary(scene.materials[scene.shapes[0].material])) refuse("its sphere is no boundary of a medium");
  const Interface& media = scene.shapes[0].media;
  if (media.inside == kVacuum || media.outside != kVacuum) refuse("its sphere does not hold fog in vacuum");
  const Medium& fog = scene.media[media.inside];
  if (!fog.homogeneous()) refuse("its medium is a grid");
  if (!std::holds_alternative<Isotropic>(fog.phase)) refuse("its medium does not scatter isotropically");
  if (scene.camera_medium != kVacuum) refuse("its camera stands in the medium");
  if (scene.lights.size() != 1 || !std::holds_alternative<ConstantEnvironment>(scene.lights[0]))
    refuse("its light is no constant environment");
}

/// The ball's image in one channel, over the environment's radiance.
class BallImage {
 public:
  BallImage(double optical_radius, double albedo) {
    if (optical_radius == 0.0) return;
    std::vector<double> impacts;
    for (int i = 0; i <= kNodes; ++i) {
      const double cosine = static_cast<double>(i) / kNodes;
      impacts.push_back(std::sqrt((1.0 - cosine) * (1.0 + cosine)));
    }
    values_ = exact::solve_sphere(optical_radius, albedo, {}, impacts).image.values;
  }

  /// Along a ray that meets the ball's surface at that cosine to its normal: smooth in it, where in the distance from
  /// the centre it is not.
  double at(double cosine) const {
    const double x = cosine * kNodes;
    const int i = std::min(static_cast<int>(x), kNodes - 1);
    return values_[i] + (x - i) * (values_[i + 1] - values_[i]);
  }

 private:
  static constexpr int kNodes = 1024;
  std::vector<double> values_ = std::vector<double>(kNodes + 1, 1.0);
};

/// The cosine at which a ray meets a sphere; 0 where it passes by.
double meeting_cosine(const Ray& ray, const Vec3d& centre, double radius) {
  const Vec3d to_centre = centre - Vec3d(ray.origin), d(ray.direction);
  const double impact = glm::length(glm::cross(to_centre, d)) / radius;
  return impact < 1.0 && glm::dot(to_centre, d) > 0.0 ? std::sqrt((1.0 - impact) * (1.0 + impact)) : 0.0;
}

}  // namespace

Image exact_picture(const Scene& scene) {
  check(scene);
  const Box& box = scene.geometry.bounds(0);
  const Vec3d centre = 0.5 * (Vec3d(box.lo) + Vec3d(box.hi));
  const double radius = 0.5 * (static_cast<double>(box.hi.x) - box.lo.x);
  const Medium& fog = scene.media[scene.shapes[0].media.inside];
  std::vector<BallImage> channels;
  for (int c = 0; c < 3; ++c) channels.emplace_back(fog.sigma_t[c] * radius, fog.albedo()[c]);
  const Rgbd environment(std::get<ConstantEnvironment>(scene.lights[0]).radiance);
  constexpr int kAlong = 16;  // rays along each side of a pixel
  const Camera& camera = scene.camera;
  Image image(camera.width, camera.height);
  parallel_for_chunks(image.pixels.size(), 64, [&](size_t begin, size_t end, size_t) {
    for (size_t pixel = begin; pixel < end; ++pixel) {
      const Vec2 middle = Vec2(pixel % camera.width, pixel / camera.width) + 0.5f;
      Rgbd sum(0.0);
      for (int i = 0; i < kAlong * kAlong; ++i) {
        const Vec2 u = (Vec2(i % kAlong, i / kAlong) + 0.5f) / static_cast<float>(kAlong);
        const Ray ray = camera.ray(middle + sample_filter(camera.filter, u));
        const double cosine = meeting_cosine(ray, centre, radius);
        for (int c = 0; c < 3; ++c) sum[c] += channels[c].at(cosine);
      }
      image.pixels[pixel] = Rgb(environment * sum / static_cast<double>(kAlong * kAlong));
    }
  });
  return image;
}

}  // namespace vpm
