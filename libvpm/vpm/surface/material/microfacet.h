// Microfacets: a surface made of small mirrors whose normals follow the distribution of Trowbridge and Reitz (GGX).
//
// Vectors point away from the surface. The z axis of their frame is the surface's normal on the side of the path.
#pragma once

#include "vpm/base/vec.h"

namespace vpm {

/// The distribution of roughness alpha [Walter2007, eq. 33] with Smith's masking and shadowing [Heitz2014].
class Microfacets {
 public:
  explicit Microfacets(float alpha) : alpha_(alpha) {}

  /// The area of facets with normal h, per area of the surface and per solid angle of h, 1/sr, for h.z >= 0.
  float density(const Vec3& h) const {
    const float root = (h.x * h.x + h.y * h.y) / (alpha_ * alpha_) + h.z * h.z;
    return 1.0f / (kPi * alpha_ * alpha_ * root * root);
  }
  /// G1 / |v.z|, where G1 is the fraction of the facets facing v that are visible from v; finite at grazing angles
  /// [Heitz2014, eq. 43, 72]. The density of visible normals is density() times masking() times the cosine of v to h.
  float masking(const Vec3& v) const { return 2.0f / (std::abs(v.z) + length(v)); }
  /// The fraction of the facets that are visible from both v and w, over |v.z w.z|: height-correlated masking and
  /// shadowing [Heitz2014, eq. 99].
  float shadowing(const Vec3& v, const Vec3& w) const {
    return 2.0f / (length(v) * std::abs(w.z) + length(w) * std::abs(v.z));
  }
  /// Draws a normal from those visible from v, v.z >= 0 [Heitz2018]. Space is stretched until the facets form a
  /// hemisphere. There the normal half way between v and a point drawn uniformly from the cap of the sphere above -v
  /// has the right distribution [Dupuy2023].
  Vec3 sample_visible(const Vec3& v, const Vec2& u) const {
    const Vec3 from = glm::normalize(Vec3(alpha_ * v.x, alpha_ * v.y, v.z));
    const float z = 1.0f - u.x * (1.0f + from.z), phi = 2.0f * kPi * u.y;
    const float r = std::sqrt(std::max(0.0f, (1.0f - z) * (1.0f + z)));
    const Vec3 half = from + Vec3(r * std::cos(phi), r * std::sin(phi), z);
    return glm::normalize(Vec3(alpha_ * half.x, alpha_ * half.y, std::max(0.0f, half.z)));
  }

 private:
  /// sqrt(cos^2 + alpha^2 sin^2). Smith's Lambda follows from it by 1 + Lambda = (1 + length / |cos|) / 2.
  float length(const Vec3& v) const { return std::sqrt(v.z * v.z + alpha_ * alpha_ * (v.x * v.x + v.y * v.y)); }

  float alpha_;
};

}  // namespace vpm
