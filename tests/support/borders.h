// Shares of kernels that planes cut off, by adding up small cubes: what regions are compared with.
#pragma once

#include "vpm/base/rng.h"
#include "vpm/base/warp.h"
#include "vpm/estimate/kernel_sum.h"
#include "vpm/surface/geometry.h"

namespace vpm {

/// The integral of the kernel of radius 1 over where each of the first `Dimension` coordinates is at most `walls` says:
/// planes across the axes. To about 1e-3.
template <int Dimension>
double share_before_walls(KernelKind kernel, const Vec3& walls) {
  constexpr int kCells = Dimension == 2 ? 600 : 120;  // along an edge
  constexpr float kCell = 2.0f / kCells;
  const auto middle = [&](int i) { return (static_cast<float>(i) + 0.5f) * kCell - 1.0f; };
  return with_kernel<Dimension>(kernel, [&](auto profile) {
    double sum = 0.0;
    for (int z = 0; z < (Dimension == 2 ? 1 : kCells); ++z)
      for (int y = 0; y < kCells; ++y)
        for (int x = 0; x < kCells; ++x) {
          const Vec3 p(middle(x), middle(y), Dimension == 2 ? 0.0f : middle(z));
          const bool before = p.x <= walls.x && p.y <= walls.y && (Dimension == 2 || p.z <= walls.z);
          if (before && glm::dot(p, p) < 1.0f) sum += profile(glm::dot(p, p));
        }
    return sum * std::pow(double{kCell}, Dimension) * kernel_norm<Dimension>(kernel, 1.0f);
  });
}

/// A rotation that is none about an axis.
inline glm::mat3 some_rotation(Rng& rng) {
  const Vec3 n = uniform_sphere(rng.uniform2());
  Vec3 s, t;
  make_frame(n, s, t);
  const float phi = 2.0f * kPi * rng.uniform();
  return {std::cos(phi) * s + std::sin(phi) * t, std::cos(phi) * t - std::sin(phi) * s, n};
}

inline TriangleMesh turned(TriangleMesh mesh, const glm::mat3& rotation) {
  for (Vec3& p : mesh.positions) p = rotation * p;
  return mesh;
}

}  // namespace vpm
