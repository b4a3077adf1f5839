// Cutting beams into pieces.
#include "vpm/photon/map/photon_beam_map.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "vpm/base/parallel.h"
#include "vpm/photon/map/leaf_order.h"

namespace vpm {
namespace {

constexpr size_t kMostPieces = 9;    // in the mean over the beams
constexpr size_t kSample = 1 << 12;  // beams by which the density of all is estimated, at most
constexpr size_t kChunk = 1 << 13;   // beams or pieces one thread takes at once

/// How many pieces a beam is cut into, so that none is longer than `longest`, m.
size_t pieces_of(const PhotonBeam& beam, double longest) {
  constexpr double kMost = 1e9;  // of one beam, before a length is found that makes few of all
  return static_cast<size_t>(std::clamp(std::ceil(double{beam.length} / longest), 1.0, kMost));
}

size_t pieces_of_all(const std::vector<PhotonBeam>& beams, double longest) {
  size_t sum = 0;
  for (const PhotonBeam& beam : beams) sum += pieces_of(beam, longest);
  return sum;
}

/// The least length of pieces, m, not below `shortest`, that makes at most `most` of them, a number not below that of
/// the beams: by halving an interval, to a thousandth or so.
double piece_length(const std::vector<PhotonBeam>& beams, double shortest, size_t most) {
  if (pieces_of_all(beams, shortest) <= most) return shortest;
  double sum = 0.0, largest = 0.0;
  for (const PhotonBeam& beam : beams) {
    sum += double{beam.length};
    largest = std::max(largest, double{beam.length});
  }
  // Pieces are no fewer than sum / length, and no more than that and the beams.
  double lo = std::max(shortest, sum / static_cast<double>(most));
  double hi = std::min(largest, sum / static_cast<double>(most - beams.size()));
  for (int i = 0; i < 10; ++i) {
    const double middle = 0.5 * (lo + hi);
    (pieces_of_all(beams, middle) <= most ? hi : lo) = middle;
  }
  return hi;
}

/// The edge of a cube that holds a leaf of uncut beams, where beams are as dense as within the middle half of their
/// middles along each axis, m.
double leaf_edge(const std::vector<PhotonBeam>& beams) {
  std::vector<float> places;
  double volume = 1.0;  // m^3, of an eighth of the beams
  for (int axis = 0; axis < 3; ++axis) {
    places.clear();
    for (size_t i = 0; i < beams.size(); i += 1 + beams.size() / kSample)
      places.push_back(beams[i].origin[axis] + 0.5f * beams[i].length * beams[i].direction[axis]);
    std::sort(places.begin(), places.end());
    volume *= double{places[3 * places.size() / 4]} - double{places[places.size() / 4]};
  }
  return std::cbrt(8.0 * kBlock * volume / static_cast<double>(beams.size()));
}

/// The length that no beam is cut below, m: boxes around leaves of shorter pieces are hardly smaller, as radii and
/// distances between the pieces remain.
double shortest_piece(const std::vector<PhotonBeam>& beams, float radius) {
  return std::max(8.0 * double{radius}, 2.5 * leaf_edge(beams));
}

/// How many leaves: the largest power of 2 that pieces fill, as half empty leaves cost as much as full ones.
size_t leaves_of(const std::vector<PhotonBeam>& beams, double shortest) {
  const size_t most = std::min(kMostPieces * beams.size(), pieces_of_all(beams, shortest));
  return std::bit_floor(std::max(std::bit_ceil(chunk_count(beams.size(), kBlock)), most / kBlock));
}

struct Piece {
  float half;     // of its length, m
  float from;     // of its middle from the beam's origin, m
  uint32_t beam;  // its number
};

Vec3 middle_of(const Piece& piece, const PhotonBeam& beam) {
  return Vec3(Vec3d(beam.origin) + double{piece.from} * Vec3d(beam.direction));
}

std::vector<Piece> cut(const std::vector<PhotonBeam>& beams, double longest) {
  std::vector<size_t> first(beams.size() + 1, 0);
  for (size_t i = 0; i < beams.size(); ++i) first[i + 1] = first[i] + pieces_of(beams[i], longest);
  std::vector<Piece> pieces(first.back());
  parallel_for_chunks(beams.size(), kChunk, [&](size_t begin, size_t end, size_t) {
    for (size_t i = begin; i < end; ++i) {
      const double half = 0.5 * double{beams[i].length} / static_cast<double>(first[i + 1] - first[i]);
      for (size_t p = first[i]; p < first[i + 1]; ++p)
        pieces[p] = {static_cast<float>(half), static_cast<float>(half * static_cast<double>(2 * (p - first[i]) + 1)),
                     static_cast<uint32_t>(i)};
    }
  });
  return pieces;
}

/// The leaves of the pieces' middles.
LeafOrder sort_pieces(const std::vector<Piece>& pieces, const std::vector<PhotonBeam>& beams) {
  std::vector<Vec3> middles(pieces.size());
  parallel_for_chunks(pieces.size(), kChunk, [&](size_t begin, size_t end, size_t) {
    for (size_t i = begin; i < end; ++i) middles[i] = middle_of(pieces[i], beams[pieces[i].beam]);
  });
  return sort_into_leaves(middles, kBlock);
}

/// The box around the perpendiculars to a piece, no longer than a radius: so far they reach along each axis, and a hair
/// more for rounding.
Box box_around(const Vec3& middle, const Vec3& direction, float half, float radius) {
  const Vec3 along = half * glm::abs(direction);
  const Vec3 across = radius * glm::sqrt(glm::max(Vec3(0.0f), Vec3(1.0f) - direction * direction));
  const Vec3 reach = 1.0001f * (along + across) + 1e-4f * radius;
  return {middle - reach, middle + reach};
}

}  // namespace

PhotonBeamMap::PhotonBeamMap(const std::vector<PhotonBeam>& beams, float radius, float scale)
    : size_(beams.size()), radius_(radius) {
  if (beams.empty()) return;
  const double shortest = shortest_piece(beams, radius);
  const std::vector<Piece> pieces = cut(beams, piece_length(beams, shortest, kBlock * leaves_of(beams, shortest)));
  const LeafOrder tree = sort_pieces(pieces, beams);
  leaves_.resize(tree.leaves);
  owners_.resize(tree.leaves);
  boxes_ = BoxTree(tree.leaves, [&](size_t number) {
    Leaf& leaf = leaves_[number];
    Owners& owners = owners_[number];
    std::fill_n(leaf.half, kBlock, -1.0f);
    Box box;
    const size_t begin = leaf_begin(pieces.size(), tree.leaves, number);
    const size_t end = leaf_begin(pieces.size(), tree.leaves, number + 1);
    for (size_t i = 0; i < end - begin; ++i) {
      const Piece& piece = pieces[tree.order[begin + i]];
      const PhotonBeam& beam = beams[piece.beam];
      const Vec3 middle = middle_of(piece, beam);
      leaf.put(i, middle, beam.direction, piece.half);
      owners.put(i, scale * beam.power, piece.from, piece.beam);
      box.add(box_around(middle, beam.direction, piece.half, radius));
    }
    return box;
  });
  for (const PhotonBeam& beam : beams) {
    bounds_.add(beam.origin);
    bounds_.add(beam.origin + beam.length * beam.direction);
  }
}

PhotonBeamMap::Frame::Frame(const Vec3& direction) : along(direction) { make_frame(direction, right, up); }

void PhotonBeamMap::Leaf::put(size_t i, const Vec3& middle, const Vec3& direction, float half_length) {
  x[i] = middle.x;
  y[i] = middle.y;
  z[i] = middle.z;
  dx[i] = direction.x;
  dy[i] = direction.y;
  dz[i] = direction.z;
  half[i] = half_length;
}

void PhotonBeamMap::Owners::put(size_t i, const Rgb& power, float from_origin, uint32_t number) {
  beam[i] = number;
  from[i] = from_origin;
  r[i] = power.r;
  g[i] = power.g;
  b[i] = power.b;
}

void PhotonBeamMap::Selection::add(const Leaf& leaf, const Owners& owners, size_t i) {
  const size_t number = size_ / kBlock, place = size_ % kBlock;
  if (number == leaves_.size()) {
    leaves_.emplace_back();
    owners_.emplace_back();
  }
  if (place == 0) std::fill_n(leaves_[number].half, kBlock, -1.0f);
  leaves_[number].put(place, {leaf.x[i], leaf.y[i], leaf.z[i]}, {leaf.dx[i], leaf.dy[i], leaf.dz[i]}, leaf.half[i]);
  owners_[number].put(place, {owners.r[i], owners.g[i], owners.b[i]}, owners.from[i], owners.beam[i]);
  ++size_;
}

uint32_t PhotonBeamMap::select(const RayBundle& bundle, Selection& near) const {
  near.radius_ = radius_;
  near.size_ = 0;
  if (size_ == 0) return 0;
  uint32_t visited = 0;
  boxes_.visit_leaves(bundle, [&](uint32_t leaf) {
    for (uint32_t bits = bits_of(test(leaves_[leaf], bundle, radius_)); bits != 0; bits &= bits - 1)
      near.add(leaves_[leaf], owners_[leaf], static_cast<size_t>(std::countr_zero(bits)));
    count(visited, kBlock);
  });
  return visited;
}

size_t PhotonBeamMap::memory_bytes() const {
  return sizeof(*this) + boxes_.memory_bytes() + leaves_.capacity() * (sizeof(Leaf) + sizeof(Owners));
}

}  // namespace vpm
