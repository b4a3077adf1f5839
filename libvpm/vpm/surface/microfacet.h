// Microfacets: surfaces of small mirrors whose normals follow the distribution of Trowbridge and Reitz (GGX).
//
// Vectors point away from the surface and are in a frame whose z axis is its normal, on the side of the path.
#pragma once

#include "vpm/base/vec.h"

namespace vpm {

/// The distribution of roughness alpha [Walter2007, eq. 33] with Smith's masking and shadowing [Heitz2014].
class Microfacets {
 public:
  explicit Microfacets(float alpha) : alpha_(alpha) {}

  /// Area of facets of normal h over that of the surface, 1/sr, for h.z >= 0.
  float density(const Vec3& h) const {
    const float root = (h.x * h.x + h.y * h.y) / (alpha_ * alpha_) + h.z * h.z;
    return 1.0f / (kPi * alpha_ * alpha_ * root * root);
  }
  /// Share of the facets that face v and are seen from there, over |v.z|: G1 / |cos|, finite at grazing angles
  /// [Heitz2014, eq. 43, 72]. density() times it and the cosine of v to h is the density of visible normals.
  float masking(const Vec3& v) const { return 2.0f / (std::abs(v.z) + length(v)); }
  /// Share of the facets seen from both v and w, over |v.z w.z|: masking and shadowing of heights that are correlated
  /// [Heitz2014, eq. 99].
  float shadowing(const Vec3& v, const Vec3& w) const {
    return 2.0f / (length(v) * std::abs(w.z) + length(w) * std::abs(v.z));
  }
  /// A normal as seen from v, v.z >= 0 [Heitz2018]: seen from v, stretched until the facets are a hemisphere, normals
  /// half way between v and a point uniform on the cap of the sphere above -v are drawn right [Dupuy2023].
  Vec3 sample_visible(const Vec3& v, const Vec2& u) const {
    const Vec3 from = glm::normalize(Vec3(alpha_ * v.x, alpha_ * v.y, v.z));
    const float z = 1.0f - u.x * (1.0f + from.z), phi = 2.0f * kPi * u.y;
    const float r = std::sqrt(std::max(0.0f, (1.0f - z) * (1.0f + z)));
    const Vec3 half = from + Vec3(r * std::cos(phi), r * std::sin(phi), z);
    return glm::normalize(Vec3(alpha_ * half.x, alpha_ * half.y, std::max(0.0f, half.z)));
  }

 private:
  /// sqrt(cos^2 + alpha^2 sin^2), to which Smith's Lambda is related by 1 + Lambda = (1 + length / |cos|) / 2.
  float length(const Vec3& v) const { return std::sqrt(v.z * v.z + alpha_ * alpha_ * (v.x * v.x + v.y * v.y)); }

  float alpha_;
};

}  // namespace vpm
