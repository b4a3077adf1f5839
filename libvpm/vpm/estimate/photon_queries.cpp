// Points are taken in chunks: those that lie side by side find the same photons in the cache.
#include "vpm/estimate/photon_queries.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "vpm/base/parallel.h"
#include "vpm/estimate/surface_estimate.h"
#include "vpm/medium/phase/phase.h"

namespace vpm {
namespace {

constexpr size_t kPointChunk = 512;

/// Calls of(i) for each of so many points.
template <class OfPoint>
void for_points(size_t count, OfPoint&& of) {
  parallel_for_chunks(count, kPointChunk, [&](size_t begin, size_t end, size_t) {
    for (size_t i = begin; i < end; ++i) of(i);
  });
}

/// The sum of weight(squared distance over that of the radius, number of the photon in the map) times power.
template <class Weight>
Rgbd sum_near(const RadiusMap& map, const Vec3& point, float radius, Weight&& weight) {
  Rgbd sum(0.0);
  const float inverse = 1.0f / (radius * radius);
  map.visit_near(point, radius, [&](const NearPhotons& near) {
    for (size_t k = 0; k < near.size(); ++k) {
      const uint32_t photon = near.photons()[k];
      const Rgbd power(map.photons().payload(photon).power.unpack());
      sum += power * double{weight(near.distances2()[k] * inverse, photon)};
    }
  });
  return sum;
}

}  // namespace

std::shared_ptr<const PhotonQueries::Sorted<RadiusMap>> PhotonQueries::map_of(float radius) const {
  const std::scoped_lock lock(making_);
  if (!of_radius_ || of_radius_->radius != radius) {
    auto sorted = std::make_shared<Sorted<RadiusMap>>();
    sorted->map = RadiusMap(photons_, radius, 1.0f, &sorted->numbers);
    sorted->radius = radius;
    of_radius_ = std::move(sorted);
  }
  return of_radius_;
}

std::shared_ptr<const PhotonQueries::Sorted<NearestMap>> PhotonQueries::nearest_map() const {
  const std::scoped_lock lock(making_);
  if (!of_nearest_) {
    auto sorted = std::make_shared<Sorted<NearestMap>>();
    sorted->map = NearestMap(photons_, 1.0f, &sorted->numbers);
    of_nearest_ = std::move(sorted);
  }
  return of_nearest_;
}

std::vector<uint32_t> PhotonQueries::count_within(std::span<const Vec3> points, float radius) const {
  const auto sorted = map_of(radius);
  std::vector<uint32_t> counts(points.size());
  for_points(points.size(), [&](size_t i) {
    sorted->map.visit_near(points[i], radius,
                           [&](const NearPhotons& near) { counts[i] += static_cast<uint32_t>(near.size()); });
  });
  return counts;
}

NearLists PhotonQueries::within(std::span<const Vec3> points, float radius) const {
  const std::vector<uint32_t> counts = count_within(points, radius);
  NearLists lists;
  lists.first.resize(points.size() + 1, 0);
  std::inclusive_scan(counts.begin(), counts.end(), lists.first.begin() + 1, std::plus<>(), uint64_t{0});
  lists.numbers.resize(lists.first.back());
  const auto sorted = map_of(radius);
  for_points(points.size(), [&](size_t i) {
    const auto begin = lists.numbers.begin() + static_cast<std::ptrdiff_t>(lists.first[i]);
    auto next = begin;
    sorted->map.visit_near(points[i], radius, [&](const NearPhotons& near) {
      for (size_t k = 0; k < near.size(); ++k) *next++ = sorted->numbers[near.photons()[k]];
    });
    std::sort(begin, next);
  });
  return lists;
}

NearestLists PhotonQueries::nearest(std::span<const Vec3> points, uint32_t count) const {
  const auto sorted = nearest_map();
  NearestLists lists{std::vector<uint32_t>(points.size() * count, NearestLists::kNone),
                     std::vector<float>(points.size() * count, kInfinity)};
  parallel_for_chunks(points.size(), kPointChunk, [&](size_t begin, size_t end, size_t) {
    Neighbours neighbours;
    std::vector<uint32_t> order;
    for (size_t i = begin; i < end; ++i) {
      sorted->map.find(points[i], count, kInfinity, neighbours, [](const auto&, const auto&) { return true; });
      order.resize(neighbours.size());
      std::iota(order.begin(), order.end(), 0u);
      std::sort(order.begin(), order.end(),
                [&](uint32_t a, uint32_t b) { return neighbours.distances2()[a] < neighbours.distances2()[b]; });
      for (size_t k = 0; k < order.size(); ++k) {
        lists.numbers[i * count + k] = sorted->numbers[neighbours.photons()[order[k]]];
        lists.distances[i * count + k] = std::sqrt(neighbours.distances2()[order[k]]);
      }
    }
  });
  return lists;
}

std::vector<Rgb> PhotonQueries::estimate(std::span<const Vec3> points, float radius, KernelKind kernel,
                                         const EstimateOf& of) const {
  const auto sorted = map_of(radius);
  std::vector<Rgb> estimates(points.size());
  const HenyeyGreenstein phase{of.g};
  const auto estimate_all = [&]<int Dimension>(float norm, auto&& factor) {
    with_kernel<Dimension>(kernel, [&](auto profile) {
      for_points(points.size(), [&](size_t i) {
        estimates[i] = Rgb(double{norm} * sum_near(sorted->map, points[i], radius, [&](float q, uint32_t photon) {
                             return profile(q).value * factor(i, photon);
                           }));
      });
      return 0;
    });
  };
  const PhotonTable& photons = sorted->map.photons();
  if (!of.normals.empty())
    estimate_all.template operator()<2>(kernel_norm_2d(kernel, radius), [&](size_t i, uint32_t photon) {
      const Arrives arrives{of.normals[i], kFlatness * radius};
      return arrives(photons.payload(photon).travel, photons.position(photon) - points[i]) ? 1.0f : 0.0f;
    });
  else if (!of.directions.empty())
    estimate_all.template operator()<3>(kernel_norm_3d(kernel, radius), [&](size_t i, uint32_t photon) {
      return phase.value(photons.payload(photon).travel.unpack(), of.directions[i]);
    });
  else
    estimate_all.template operator()<3>(kernel_norm_3d(kernel, radius), [](size_t, uint32_t) { return 1.0f; });
  return estimates;
}

}  // namespace vpm
