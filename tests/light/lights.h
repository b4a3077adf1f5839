// The lights that the tests of this folder share: one of each kind, chromatic, off the axes.
#pragma once

#include <vector>

#include "vpm/base/rng.h"
#include "vpm/light/light.h"

namespace vpm {

inline Rng test_rng(uint64_t index) { return {7, static_cast<uint64_t>(RngUse::test), index}; }

inline const Box kScene{{-1.5f, -3.0f, -1.0f}, {2.5f, 2.5f, 3.0f}};

/// 8 x 4 texels of unequal brightness and colour, some black.
inline EnvironmentMap test_map() {
  std::vector<Rgb> texels;
  for (int i = 0; i < 32; ++i) {
    const float brightness = i % 5 == 0 ? 0.0f : static_cast<float>((7 * i) % 11) + 0.5f;
    texels.push_back(brightness * Rgb(1.0f, 0.25f + 0.02f * static_cast<float>(i), 0.5f));
  }
  return {std::make_shared<const ImageEnvironment>(8, 4, texels)};
}

/// A tetrahedron of four unequal faces.
inline TriangleMesh test_tetrahedron() {
  return {{{0.0f, 1.0f, 0.0f}, {1.2f, 1.1f, 0.2f}, {0.3f, 2.0f, 0.1f}, {0.2f, 1.2f, 0.9f}},
          {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
}

inline std::vector<Light> test_lights() {
  const Vec3 axis = glm::normalize(Vec3(0.2f, -0.9f, 0.3f));
  const Rgb colour(3.0f, 2.0f, 0.5f);
  return {PointLight{{0.3f, 1.0f, 0.2f}, colour},
          SpotLight{{0.0f, 1.5f, 0.0f}, axis, 0.95f, 0.7f, colour},
          BeamLight{{-0.1f, 1.5f, -0.2f}, axis, 0.8f, colour},
          QuadLight{{-0.5f, 1.2f, -0.6f}, {1.0f, 0.1f, 0.0f}, {0.3f, 0.2f, 1.1f}, colour},
          QuadLight{{-0.5f, -1.2f, -0.6f}, {0.3f, 0.2f, 1.1f}, {1.0f, 0.1f, 0.0f}, colour},
          DiscLight{{-0.3f, 1.4f, 0.2f}, axis, 0.5f, colour},
          SphereLight{{0.2f, 1.3f, 0.1f}, 0.7f, colour},
          MeshLight{std::make_shared<const EmittingMesh>(test_tetrahedron()), colour},
          DirectionalLight{axis, colour},
          ConstantEnvironment{colour},
          test_map()};
}

}  // namespace vpm
