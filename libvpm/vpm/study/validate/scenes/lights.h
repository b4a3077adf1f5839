// The lights that are tested: chromatic, off the axes.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "vpm/light/light.h"

namespace vpm {

inline const Vec3 kAxis = glm::normalize(Vec3(0.2f, -0.9f, 0.3f));
inline const Rgb kColour(3.0f, 2.0f, 0.5f);
inline const Box kLitBox{{-2.5f, -3.5f, -1.0f}, {3.5f, 1.5f, 3.0f}};

inline QuadLight test_quad() { return {{-0.5f, 1.2f, -0.6f}, {1.0f, 0.1f, 0.0f}, {0.3f, 0.2f, 1.1f}, kColour}; }
inline DiscLight test_disc() { return {{-0.4f, 1.3f, 0.2f}, kAxis, 0.6f, kColour}; }
/// A tetrahedron of four unequal faces, and a triangle without area among them.
inline TriangleMesh test_tetrahedron() {
  return {{{0.0f, 1.0f, 0.0f}, {1.2f, 1.1f, 0.2f}, {0.3f, 2.0f, 0.1f}, {0.2f, 1.2f, 0.9f}},
          {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}, {0, 1, 1}}};  // each face without the vertex of its number
}
inline SphereLight test_sphere() { return {{0.2f, 1.3f, 0.1f}, 0.7f, kColour}; }

/// A picture of 8 x 4 radiances of unequal brightness and colour, with the geometry of its texels by their definition.
struct TexelMap {
  static constexpr size_t kWidth = 8, kHeight = 4;
  std::vector<Rgb> texels;  // W/(m^2 sr), rows from +y down, columns from -z over +x

  EnvironmentMap light() const {
    return {std::make_shared<const ImageEnvironment>(static_cast<int>(kWidth), static_cast<int>(kHeight), texels)};
  }
  /// The angle from +y at which a row begins.
  static double fall(size_t row) { return kPiD * static_cast<double>(row) / kHeight; }
  /// sr.
  static double solid_angle(size_t texel) {
    const size_t row = texel / kWidth;
    return 2.0 * kPiD / kWidth * (std::cos(fall(row)) - std::cos(fall(row + 1)));
  }
  static size_t texel_at(const Vec3& d) {
    const double turn = 0.5 - std::atan2(double{d.x}, double{d.z}) / (2.0 * kPiD), fall = std::acos(double{d.y}) / kPiD;
    const auto column = static_cast<size_t>(turn * kWidth) % kWidth;
    return std::min(static_cast<size_t>(fall * kHeight), kHeight - 1) * kWidth + column;
  }
};

inline TexelMap test_map() {
  TexelMap map;
  for (int i = 0; i < 32; ++i) {
    const float brightness = static_cast<float>((7 * i) % 11) + 0.5f;
    map.texels.push_back(brightness * Rgb(1.0f, 0.25f + 0.02f * static_cast<float>(i), 0.5f));
  }
  return map;
}

}  // namespace vpm
