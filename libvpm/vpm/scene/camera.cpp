// The perspective camera, and sampling of the pixel filters: each is a product of two equal curves, inverted exactly.
#include "vpm/scene/camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "vpm/base/error.h"

namespace vpm {

Ray Camera::ray(const Vec2& film) const {
  const auto w = static_cast<float>(width), h = static_cast<float>(height);
  const float x = (2.0f * film.x - w) / h * tan_half_fov;  // square pixels
  const float y = (h - 2.0f * film.y) / h * tan_half_fov;
  return {position, glm::normalize(forward + x * right + y * up)};
}

std::optional<Vec2> Camera::film_of(const Vec3& towards) const {
  const float ahead = glm::dot(towards, forward);
  if (!(ahead > 0.0f)) return std::nullopt;
  const auto w = static_cast<float>(width), h = static_cast<float>(height);
  const float x = glm::dot(towards, right) / (ahead * tan_half_fov), y = glm::dot(towards, up) / (ahead * tan_half_fov);
  return Vec2(0.5f * (x * h + w), 0.5f * (h - y * h));
}

double Camera::film_per_angle(const Vec3& towards) const {
  const double ahead = glm::dot(towards, forward), scale = 0.5 * height / tan_half_fov;
  return scale * scale / (ahead * ahead * ahead);
}

Camera make_camera(const Vec3& position, const Vec3& target, const Vec3& up, float fov, const FilmFormat& film) {
  const auto& [width, height, filter, crop] = film;
  if (!is_finite(position) || !is_finite(target) || !is_finite(up))
    throw InputError("camera: a coordinate is not finite");
  if (!(fov > 0.0f && fov < 180.0f)) {
    throw InputError("camera: the field of view is " + std::to_string(fov) + " degrees, it must lie between 0 and 180");
  }
  if (std::min(width, height) < 1 || std::max(width, height) > kLargestFilm) {
    throw InputError(
        fmt::format("camera: the film has {} x {} pixels, each side must have 1 to {}", width, height, kLargestFilm));
  }
  if (crop && !lies_in(*crop, width, height)) throw InputError("camera: the crop is empty, or not inside the film");
  if (!(filter.radius > 0.0f) || std::isinf(filter.radius))
    throw InputError("camera: the filter's radius must be positive");
  const Vec3d ahead = Vec3d(target) - Vec3d(position);
  if (ahead == Vec3d(0.0)) throw InputError("camera: the target is the position, it must lie ahead of it");
  const Vec3d forward = glm::normalize(ahead);
  const Vec3d across = glm::cross(forward, Vec3d(up));
  if (!(glm::length(across) > 1e-6 * glm::length(Vec3d(up)))) {
    throw InputError("camera: up is 0 or along the line of sight, it must point to a side of it");
  }
  Camera camera;
  camera.position = position;
  camera.forward = Vec3(forward);
  camera.right = Vec3(glm::normalize(across));
  camera.up = Vec3(glm::cross(glm::normalize(across), forward));
  camera.tan_half_fov = static_cast<float>(std::tan(glm::radians(0.5 * fov)));
  camera.width = width;
  camera.height = height;
  camera.filter = filter;
  camera.crop = crop;
  return camera;
}

namespace {

/// An offset in [-1, 1] with density 1 - |x|.
float sample_tent(float u) { return u < 0.5f ? std::sqrt(2.0f * u) - 1.0f : 1.0f - std::sqrt(2.0f * (1.0f - u)); }

/// The x with erf(x) = y for 0 <= y <= erf(3 / sqrt 2). Newton's iteration: erf is concave there, so from y sqrt(pi) /
/// 2, which lies below x, every step goes up and none beyond x.
double inverse_erf(double y) {
  double x = 0.5 * std::sqrt(kPiD) * y;
  for (double step = 1.0; step > 1e-12;) {
    step = 0.5 * std::sqrt(kPiD) * std::exp(x * x) * (y - std::erf(x));
    x += step;
  }
  return x;
}

/// An offset in [-1, 1] with a normal density of standard deviation 1/3, cut off at 1.
float sample_gaussian(float u) {
  static const double kEdge = std::erf(3.0 / std::sqrt(2.0));
  const double y = (2.0 * u - 1.0) * kEdge;
  return static_cast<float>(std::copysign(inverse_erf(std::abs(y)) * std::sqrt(2.0) / 3.0, y));
}

float sample_curve(FilterKind kind, float u) {
  switch (kind) {
    case FilterKind::box:
      return 2.0f * u - 1.0f;
    case FilterKind::tent:
      return sample_tent(u);
    case FilterKind::gaussian:
      return sample_gaussian(u);
  }
  __builtin_unreachable();
}

/// The density of sample_curve() at x in [-1, 1].
double curve(FilterKind kind, double x) {
  static const double kGaussian = 3.0 / (std::sqrt(2.0 * kPiD) * std::erf(3.0 / std::sqrt(2.0)));
  switch (kind) {
    case FilterKind::box:
      return 0.5;
    case FilterKind::tent:
      return 1.0 - std::abs(x);
    case FilterKind::gaussian:
      return kGaussian * std::exp(-4.5 * x * x);
  }
  __builtin_unreachable();
}

}  // namespace

double filter_value(const Filter& filter, const Vec2& offset) {
  const Vec2 at = offset / filter.radius;
  if (std::max(std::abs(at.x), std::abs(at.y)) > 1.0f) return 0.0;
  return curve(filter.kind, at.x) * curve(filter.kind, at.y) / (double{filter.radius} * filter.radius);
}

Vec2 sample_filter(const Filter& filter, const Vec2& u) {
  return filter.radius * Vec2(sample_curve(filter.kind, u.x), sample_curve(filter.kind, u.y));
}

}  // namespace vpm
