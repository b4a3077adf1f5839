// The ball's image by the distance of rays from its center, tabulated.
#include "vpm/study/compare/exact_picture.h"

#include <fmt/format.h>
#include <array>

#include "vpm/base/error.h"
#include "vpm/base/parallel.h"
#include "vpm/study/exact/sphere.h"

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
  if (!scene.geometry.sphere(0)) refuse("its shape is no sphere");
  if (!is_boundary(scene.materials[scene.shapes[0].material])) refuse("its sphere is no boundary of a medium");
  const Interface& media = scene.shapes[0].media;
  if (media.inside == kVacuum || media.outside != kVacuum) refuse("its sphere does not hold fog in vacuum");
  const Medium& fog = scene.media[media.inside];
  if (!fog.homogeneous()) refuse("its medium is a grid");
  if (!std::holds_alternative<Isotropic>(fog.phase)) refuse("its medium does not scatter isotropically");
  if (scene.camera_medium != kVacuum) refuse("its camera stands in the medium");
  if (scene.lights.size() != 1 || !even_radiance(scene.lights[0])) refuse("its light is no constant environment");
}

/// The ball's image in one channel, over the environment's radiance.
class BallImage {
 public:
  BallImage(double optical_radius, double albedo) {
    if (optical_radius == 0.0) return;
    std::vector<double> impacts;
    for (int i = 0; i <= kNodes; ++i) {
      const double cosine = std::pow(static_cast<double>(i) / kNodes, 2.0);
      impacts.push_back(std::sqrt((1.0 - cosine) * (1.0 + cosine)));
    }
    exact::BoundedSeries image = exact::solve_sphere(optical_radius, albedo, {}, impacts).image;
    if (image.error > kMostError) refuse("its ball is too thick to be solved");
    values_ = std::move(image.values);
    values_.push_back(2.0 * values_[kNodes] - values_[kNodes - 1]);
  }

  /// Along a ray that meets the ball's surface at that cosine to its normal. Cubic [Catmull1974] in the cosine's root,
  /// of which the image is an even, smooth function: thick balls change near their rim alone.
  double at(double cosine) const {
    const double x = std::sqrt(cosine) * kNodes;
    const int i = std::min(static_cast<int>(x), kNodes - 1);
    const double t = x - i, before = values_[i > 0 ? i - 1 : 1], *v = &values_[i];
    return v[0] + 0.5 * t *
                      (v[1] - before +
                       t * (2.0 * before - 5.0 * v[0] + 4.0 * v[1] - v[2] + t * (3.0 * (v[0] - v[1]) + v[2] - before)));
  }

 private:
  static constexpr int kNodes = 128;
  static constexpr double kMostError = 1e-6;
  std::vector<double> values_ = std::vector<double>(kNodes + 2, 1.0);  // one beyond the last
};

/// The ball as the camera sees it.
struct Ball {
  Vec3d center;                     // m
  double radius;                    // m
  std::array<BallImage, 3> images;  // by channel

  explicit Ball(const Scene& scene)
      : center(scene.geometry.sphere(0)->center),
        radius(scene.geometry.sphere(0)->radius),
        images(images_of(scene.media[scene.shapes[0].media.inside], radius)) {}

  /// The cosine at which a ray meets the ball; 0 where it passes by.
  double meeting_cosine(const Ray& ray) const {
    const Vec3d to_center = center - Vec3d(ray.origin), d(ray.direction);
    const double impact = glm::length(glm::cross(to_center, d)) / radius;
    return impact < 1.0 && glm::dot(to_center, d) > 0.0 ? std::sqrt((1.0 - impact) * (1.0 + impact)) : 0.0;
  }

 private:
  static std::array<BallImage, 3> images_of(const Medium& fog, double radius) {
    const auto image = [&](int c) { return BallImage(fog.sigma_t[c] * radius, fog.albedo()[c]); };
    const BallImage red = image(0);
    if (fog.grey()) return {red, red, red};
    return {red, image(1), image(2)};
  }
};

/// The mean of the image over a pixel, by `along` rays along each side of its filter. `rim` becomes whether some of
/// these pass the ball by and others meet it.
Rgbd pixel_mean(const Ball& ball, const Camera& camera, size_t pixel, int along, bool& rim) {
  const Vec2 middle = Vec2(pixel % camera.width, pixel / camera.width) + 0.5f;
  Rgbd sum(0.0);
  int met = 0;
  for (int i = 0; i < along * along; ++i) {
    const Vec2 u = (Vec2(i % along, i / along) + 0.5f) / static_cast<float>(along);
    const double cosine = ball.meeting_cosine(camera.ray(middle + sample_filter(camera.filter, u)));
    met += cosine > 0.0;
    for (int c = 0; c < 3; ++c) sum[c] += ball.images[c].at(cosine);
  }
  rim = met > 0 && met < along * along;
  return sum / static_cast<double>(along * along);
}

}  // namespace

Image exact_picture(const Scene& scene) {
  constexpr int kRays = 16, kRaysAtRim = 256;  // along each side of a pixel
  check(scene);
  const Ball ball(scene);
  const Camera& camera = scene.camera;
  const Rgbd environment(*even_radiance(scene.lights[0]));
  Image image(camera.width, camera.height);
  parallel_for_chunks(image.pixels.size(), 64, [&](size_t begin, size_t end, size_t) {
    for (size_t pixel = begin; pixel < end; ++pixel) {
      bool rim = false;
      Rgbd mean = pixel_mean(ball, camera, pixel, kRays, rim);
      if (rim) mean = pixel_mean(ball, camera, pixel, kRaysAtRim, rim);
      image.pixels[pixel] = Rgb(environment * mean);
    }
  });
  return image;
}

}  // namespace vpm
