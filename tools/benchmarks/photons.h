// Photons uniform in the unit cube, places to look for them, and other libraries' indices of points.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "vpm/photon/photon.h"

namespace vpm::bench {

inline constexpr double kNeighbours = 50;

std::vector<Photon> random_photons(size_t count);
/// The radius of spheres that hold kNeighbours of them on average, m.
float neighbour_radius(size_t photons);
/// Uniform in the cube.
std::vector<Vec3> random_queries(size_t count);
/// In the order of their Morton codes: neighbours come one after another, as in a renderer's tiles.
std::vector<Vec3> morton_sorted(std::vector<Vec3> points);

/// Queries come by the list, so that the call through a table costs none of them.
class PointIndex {
 public:
  virtual ~PointIndex() = default;
  /// The sum of radius^2 - distance^2 over the points within `radius` of each query.
  virtual double sum_near(std::span<const Vec3> queries, float radius) const = 0;
  /// The sum of the queries' distances to the k-th nearest point. Not every index can.
  virtual double sum_nearest(std::span<const Vec3>, uint32_t) const { return 0.0; }
};

/// A kd-tree; null where nanoflann is not installed. Refers to the photons.
std::unique_ptr<PointIndex> make_nanoflann_index(const std::vector<Photon>& photons);
/// Embree's hierarchy of boxes over a point a primitive. Refers to the photons.
std::unique_ptr<PointIndex> make_embree_index(const std::vector<Photon>& photons);

}  // namespace vpm::bench
