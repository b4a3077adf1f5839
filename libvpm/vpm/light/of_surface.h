// Which light a surface is once it emits.
#pragma once

#include "vpm/light/light.h"
#include "vpm/surface/mesh.h"

namespace vpm {

/// The light that a surface of that radiance is, W/(m^2 sr). Throws InputError where no triangle of a mesh has an area,
/// and for a quad that has not the four vertices of quad_mesh().
Light light_of(const SphereShape& sphere, const Rgb& radiance);
Light light_of(const DiscShape& disc, const Rgb& radiance);
Light light_of(const QuadMesh& quad, const Rgb& radiance);
Light light_of(TriangleMesh mesh, const Rgb& radiance);

/// Is the light a surface that emits?
bool is_surface(const Light& light);

}  // namespace vpm
