// Parallel light, and light from infinity: where it enters the scene, beams, one direction, and all directions, of one
// radiance or by an equirectangular picture.
#include <algorithm>
#include <cassert>
#include <string>

#include "vpm/base/error.h"
#include "vpm/base/warp.h"
#include "vpm/image/metrics.h"
#include "vpm/light/kinds.h"

namespace vpm {

// Where light from infinity enters the scene: the box around it, by the area that the box shows to each direction.
Vec3d face_areas(const Box& box) {
  const Vec3d e(box.extent());
  return {e.y * e.z, e.z * e.x, e.x * e.y};
}

double area_across(const Box& box, const Vec3& direction) {
  return glm::dot(glm::abs(Vec3d(direction)), face_areas(box));
}

int pick_axis(const Vec3d& weights, double choice) {
  const double target = choice * (weights.x + weights.y + weights.z);
  return target < weights.x ? 0 : target < weights.x + weights.y ? 1 : 2;
}

Vec3 point_on_face(const Box& box, int axis, bool upper, const Vec2& u) {
  Vec3 p;
  p[axis] = upper ? box.hi[axis] : box.lo[axis];
  for (const int k : {0, 1}) {
    const int along = (axis + 1 + k) % 3;
    p[along] = std::lerp(box.lo[along], box.hi[along], u[k]);
  }
  return p;
}

Ray ray_into(const Box& box, const Vec3& direction, const EmissionNumbers& u) {
  // The three faces that look against the direction hide nothing of each other.
  const int axis = pick_axis(glm::abs(Vec3d(direction)) * face_areas(box), u.face);
  return {point_on_face(box, axis, direction[axis] < 0.0f, u.place), direction};
}

Vec3 point_on_disc(const Vec3& centre, const Vec3& axis, float radius, const Vec2& u) {
  const Vec2 d = radius * uniform_disc(u);
  Vec3 s, t;
  make_frame(axis, s, t);
  return centre + d.x * s + d.y * t;
}

Rgb power_of(const BeamLight& light, const Box&) { return light.power; }

Emission emit_from(const BeamLight& light, const Box&, const EmissionNumbers& u) {
  return {Ray{point_on_disc(light.position, light.direction, light.radius, u.place), light.direction}, light.power};
}

std::optional<Incident> incident_from(const BeamLight& light, const Vec3& point, Rng&) {
  const Vec3 from_disc = point - light.position;
  const float ahead = glm::dot(from_disc, light.direction);
  if (!(ahead > 0.0f) || glm::length(from_disc - ahead * light.direction) > light.radius) return std::nullopt;
  return Incident{-light.direction, ahead, light.power / (kPi * light.radius * light.radius), 0.0f};
}

Rgb power_of(const DirectionalLight& light, const Box& scene) {
  return static_cast<float>(area_across(scene, light.direction)) * light.irradiance;
}

Emission emit_from(const DirectionalLight& light, const Box& scene, const EmissionNumbers& u) {
  return {ray_into(scene, light.direction, u), power_of(light, scene)};
}

std::optional<Incident> incident_from(const DirectionalLight& light, const Vec3&, Rng&) {
  return Incident{-light.direction, kInfinity, light.irradiance, 0.0f};
}

LightPlace place_of(const BeamLight& light) {
  return {{light.position - light.radius, light.position + light.radius}, light.position};
}

namespace {

/// The solid angle of one texel of a row, sr: the azimuth's share times the difference of the cosines of its edges,
/// which is 2 sin(middle) sin(half) and so does not cancel.
double texel_solid_angle(int row, int width, int height) {
  const double step = kPiD / height;
  return 2.0 * kPiD / width * 2.0 * std::sin((row + 0.5) * step) * std::sin(0.5 * step);
}

/// Integrals over the directions of a row of texels, or of a column, whose product is that of |cosine| to an axis over
/// a texel's solid angle: `up` for y, `along` and one of the column's for z and x.
struct RowShares {
  double up = 0.0, along = 0.0;
};
RowShares row_shares(double top, double bottom) {  // angles from +y
  const auto up = [](double angle) {               // |cos| sin, integrated from 0
    const double half_square = 0.5 * std::sin(angle) * std::sin(angle);
    return std::cos(angle) >= 0.0 ? half_square : 1.0 - half_square;
  };
  const auto along = [](double angle) { return 0.5 * (angle - std::sin(angle) * std::cos(angle)); };  // sin^2
  return {up(bottom) - up(top), along(bottom) - along(top)};
}
struct ColumnShares {
  double z = 0.0, x = 0.0;
};
ColumnShares column_shares(double begin, double end) {  // azimuths
  const auto sine = [](double angle) {                  // |sin|, integrated from 0
    const double halves = std::floor(angle / kPiD);
    return 2.0 * halves + 1.0 - std::cos(angle - halves * kPiD);
  };
  return {sine(end + 0.5 * kPiD) - sine(begin + 0.5 * kPiD), sine(end) - sine(begin)};
}

void check_texels(int width, int height, const std::vector<Rgb>& texels) {
  if (width < 1 || height < 1 || texels.size() != static_cast<size_t>(width) * static_cast<size_t>(height)) {
    throw InputError("environment: " + std::to_string(texels.size()) + " texels for a picture of " +
                     std::to_string(width) + " x " + std::to_string(height));
  }
  for (size_t i = 0; i < texels.size(); ++i) {
    const Rgb& c = texels[i];
    if (is_finite(c) && c.r >= 0.0f && c.g >= 0.0f && c.b >= 0.0f) continue;
    const size_t w = static_cast<size_t>(width);
    throw InputError("environment: the pixel in column " + std::to_string(i % w) + ", row " + std::to_string(i / w) +
                     " is negative or not finite, radiance must be finite and at least 0");
  }
}

}  // namespace

ImageEnvironment::ImageEnvironment(int width, int height, std::vector<Rgb> texels)
    : width_(width), height_(height), texels_(std::move(texels)) {
  check_texels(width, height, texels_);
  cumulative_.reserve(texels_.size() + 1);
  cumulative_.push_back(0.0);
  std::vector<ColumnShares> columns;
  const double turn = 2.0 * kPiD / width, fall = kPiD / height;
  for (int i = 0; i < width; ++i) columns.push_back(column_shares(i * turn, (i + 1) * turn));
  for (int row = 0; row < height; ++row) {
    const double solid_angle = texel_solid_angle(row, width, height);
    const RowShares shares = row_shares(row * fall, (row + 1) * fall);
    for (const ColumnShares& column : columns) {
      const Rgb& texel = texels_[cumulative_.size() - 1];
      cumulative_.push_back(cumulative_.back() + luminance(texel) * solid_angle);
      integral_ += Rgbd(texel) * solid_angle;
      flux_across_[0] += Rgbd(texel) * (shares.along * column.x);
      flux_across_[1] += Rgbd(texel) * (shares.up * turn);
      flux_across_[2] += Rgbd(texel) * (shares.along * column.z);
    }
  }
  grey_ = std::all_of(texels_.begin(), texels_.end(), [](const Rgb& c) { return is_grey(c); });
  if (!(cumulative_.back() > 0.0))
    throw InputError("environment: the picture is all black, some pixel must emit light");
}

size_t ImageEnvironment::texel_at(const Vec3& direction) const {
  const Vec3d d(direction);
  const double azimuth = std::atan2(d.x, d.z);
  const double turn = (azimuth < 0.0 ? azimuth + 2.0 * kPiD : azimuth) / (2.0 * kPiD);
  const double fall = std::atan2(std::hypot(d.x, d.z), d.y) / kPiD;  // 0 up, 1 down; exact at the poles, unlike acos
  const int column = std::min(static_cast<int>(turn * width_), width_ - 1);
  const int row = std::min(static_cast<int>(fall * height_), height_ - 1);
  return static_cast<size_t>(row) * static_cast<size_t>(width_) + static_cast<size_t>(column);
}

Rgb ImageEnvironment::radiance(const Vec3& d) const { return texels_[texel_at(d)]; }

float ImageEnvironment::pdf(const Vec3& d) const {
  return static_cast<float>(luminance(texels_[texel_at(d)]) / cumulative_.back());
}

ImageEnvironment::Sample ImageEnvironment::sample(double choice, const Vec2& u) const {
  const double target = choice * cumulative_.back();
  const auto above = std::upper_bound(cumulative_.begin() + 1, cumulative_.end(), target);
  assert(above != cumulative_.end());
  const auto texel = static_cast<size_t>(above - cumulative_.begin() - 1);
  const size_t width = static_cast<size_t>(width_), row_index = texel / width;
  const auto column = static_cast<double>(texel % width), row = static_cast<double>(row_index);
  // Uniform in solid angle: uniform in azimuth and in the cosine between the row's edges.
  const double step = kPiD / height_;
  const double azimuth = 2.0 * kPiD * (column + u.x) / width_;
  const double top = std::cos(row * step), bottom = std::cos((row + 1.0) * step);
  const double y = top + (bottom - top) * u.y;
  const double across = std::sqrt(std::max(0.0, (1.0 - y) * (1.0 + y)));
  const Vec3 direction(Vec3d(across * std::sin(azimuth), y, across * std::cos(azimuth)));
  return {direction, static_cast<float>(luminance(texels_[texel]) / cumulative_.back()), texels_[texel]};
}

Rgb power_of(const ConstantEnvironment& light, const Box& scene) {
  const Vec3d faces = face_areas(scene);
  return kPi * 2.0f * static_cast<float>(faces.x + faces.y + faces.z) * light.radiance;
}

Emission emit_from(const ConstantEnvironment& light, const Box& scene, const EmissionNumbers& u) {
  // Even light enters every part of the box's surface alike, by the cosine law.
  const bool upper = u.face >= 0.5;
  const int axis = pick_axis(face_areas(scene), 2.0 * u.face - (upper ? 1.0 : 0.0));
  Vec3 inward(0.0f);
  inward[axis] = upper ? -1.0f : 1.0f;
  const Vec3 from = point_on_face(scene, axis, upper, u.place);
  return {Ray{from, cosine_hemisphere(inward, u.direction)}, power_of(light, scene)};
}

std::optional<Incident> incident_from(const ConstantEnvironment& light, const Vec3&, Rng& rng) {
  return Incident{uniform_sphere(rng.uniform2()), kInfinity, 4.0f * kPi * light.radiance, 1.0f / (4.0f * kPi)};
}

Rgb power_of(const EnvironmentMap& light, const Box& scene) {
  const Vec3d faces = face_areas(scene);
  const auto& flux = light.image->flux_across();
  return Rgb(faces.x * flux[0] + faces.y * flux[1] + faces.z * flux[2]);
}

Emission emit_from(const EnvironmentMap& light, const Box& scene, const EmissionNumbers& u) {
  const ImageEnvironment::Sample s = light.image->sample(u.choice, u.direction);
  const auto area = static_cast<float>(area_across(scene, s.direction));
  return {ray_into(scene, -s.direction, u), area / s.pdf * s.radiance};
}

std::optional<Incident> incident_from(const EnvironmentMap& light, const Vec3&, Rng& rng) {
  const double choice = rng.uniform_double();
  const ImageEnvironment::Sample s = light.image->sample(choice, rng.uniform2());
  return Incident{s.direction, kInfinity, s.radiance / s.pdf, s.pdf};
}

float pdf_of(const ConstantEnvironment&, const Vec3&, const SeenLight&) { return 1.0f / (4.0f * kPi); }

float pdf_of(const EnvironmentMap& light, const Vec3&, const SeenLight& seen) {
  return light.image->pdf(seen.direction);
}

}  // namespace vpm
