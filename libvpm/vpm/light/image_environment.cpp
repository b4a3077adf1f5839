// Directions and places in pictures of the sky.
#include "vpm/light/image_environment.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>

#include "vpm/base/error.h"
#include "vpm/image/metrics.h"

namespace vpm {
namespace {

using Vec2d = glm::dvec2;

void check_texels(int width, int height, const std::vector<Rgb>& texels) {
  if (width < 1 || height < 1 || texels.size() != static_cast<size_t>(width) * static_cast<size_t>(height))
    throw InputError("environment: " + std::to_string(texels.size()) + " texels for a picture of " +
                     std::to_string(width) + " x " + std::to_string(height));
  for (size_t i = 0; i < texels.size(); ++i) {
    const Rgb& c = texels[i];
    if (is_finite(c) && c.r >= 0.0f && c.g >= 0.0f && c.b >= 0.0f) continue;
    const size_t w = static_cast<size_t>(width);
    throw InputError("environment: the pixel in column " + std::to_string(i % w) + ", row " + std::to_string(i / w) +
                     " is negative or not finite, radiance must be finite and at least 0");
  }
}

/// The place of a direction in a picture by latitude and longitude.
Vec2d equirectangular_place(const Vec3d& d) {
  const double u = 0.5 - std::atan2(d.x, d.z) / (2.0 * kPiD);
  return {u < 1.0 ? u : 0.0, std::atan2(std::hypot(d.x, d.z), d.y) / kPiD};  // exact at the poles, unlike acos
}

/// The place of a direction in a square of equal areas [Clarberg2008].
Vec2d equal_area_place(const Vec3d& d) {
  const Vec3d size = glm::abs(d);
  const double across2 = d.x * d.x + d.y * d.y, larger = std::max(size.x, size.y);
  const double r = std::sqrt(across2 / (glm::length(d) + size.z) / glm::length(d));  // sqrt(1 - |z|), not cancelled
  const double part = larger > 0.0 ? std::atan(std::min(size.x, size.y) / larger) * 2.0 / kPiD : 0.0;
  Vec2d p;
  p.y = r * (size.x < size.y ? 1.0 - part : part);
  p.x = r - p.y;
  if (d.z < 0.0) p = {1.0 - p.y, 1.0 - p.x};
  return 0.5 + 0.5 * Vec2d(std::copysign(p.x, d.x), std::copysign(p.y, d.y));
}

Vec3d equal_area_direction(const Vec2d& place) {
  const Vec2d p = 2.0 * place - 1.0;
  const double from_edge = 1.0 - (std::abs(p.x) + std::abs(p.y)), r = 1.0 - std::abs(from_edge);
  const double phi = (r > 0.0 ? (std::abs(p.y) - std::abs(p.x)) / r + 1.0 : 1.0) * kPiD / 4.0;
  const double across = r * std::sqrt(2.0 - r * r);
  return {std::copysign(across * std::cos(phi), p.x), std::copysign(across * std::sin(phi), p.y),
          std::copysign(1.0 - r * r, from_edge)};
}

}  // namespace

ImageEnvironment::ImageEnvironment(int width, int height, std::vector<Rgb> texels, SkyMapping mapping,
                                   const Mat3d& rotation)
    : width_(width), height_(height), mapping_(mapping), rotation_(rotation), texels_(std::move(texels)) {
  check_texels(width, height, texels_);
  if (mapping == SkyMapping::equal_area && width != height)
    throw InputError("environment: a picture of equal areas is a square, and this one has " + std::to_string(width) +
                     " x " + std::to_string(height) + " pixels");
  cumulative_.reserve(texels_.size() + 1);
  cumulative_.push_back(0.0);
  for (int row = 0; row < height; ++row) {
    const double angle = solid_angle(row);
    for (int column = 0; column < width; ++column) {
      const Rgb& texel = texels_[cumulative_.size() - 1];
      cumulative_.push_back(cumulative_.back() + luminance(texel) * angle);
      if (is_black(texel)) continue;
      integral_ += Rgbd(texel) * angle;
      const Vec3d cosines = mean_cosines(column, row);
      for (int axis = 0; axis < 3; ++axis)
        flux_across_[static_cast<size_t>(axis)] += Rgbd(texel) * (angle * cosines[axis]);
    }
  }
  grey_ = std::all_of(texels_.begin(), texels_.end(), [](const Rgb& c) { return is_grey(c); });
  if (!(cumulative_.back() > 0.0))
    throw InputError("environment: the picture is all black, some pixel must emit light");
}

/// Of one texel of a row, sr. By latitude it is the azimuth's share times the difference of the cosines of its edges,
/// which is 2 sin(middle) sin(half) and so does not cancel.
double ImageEnvironment::solid_angle(int row) const {
  if (mapping_ == SkyMapping::equal_area) return 4.0 * kPiD / (double(width_) * height_);
  const double step = kPiD / height_;
  return 2.0 * kPiD / width_ * 2.0 * std::sin((row + 0.5) * step) * std::sin(0.5 * step);
}

/// A direction of the scene in a texel, uniform in solid angle by two uniform numbers.
Vec3d ImageEnvironment::direction_in(int column, int row, double u, double v) const {
  if (mapping_ == SkyMapping::equal_area)
    return rotation_ * equal_area_direction({(column + u) / width_, (row + v) / height_});
  const double step = kPiD / height_, longitude = kPiD - 2.0 * kPiD * (column + u) / width_;
  const double top = std::cos(row * step), bottom = std::cos((row + 1.0) * step);
  const double y = top + (bottom - top) * v;
  const double across = std::sqrt(std::max(0.0, (1.0 - y) * (1.0 + y)));
  return rotation_ * Vec3d(across * std::sin(longitude), y, across * std::cos(longitude));
}

/// Of |cosine| to the axes over a texel: the midpoint rule, at half a million places of all texels.
Vec3d ImageEnvironment::mean_cosines(int column, int row) const {
  constexpr int kColumns = 1024, kRows = 512, kMost = 1 << 24;
  const int across = std::max(1, kColumns / width_);
  const int down = std::max(1, std::min(kRows / height_, kMost / (width_ * across)));
  Vec3d sum(0.0);
  for (int i = 0; i < across; ++i)
    for (int j = 0; j < down; ++j) sum += glm::abs(direction_in(column, row, (i + 0.5) / across, (j + 0.5) / down));
  return sum / (double(across) * down);
}

size_t ImageEnvironment::texel_at(const Vec3& direction) const {
  const Vec3d d = Vec3d(direction) * rotation_;  // by the transpose
  const Vec2d place = mapping_ == SkyMapping::equal_area ? equal_area_place(d) : equirectangular_place(d);
  const int column = std::min(static_cast<int>(place.x * width_), width_ - 1);
  const int row = std::min(static_cast<int>(place.y * height_), height_ - 1);
  return static_cast<size_t>(row) * static_cast<size_t>(width_) + static_cast<size_t>(column);
}

float ImageEnvironment::pdf(const Vec3& d) const {
  return static_cast<float>(luminance(texels_[texel_at(d)]) / cumulative_.back());
}

ImageEnvironment::Sample ImageEnvironment::sample(double choice, const Vec2& u) const {
  const double target = choice * cumulative_.back();
  const auto above = std::upper_bound(cumulative_.begin() + 1, cumulative_.end(), target);
  assert(above != cumulative_.end());
  const auto texel = static_cast<size_t>(above - cumulative_.begin() - 1);
  const size_t width = static_cast<size_t>(width_);
  const Vec3 direction(direction_in(static_cast<int>(texel % width), static_cast<int>(texel / width), u.x, u.y));
  return {direction, static_cast<float>(luminance(texels_[texel]) / cumulative_.back()), texels_[texel]};
}

}  // namespace vpm
