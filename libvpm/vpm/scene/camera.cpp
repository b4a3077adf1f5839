// The perspective camera.
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

}  // namespace vpm
