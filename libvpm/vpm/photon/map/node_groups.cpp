// Collecting what holds for the photons of nodes, and summing moments.
#include "vpm/photon/map/node_groups.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "vpm/base/parallel.h"

namespace vpm {
namespace {

constexpr size_t kNodeChunk = 1 << 8;      // nodes one thread takes at once
constexpr size_t kGroupedChunk = 1 << 14;  // photons, likewise

/// The unit normal of the plane through three of the photons that lie far apart; 0 where all lie on a line.
Vec3 plane_normal(const PhotonTable& photons, size_t begin, size_t end) {
  const Vec3d first = photons.position(begin);
  Vec3d along(0.0), normal(0.0);  // to the photon farthest from the first, and across it to that farthest from the line
  for (size_t i = begin; i < end; ++i) {
    const Vec3d offset = Vec3d(photons.position(i)) - first;
    if (glm::dot(offset, offset) > glm::dot(along, along)) along = offset;
  }
  for (size_t i = begin; i < end; ++i) {
    const Vec3d across = glm::cross(along, Vec3d(photons.position(i)) - first);
    if (glm::dot(across, across) > glm::dot(normal, normal)) normal = across;
  }
  const double length = glm::length(normal);
  return length > 0.0 ? Vec3(normal / length) : Vec3(0.0f);
}

/// Fills one lane of a group with nodes from the photons [begin, end).
void fill_bounds(const PhotonTable& photons, size_t begin, size_t end, size_t lane, NodeGroup& group) {
  const Vec3 normal = plane_normal(photons, begin, end);
  Box box;
  float least = kInfinity, most = -kInfinity;
  for (size_t i = begin; i < end; ++i) {
    box.add(photons.position(i));
    const float across = glm::dot(photons.payload(i).travel.on_octahedron(), normal);
    least = std::min(least, across);
    most = std::max(most, across);
  }
  for (int a = 0; a < 3; ++a) {
    group.lo[a][lane] = box.lo[a];
    group.hi[a][lane] = box.hi[a];
    group.normal[a][lane] = normal[a];
  }
  group.least[lane] = least;
  group.most[lane] = most;
  group.photons[lane] = static_cast<uint32_t>(end - begin);
}

/// The center of a node's box, m.
Vec3 center_of(const NodeGroup& group, size_t lane) {
  return 0.5f * Vec3(group.lo[0][lane] + group.hi[0][lane], group.lo[1][lane] + group.hi[1][lane],
                     group.lo[2][lane] + group.hi[2][lane]);
}

void fill_moments(const PhotonTable& photons, size_t begin, size_t end, size_t lane, const NodeGroup& group,
                  NodeMoments& moments) {
  const Vec3d center = center_of(group, lane);
  Rgbd power(0.0), second(0.0);
  glm::dmat3 first(0.0);  // a column for each channel
  for (size_t i = begin; i < end; ++i) {
    const Vec3d offset = Vec3d(photons.position(i)) - center;
    const Rgbd p = photons.payload(i).power.unpack();
    power += p;
    second += p * glm::dot(offset, offset);
    for (int c = 0; c < 3; ++c) first[c] += p[c] * offset;
  }
  for (int c = 0; c < 3; ++c) {
    moments.power[c][lane] = static_cast<float>(power[c]);
    moments.second[c][lane] = static_cast<float>(second[c]);
    for (int a = 0; a < 3; ++a) moments.first[c][a][lane] = static_cast<float>(first[c][a]);
  }
}

}  // namespace

NodeGroups::NodeGroups(const PhotonTable& photons, size_t leaves)
    : photons_(photons.size()), leaves_(leaves), depth_(std::max(0, std::countr_zero(leaves) - 1) / kLevels) {
  size_t groups = 1;
  for (int d = 0; d < depth_; ++d) {
    begin_[d + 1] = groups;
    groups += nodes(d);  // a group below each node
  }
  groups_.resize(groups);
  moments_.resize(groups);
  travel_.resize(photons_ + kBlock);
  for (std::vector<float>& channel : power_) channel.resize(photons_ + kBlock);
  parallel_for_chunks(photons_, kGroupedChunk, [&](size_t begin, size_t end, size_t) {
    for (size_t i = begin; i < end; ++i) {
      const auto& [travel, power] = photons.payload(i);
      const Rgb unpacked = power.unpack();
      travel_[i] = travel;
      for (int c = 0; c < 3; ++c) power_[static_cast<size_t>(c)][i] = unpacked[c];
    }
  });
  for (int d = 0; d <= depth_; ++d)
    parallel_for_chunks(nodes(d), d == depth_ ? kNodeChunk : 1, [&](size_t begin, size_t end, size_t) {
      for (size_t node = begin; node < end; ++node) fill(d, node, photons);
    });
}

void NodeGroups::fill(int depth, size_t node, const PhotonTable& photons) {
  const int above = kLevels * (depth_ - depth);
  const size_t begin = leaf_begin(photons_, leaves_, node << above);
  const size_t end = leaf_begin(photons_, leaves_, (node + 1) << above);
  if (begin == end) return;  // an empty map
  const size_t place = begin_[depth] + node / kBlock, lane = node % kBlock;
  fill_bounds(photons, begin, end, lane, groups_[place]);
  fill_moments(photons, begin, end, lane, groups_[place], moments_[place]);
}

size_t NodeGroups::memory_bytes() const {
  return groups_.capacity() * sizeof(NodeGroup) + moments_.capacity() * sizeof(NodeMoments) +
         travel_.capacity() * (sizeof(PackedDirection) + sizeof(Rgb));
}

float NodeGroups::reach(const Vec3& point) const {
  GroupView view;
  find_distances2(groups_[0], point, view);
  float farthest2 = 0.0f;
  for (size_t node = 0; node < nodes(0); ++node) farthest2 = std::max(farthest2, view.farthest2[node]);
  return std::sqrt(farthest2) * (1.0f + 1e-6f) + 1e-18f;
}

void MomentSums::add(const NodeGroup& nodes, const NodeMoments& moments, const uint32_t* taken, const Vec3& point) {
  float x[kBlock], y[kBlock], z[kBlock], square[kBlock], weight[kBlock];  // from the center to the point
  const Vec3 p = point;
  for (uint32_t i = 0; i < kBlock; ++i) {
    x[i] = p.x - 0.5f * (nodes.lo[0][i] + nodes.hi[0][i]);
    y[i] = p.y - 0.5f * (nodes.lo[1][i] + nodes.hi[1][i]);
    z[i] = p.z - 0.5f * (nodes.lo[2][i] + nodes.hi[2][i]);
    square[i] = x[i] * x[i] + y[i] * y[i] + z[i] * z[i];
    weight[i] = static_cast<float>(static_cast<int32_t>(taken[i]));
  }
  const auto add_channel = [&](int c, float* powers, float* seconds) {
    const float *power = moments.power[c], *second = moments.second[c];
    const float *first_x = moments.first[c][0], *first_y = moments.first[c][1], *first_z = moments.first[c][2];
    for (uint32_t i = 0; i < kBlock; ++i) {
      const float along = x[i] * first_x[i] + y[i] * first_y[i] + z[i] * first_z[i];
      powers[i] += weight[i] * power[i];
      seconds[i] += weight[i] * (second[i] - 2.0f * along + square[i] * power[i]);
    }
  };
  add_channel(0, powers_.r, seconds_.r);
  add_channel(1, powers_.g, seconds_.g);
  add_channel(2, powers_.b, seconds_.b);
  close_block();
}

uint32_t MomentSums::add(const NodeGroups& photons, size_t first, const float* distances2, float limit2) {
  const float *r = photons.power(0, first), *g = photons.power(1, first), *b = photons.power(2, first);
  uint32_t inside = 0;
  for (uint32_t i = 0; i < kBlock; ++i) {
    const bool counts = distances2[i] < limit2;
    const Rgb power = counts ? Rgb(r[i], g[i], b[i]) : Rgb(0.0f);
    powers_.add(i, power);
    seconds_.add(i, power * (counts ? distances2[i] : 0.0f));
    inside += counts ? 1 : 0;
  }
  close_block();
  return inside;
}

void MomentSums::finish() {
  power_ += powers_.total();
  second_ += seconds_.total();
  powers_ = seconds_ = LaneSums();
  blocks_ = 0;
}

}  // namespace vpm
