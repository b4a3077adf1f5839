// A photon map of any photons, for who asks it about many points at once: how many are near, which, and estimates.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "vpm/photon/kernel.h"
#include "vpm/photon/map/nearest_map.h"
#include "vpm/photon/map/radius_map.h"

namespace vpm {

/// Numbers of photons, of each point in turn: those of point i are numbers[first[i]] to numbers[first[i + 1] - 1].
struct NearLists {
  std::vector<uint64_t> first;
  std::vector<uint32_t> numbers;
};

/// The k nearest photons of each point, nearest first: k numbers and k distances a point. Where there are fewer
/// photons, numbers are kNone and distances infinite.
struct NearestLists {
  static constexpr uint32_t kNone = ~uint32_t{0};
  std::vector<uint32_t> numbers;
  std::vector<float> distances;  // m
};

/// What is estimated at a point: on a surface of that normal the irradiance, W/m^2, by a disc of photons near its plane
/// that arrive on that side (Arrives); in a medium what is
/// scattered into a direction of travel, over the albedo, W/(m^3 sr), by a ball and Henyey-Greenstein's phase function;
/// or with neither, what collides, W/m^3. The vectors are unit, one for each point, or none.
struct EstimateOf {
  std::span<const Vec3> normals{}, directions{};
  float g = 0.0f;  // in (-1, 1)
};

/// Photons are numbered as they are given, from 0. Each query runs on all threads; several may run at once. The maps
/// are made when they are first needed, that of a radius anew for each other radius.
class PhotonQueries {
 public:
  explicit PhotonQueries(std::vector<Photon> photons) : photons_(std::move(photons)) {}

  size_t size() const { return photons_.size(); }
  /// How many photons are nearer to each point than `radius`, m, > 0.
  std::vector<uint32_t> count_within(std::span<const Vec3> points, float radius) const;
  /// Which ones, in rising order.
  NearLists within(std::span<const Vec3> points, float radius) const;
  /// The `count` >= 1 nearest.
  NearestLists nearest(std::span<const Vec3> points, uint32_t count) const;
  /// Sums of powers times kernel, as renders make them: directions and powers are those of maps (PackedDirection,
  /// PackedPower).
  std::vector<Rgb> estimate(std::span<const Vec3> points, float radius, KernelKind kernel, const EstimateOf& of) const;

 private:
  /// A map, and the number of each photon in it.
  template <class Map>
  struct Sorted {
    Map map;
    std::vector<uint32_t> numbers;
    float radius = 0.0f;  // that it was made for
  };
  std::shared_ptr<const Sorted<RadiusMap>> map_of(float radius) const;
  std::shared_ptr<const Sorted<NearestMap>> nearest_map() const;

  std::vector<Photon> photons_;
  mutable std::mutex making_;
  mutable std::shared_ptr<const Sorted<RadiusMap>> of_radius_;
  mutable std::shared_ptr<const Sorted<NearestMap>> of_nearest_;
};

}  // namespace vpm
