// The sums of a kernel that is linear in the squared distance over the k nearest photons, without a list of them. First
// the distance of the k-th, from how many lie in whole nodes well within it and from the distances of those around it;
// then the moments of what is nearer.
//
// Neighbouring queries reach almost equally far, so that the last reach is the first guess. It has no part in the
// result: the second step walks through the tree anew, because the first takes as a whole the nodes within the
// guess, and sums would be rounded differently from guess to guess.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "vpm/base/counters.h"
#include "vpm/photon/map/nearest_map.h"
#include "vpm/photon/map/node_groups.h"

namespace vpm {

/// Sums over the photons that are nearer than the k-th.
struct NearestSums {
  float radius2 = 0.0f;  // the squared distance of the k-th, or of the largest radius where there are not so many, m^2
  size_t used = 0;       // how many are nearer
  Rgbd power{0.0};       // the sum of their powers, W
  Rgbd second{0.0};      // and of their powers times squared distances, W m^2
};

/// A query of photons that are sorted into leaves: of those that accept(travel, offset) takes, the ones near `point`.
template <class Accept>
struct NodeQuery {
  const PhotonTable& photons;
  const NodeGroups& nodes;
  Vec3 point;
  const Accept& accept;
  uint32_t& visited;  // counts the photons whose distance was computed

  /// Calls visit(distances2, first, number) for the `number` photons of a leaf from number `first` on. The array has
  /// kBlock entries, which are infinite for photons that are not taken, and behind the last. `all`: all are taken.
  template <class Visit>
  void look_at(size_t leaf, bool all, Visit&& visit) const {
    const auto [first, end] = nodes.photons_of(leaf);
    const auto number = static_cast<uint32_t>(end - first);
    const PackedDirection* travel = nodes.travel(first);
    float distances2[kBlock];
    if (all) {
      for (uint32_t i = 0; i < kBlock; ++i) {
        const Vec3 offset = photons.position(first + i) - point;
        distances2[i] = i < number ? glm::dot(offset, offset) : kInfinity;
      }
    } else {
      for (uint32_t i = 0; i < kBlock; ++i) {
        const Vec3 offset = photons.position(first + i) - point;
        const bool takes = accept(travel[i], offset) & (i < number);
        distances2[i] = takes ? glm::dot(offset, offset) : kInfinity;
      }
    }
    count(visited, number);
    visit(distances2, first, number);
  }

  /// How many photons lie in nodes that are nearer than `inside`, m, as a whole, and how many of the others are nearer
  /// than `outside`. Lists the squared distances of the latter.
  std::pair<size_t, size_t> list(float inside, float outside, std::vector<float>& distances2) const {
    size_t whole = 0, listed = 0;
    const auto add_node = [&](size_t, const uint32_t*, uint32_t number) { whole += number; };
    const auto add_leaf = [&](size_t leaf, bool all) {
      look_at(leaf, all, [&](const float* some, size_t, uint32_t number) {
        if (distances2.size() < listed + kBlock) distances2.resize(2 * listed + kBlock);
        uint32_t unused[kBlock];
        listed += append_below(some, number, outside * outside, 0, &distances2[listed], unused);
      });
    };
    nodes.visit(point, inside * inside, outside * outside, accept, add_node, add_leaf);
    return {whole, listed};
  }

  /// The sums over those nearer than the square root of `radius2`, m^2.
  NearestSums sums_within(float radius2) const {
    NearestSums sums{radius2};
    MomentSums moments;
    const auto add_node = [&](size_t group, const uint32_t* taken, uint32_t number) {
      moments.add(nodes.group(group), nodes.moments(group), taken, point);
      sums.used += number;
    };
    const auto add_leaf = [&](size_t leaf, bool all) {
      look_at(leaf, all, [&](const float* distances2, size_t first, uint32_t) {
        sums.used += moments.add(nodes, first, distances2, radius2);
      });
    };
    nodes.visit(point, radius2, radius2, accept, add_node, add_leaf);
    moments.finish();
    sums.power = moments.power();
    sums.second = moments.second();
    return sums;
  }
};

/// The squared distance of the k-th nearest, k = `count` >= 2, or of the largest radius (m) where not so many are
/// nearer than that.
template <class Accept>
float nearest_radius2(const NodeQuery<Accept>& query, uint32_t count, float max_radius, NodeSearch& search) {
  constexpr float kFirstWidth = 0.01f, kMostWidth = 0.5f;  // of what is looked through around a guess, over its radius
  constexpr float kLeast = 1e-18f;                         // m; of guesses, whose squares are to be normal numbers
  const float most = std::min(max_radius, query.nodes.reach(query.point));
  const auto share = static_cast<float>(count) / static_cast<float>(query.photons.size());
  float guess = search.radius > 0.0f ? search.radius : 0.5f * most * std::sqrt(share);  // as of a disc of photons
  for (float width = kFirstWidth;; width = std::min(kMostWidth, 4.0f * width)) {
    guess = std::max(kLeast, std::min(guess, most));
    const float inside = guess > kLeast ? guess * (1.0f - width) : 0.0f;
    const float outside = std::min(most, guess * (1.0f + width));
    const auto [whole, listed] = query.list(inside, outside, search.distances2);
    const size_t found = whole + listed;
    if (found < count && outside == most) return max_radius * max_radius;
    if (found >= count && whole < count) {
      const float radius2 = kth_smallest(search.distances2.data(), listed, count - whole);
      if (radius2 >= inside * inside) {  // else some of the whole nodes may lie beyond it
        search.radius = std::sqrt(radius2);
        return radius2;
      }
    }
    // The next look begins where this one ended, at the least.
    const float ratio = std::sqrt(static_cast<float>(count) / static_cast<float>(std::max<size_t>(found, 1)));
    guess *= found < count ? std::clamp(ratio, 1.0f + width, 2.0f) : std::clamp(ratio, 0.5f, 1.0f - width);
  }
}

/// The sums over those nearer than the k-th, k = `count` >= 2, and than `max_radius`, m; may be infinite. None where
/// another photon is exactly as far as the k-th: then some choice among equals counts, too, which sums within a radius
/// do not know of.
template <class Accept>
std::optional<NearestSums> nearest_sums(const NodeQuery<Accept>& query, uint32_t count, float max_radius,
                                        NodeSearch& search) {
  const float radius2 = nearest_radius2(query, count, max_radius, search);
  const NearestSums sums = query.sums_within(radius2);
  if (radius2 < max_radius * max_radius && sums.used != count - 1) return std::nullopt;
  return sums;
}

}  // namespace vpm
