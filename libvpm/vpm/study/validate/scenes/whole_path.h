// Whole paths from a light to a camera, and the densities with which combined techniques find them: from the
// definitions and the vertices alone, without sub-paths.
#pragma once

#include <cmath>
#include <vector>

#include "vpm/integrators/combined/mis_weights.h"

namespace vpm {

/// A path from a light, vertex 0, to a camera, the last vertex, through any media.
struct WholePath {
  std::vector<Vec3> points;
  std::vector<PathVertex> vertices;  // numbered as the points; of the light and the camera, junctions alone
  std::vector<Rgb> transmittances;   // [i]: from point i to point i + 1
  std::vector<Phase> phases;         // of the vertices in media
  std::vector<double> refractions;   // of specular vertices: (n before / n behind)^2 along the light
  Light light = QuadLight{};
  double chosen = 0.3, camera_density = 7.0;

  size_t last() const { return points.size() - 1; }
  double square(size_t i) const {  // of the distance from point i to the next
    const Vec3d d = Vec3d(points[i + 1]) - Vec3d(points[i]);
    return glm::dot(d, d);
  }
  Vec3 direction(size_t i) const {  // from point i to the next
    return Vec3(glm::normalize(Vec3d(points[i + 1]) - Vec3d(points[i])));
  }
  Leg leg(size_t i) const { return {transmittances[i], std::sqrt(square(i))}; }
};

/// With `events` vertices between light and camera: on surfaces, some of them of rough glass, in chromatic media, and
/// specular.
WholePath random_path(Rng& rng, int events);

/// The densities with which a sub-path goes on at vertex i: along the light, and against it.
double density_on(const WholePath& path, size_t i, bool along_light);

/// Is a vertex the first from the eye that is not specular?
bool first_from_eye(const WholePath& path, size_t i);

/// A technique at a junction, and its density.
struct Found {
  enum class By { run_into, sampled, connected, splat, surface, points_3d, points_2d, short_beams };
  By by;
  size_t at;
  double density;
};

/// All densities, from the definitions: products over all vertices.
std::vector<Found> all_densities(const WholePath& path, const TechniqueCounts& counts);

}  // namespace vpm
