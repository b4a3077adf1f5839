// The sum that all density estimates share: photons around a point, weighted by a kernel, from a map or a plain list.
//
// Each photon contributes value(travel, power) K_r, and the same times the correction of the kernel. Volumes and
// surfaces differ in `value`, in which photons count, and in the dimension of the kernel. Sums are kept in doubles: in
// floats, thousands of similar photons would be rounded the same way, and the error would be visible.
#pragma once

#include <algorithm>
#include <cassert>
#include <optional>
#include <type_traits>
#include <vector>

#include "vpm/base/counters.h"
#include "vpm/estimate/photon_map.h"
#include "vpm/photon/map/nearest_sums.h"

namespace vpm {

/// The settings of a gather: those of the map or of its view; for a plain list those given with it.
inline const GatherSettings& settings_of(const PhotonMap& map) { return map.settings; }
inline const GatherSettings& settings_of(const CountedMap& counted) { return counted.settings; }
inline const GatherSettings& settings_of(const std::vector<Photon>&, const GatherSettings& settings, uint64_t) {
  return settings;
}

/// The norm of the kernel in a space of `Dimension` 1 to 3.
template <int Dimension>
float kernel_norm(KernelKind kind, float r) {
  static_assert(Dimension >= 1 && Dimension <= 3);
  return Dimension == 1 ? kernel_norm_1d(kind, r) : Dimension == 2 ? kernel_norm_2d(kind, r) : kernel_norm_3d(kind, r);
}

/// The weights of a kernel and of its correction, without their common norm, as a function of (distance / radius)^2:
/// a float, or Floats.
template <KernelKind K, int Dimension>
struct KernelProfile {
  template <class Real>
  KernelPair<Real> operator()(const Real& q) const {
    return {kernel_profile<K, Dimension>(q), kernel_correction<K, Dimension>(q)};
  }
};

/// Calls f with the kernel's KernelProfile, a type the inner loop can inline.
template <int Dimension, class F>
auto with_kernel(KernelKind kind, F&& f) {
  switch (kind) {
    case KernelKind::constant:
      return f(KernelProfile<KernelKind::constant, Dimension>());
    case KernelKind::cone:
      return f(KernelProfile<KernelKind::cone, Dimension>());
    case KernelKind::epanechnikov:
      return f(KernelProfile<KernelKind::epanechnikov, Dimension>());
    case KernelKind::biweight:
      return f(KernelProfile<KernelKind::biweight, Dimension>());
    case KernelKind::triweight:
      return f(KernelProfile<KernelKind::triweight, Dimension>());
    case KernelKind::order_4:
      break;
  }
  return f(KernelProfile<KernelKind::order_4, Dimension>());
}

/// A sum in doubles as an estimate, times the kernel's norm.
inline KernelEstimate normed(const KernelPair<Rgbd>& sum, float norm) {
  return KernelEstimate(Rgb(sum.value), Rgb(sum.correction)) * Rgb(norm);
}

/// A map of one kind, with the settings of the gather, its counters and its memory.
template <class Index>
struct Gathering {
  const Index& index;
  const GatherSettings& settings;
  GatherWork work;
};
template <class Index>
Gathering(const Index&, const GatherSettings&, GatherWork) -> Gathering<Index>;  // Clang 14 does not deduce it

/// Takes every photon.
struct AnyPhoton {
  bool operator()(const PackedDirection&, const Vec3&) const { return true; }
};

/// The sum over a batch; relative(distance^2) is (distance / radius)^2. The kernel's type is chosen here and not around
/// the search, which would be compiled for each.
template <int Dimension, class Relative, class Value>
KernelPair<Rgbd> weighted_sum(const PhotonBatch& batch, KernelKind kernel, Relative&& relative, Value&& value) {
  return with_kernel<Dimension>(kernel, [&](auto profile) {
    return sum_photons(
        batch, [&](size_t i) { return profile(relative(batch.distance2(i))); }, value);
  });
}

/// The sum over the photons within the radius that `accept`(travel, offset) takes.
template <int Dimension, class Accept, class Value>
KernelEstimate kernel_sum(const Gathering<RadiusMap>& map, const Vec3& point, Accept&& accept, Value&& value) {
  const float r = map.settings.radius, inverse = 1.0f / (r * r);
  const auto relative = [=](float distance2) { return distance2 * inverse; };
  KernelPair<Rgbd> sum;
  const auto visit = [&](NearPhotons& near) {
    if constexpr (!std::is_same_v<std::decay_t<Accept>, AnyPhoton>) near.keep(map.index.photons(), point, accept);
    map.work.counters.used += near.size();
    if (near.size() == 0) return;
    const PhotonBatch batch(map.index.photons(), near.photons(), near.distances2(), near.size());
    sum += weighted_sum<Dimension>(batch, map.settings.kernel, relative, value);
  };
  count(map.work.counters.searches);
  count(map.work.counters.visited, map.index.visit_near(point, r, visit));
  return normed(sum, kernel_norm<Dimension>(map.settings.kernel, r));
}

/// The k nearest photons that `accept`(travel, offset) takes, among those within the largest radius. The result is
/// valid until the next call with the same work.
template <class Accept>
const Neighbours& nearest(const Gathering<NearestMap>& map, const Vec3& point, Accept&& accept) {
  Neighbours& neighbours = map.work.neighbours;
  count(map.work.counters.searches);
  const uint32_t visited = map.index.find(point, map.settings.count, map.settings.radius, neighbours, accept);
  count(map.work.counters.visited, visited);
  return neighbours;
}

/// The sum over the neighbours that nearest() found. The k-th neighbour sets the radius and is not counted: k - 1
/// photons over the ball that reaches to it give an unbiased estimate. (Kernels that vanish at the radius leave it out
/// by themselves.) Where fewer than k photons lie within the largest radius, all of them count, over that radius.
template <int Dimension, class Value>
KernelEstimate neighbour_sum(const Gathering<NearestMap>& map, const Neighbours& neighbours, Value&& value) {
  const float r2 = neighbours.limit();
  const size_t first = neighbours.full() ? 1 : 0;  // the farthest
  GatherCounters& counters = map.work.counters;
  counters.used += neighbours.size() - first;
  ++counters.by_count;
  counters.short_of += neighbours.full() ? 0 : 1;
  const auto relative = [=](float distance2) { return distance2 / r2; };
  KernelPair<Rgbd> sum;
  for (size_t begin = first; begin < neighbours.size(); begin += PhotonBatch::kMost) {
    const size_t number = std::min(PhotonBatch::kMost, neighbours.size() - begin);
    const PhotonBatch batch(map.index.photons(), neighbours.photons() + begin, neighbours.distances2() + begin, number);
    sum += weighted_sum<Dimension>(batch, map.settings.kernel, relative, value);
  }
  return normed(sum, kernel_norm<Dimension>(map.settings.kernel, std::sqrt(r2)));
}

/// The `value` of photons whose powers alone count.
struct PowerAlone {
  Rgb operator()(const Vec3&, const Rgb& power) const { return power; }
};

/// Does it accept or refuse whole nodes of photons (node_groups.h)?
template <class Accept>
concept JudgesNodes = requires(const Accept& accept, const NodeGroup& nodes, const Vec3& point, GroupView& view) {
  accept.judge(nodes, point, view);
};

/// The sum of powers over many nearest photons by whole nodes, where the map is prepared for it. None where it is not,
/// or where photons are equally far.
template <int Dimension, JudgesNodes Accept>
std::optional<KernelEstimate> power_by_nodes(const Gathering<NearestMap>& map, const Vec3& point,
                                             const Accept& accept) {
  const auto& [index, settings, work] = map;
  if (!index.nodes() || !sums_by_nodes(settings)) return {};
  uint32_t visited = 0;
  const NodeQuery<Accept> query{index.photons(), *index.nodes(), point, accept, visited};
  const auto sums = nearest_sums(query, settings.count, settings.radius, work.neighbours.without_list());
  count(work.counters.visited, visited);
  if (!sums) return {};
  count(work.counters.searches);
  work.counters.used += sums->used;
  ++work.counters.by_count;
  work.counters.short_of += sums->radius2 < settings.radius * settings.radius ? 0 : 1;
  // Profiles are linear in q: both weights are those at 0, and q times what they change by up to 1.
  const KernelProfile<KernelKind::epanechnikov, Dimension> profile;
  const KernelPair<float> middle = profile(0.0f), change = profile(1.0f) - middle;
  const Rgbd q = sums->second / static_cast<double>(sums->radius2);
  const auto weigh = [&](float at_0, float by_q) { return double{at_0} * sums->power + double{by_q} * q; };
  return normed({weigh(middle.value, change.value), weigh(middle.correction, change.correction)},
                kernel_norm<Dimension>(settings.kernel, std::sqrt(sums->radius2)));
}

/// The sum over the k nearest photons that `accept` takes.
template <int Dimension, class Accept, class Value>
KernelEstimate kernel_sum(const Gathering<NearestMap>& map, const Vec3& point, Accept&& accept, Value&& value) {
  if constexpr (std::is_same_v<std::decay_t<Value>, PowerAlone> && JudgesNodes<std::decay_t<Accept>>)
    if (const std::optional<KernelEstimate> sum = power_by_nodes<Dimension>(map, point, accept)) return *sum;
  return neighbour_sum<Dimension>(map, nearest(map, point, accept), value);
}

template <int Dimension, class Accept, class Value>
KernelEstimate kernel_sum(const CountedMap& counted, const Vec3& point, Accept&& accept, Value&& value) {
  assert(counted.settings.mode == counted.map.settings.mode);
  const auto sum = [&](const auto& index) {
    return kernel_sum<Dimension>(Gathering{index, counted.settings, counted.work}, point, accept, value);
  };
  return std::visit(sum, counted.map.index);
}

template <int Dimension, class Accept, class Value>
KernelEstimate kernel_sum(const PhotonMap& map, const Vec3& point, Accept&& accept, Value&& value) {
  GatherCounters uncounted;
  Neighbours neighbours;
  return kernel_sum<Dimension>(CountedMap{map, {uncounted, neighbours}}, point, accept, value);
}

/// The radius, m, of the ball that kernel_sum() sums over.
template <class Accept>
float kernel_radius(const CountedMap& counted, const Vec3& point, Accept&& accept) {
  const GatherSettings& settings = counted.settings;
  const auto* by_count = std::get_if<NearestMap>(&counted.map.index);
  if (!by_count) return settings.radius;
  return std::sqrt(nearest(Gathering{*by_count, settings, counted.work}, point, accept).limit());
}

/// The brute-force twin of both sums: looks at every photon of a plain list. Powers are divided by `emitted` here.
template <int Dimension, class Accept, class Value>
KernelEstimate kernel_sum(const std::vector<Photon>& photons, const GatherSettings& settings, uint64_t emitted,
                          const Vec3& point, Accept&& accept, Value&& value) {
  std::vector<std::pair<float, const Photon*>> near;
  for (const Photon& p : photons) {
    const Vec3 offset = p.position - point;
    const float d2 = glm::dot(offset, offset);
    if (d2 < settings.radius * settings.radius && accept(p.travel, offset)) near.emplace_back(d2, &p);
  }
  float r2 = settings.radius * settings.radius;
  if (settings.mode == GatherMode::nearest && near.size() >= settings.count) {
    std::sort(near.begin(), near.end());
    near.resize(settings.count);
    r2 = near.back().first;
    near.pop_back();
  }
  return with_kernel<Dimension>(settings.kernel, [&](auto profile) {
    KernelPair<Rgbd> sum;
    for (const auto& [d2, p] : near) {
      const Rgb v = value(p->travel.unpack(), p->power);
      const KernelPair<float> weight = profile(d2 / r2);
      sum += {Rgbd(v * weight.value), Rgbd(v * weight.correction)};
    }
    return normed(sum, kernel_norm<Dimension>(settings.kernel, std::sqrt(r2)) / static_cast<float>(emitted));
  });
}

}  // namespace vpm
