// Surfaces as lights: each keeps its place and its outward normal.
#include "vpm/light/of_surface.h"

#include "vpm/base/error.h"
#include "vpm/base/overloads.h"

namespace vpm {

Light light_of(const SphereShape& sphere, const Rgb& radiance) {
  return SphereLight{sphere.center, sphere.radius, radiance};
}

Light light_of(const DiscShape& disc, const Rgb& radiance) {
  return DiscLight{disc.center, disc.normal, disc.radius, radiance};
}

/// The corner and the edges, in the order that keeps the normal: a mirror turns the triangles round.
Light light_of(const QuadMesh& quad, const Rgb& radiance) {
  const auto& p = quad.mesh.positions;
  if (p.size() != 4 || quad.mesh.triangles.empty() || quad.mesh.triangles[0].x != 0)
    throw InputError("quad: it must have the four vertices and the triangles that quad_mesh() gives it");
  const bool mirrored = quad.mesh.triangles[0].y > quad.mesh.triangles[0].z;
  const Vec3 u = p[1] - p[0], v = p[3] - p[0];
  return mirrored ? QuadLight{p[0], v, u, radiance} : QuadLight{p[0], u, v, radiance};
}

Light light_of(TriangleMesh mesh, const Rgb& radiance) {
  return MeshLight{std::make_shared<const EmittingMesh>(std::move(mesh)), radiance};
}

bool is_surface(const Light& light) {
  return std::visit(Overloads{[](const UnseenLight auto&) { return false; }, [](const AreaLight auto&) { return true; },
                              [](const DistantLight auto&) { return false; }, [](const VolumeLight&) { return false; }},
                    light);
}

}  // namespace vpm
