// Cutting beams into pieces.
#include "vpm/photon/photon_beam_map.h"

#include <algorithm>
#include <cmath>

#include "vpm/base/parallel.h"

namespace vpm {
namespace {

constexpr float kShortest = 8.0f;   // a piece, in radii: the box around a shorter one is no emptier
constexpr size_t kMostPieces = 8;   // in the mean over the beams, and less than one more
constexpr size_t kChunk = 1 << 13;  // beams or pieces one thread takes at once

/// How many pieces a beam is cut into, so that none is longer than `longest`, m.
size_t pieces_of(const PhotonBeam& beam, double longest) {
  return static_cast<size_t>(std::max(1.0, std::ceil(double{beam.length} / longest)));
}

double total_length(const std::vector<PhotonBeam>& beams) {
  double sum = 0.0;
  for (const PhotonBeam& beam : beams) sum += double{beam.length};
  return sum;
}

}  // namespace

PhotonBeamMap::PhotonBeamMap(const std::vector<PhotonBeam>& beams, float radius, float scale)
    : size_(beams.size()), radius_(radius) {
  if (!beams.empty()) cut(beams, scale);
}

void PhotonBeamMap::cut(const std::vector<PhotonBeam>& beams, float scale) {
  const double longest = std::max(double{kShortest} * double{radius_},
                                  total_length(beams) / static_cast<double>(kMostPieces * beams.size()));
  std::vector<size_t> first(beams.size() + 1, 0);
  for (size_t i = 0; i < beams.size(); ++i) first[i + 1] = first[i] + pieces_of(beams[i], longest);
  pieces_ = first.back();
  std::vector<Vec3> middles(pieces_);
  std::vector<uint32_t> owner(pieces_);
  const auto half_of = [&](size_t beam) {
    return 0.5 * double{beams[beam].length} / static_cast<double>(first[beam + 1] - first[beam]);
  };
  const auto from_of = [&](size_t piece) {
    return half_of(owner[piece]) * static_cast<double>(2 * (piece - first[owner[piece]]) + 1);
  };
  parallel_for_chunks(beams.size(), kChunk, [&](size_t begin, size_t end, size_t) {
    for (size_t i = begin; i < end; ++i)
      for (size_t piece = first[i]; piece < first[i + 1]; ++piece) {
        owner[piece] = static_cast<uint32_t>(i);
        middles[piece] = Vec3(Vec3d(beams[i].origin) + from_of(piece) * Vec3d(beams[i].direction));
      }
  });
  const LeafOrder tree = sort_into_leaves(middles, kLeaf);
  leaves_ = tree.leaves;
  for (std::vector<float>* values : {&x_, &y_, &z_, &dx_, &dy_, &dz_, &half_, &from_, &r_, &g_, &b_})
    values->assign(pieces_ + kBlock, 0.0f);
  beam_.resize(pieces_);
  parallel_for_chunks(pieces_, kChunk, [&](size_t begin, size_t end, size_t) {
    for (size_t i = begin; i < end; ++i) {
      const uint32_t piece = tree.order[i], beam = owner[piece];
      const Vec3 middle = middles[piece], direction = beams[beam].direction;
      beam_[i] = beam;
      x_[i] = middle.x;
      y_[i] = middle.y;
      z_[i] = middle.z;
      dx_[i] = direction.x;
      dy_[i] = direction.y;
      dz_[i] = direction.z;
      half_[i] = static_cast<float>(half_of(beam));
      from_[i] = static_cast<float>(from_of(piece));
      const Rgb power = scale * beams[beam].power;
      r_[i] = power.r;
      g_[i] = power.g;
      b_[i] = power.b;
    }
  });
  boxes_ = BoxTree(leaves_, [&](size_t leaf) {
    Box box;
    for (size_t i = leaf_begin(pieces_, leaves_, leaf); i < leaf_begin(pieces_, leaves_, leaf + 1); ++i) {
      const Vec3 middle(x_[i], y_[i], z_[i]), direction(dx_[i], dy_[i], dz_[i]);
      // Perpendiculars to the piece reach that far along each axis, and a hair more for rounding.
      const Vec3 along = half_[i] * glm::abs(direction);
      const Vec3 across = radius_ * glm::sqrt(glm::max(Vec3(0.0f), Vec3(1.0f) - direction * direction));
      const Vec3 reach = 1.0001f * (along + across) + 1e-4f * radius_;
      box.add(middle - reach);
      box.add(middle + reach);
    }
    return box;
  });
  for (const PhotonBeam& beam : beams) {
    bounds_.add(beam.origin);
    bounds_.add(beam.origin + beam.length * beam.direction);
  }
}

size_t PhotonBeamMap::memory_bytes() const {
  return sizeof(*this) + boxes_.memory_bytes() + 11 * x_.capacity() * sizeof(float) +
         beam_.capacity() * sizeof(uint32_t);
}

}  // namespace vpm
