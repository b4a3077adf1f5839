// Squares by blocks of squares: those whose rays gather are followed together.
#include "vpm/film/pixel_squares.h"

#include <algorithm>

#include "vpm/estimate/eye_work.h"

namespace vpm {
namespace {

constexpr int kBlockEdge = 8;   // squares, of those whose rays are followed together
constexpr int kSquareEdge = 4;  // of those of a kBlock
static_assert(kBlockEdge * kBlockEdge == kEyeRays && kSquareEdge * kSquareEdge == kBlock);

/// Calls use(begin, end) for the parts of a rectangle that begin every `edge`, row by row.
template <class Use>
void for_each_part(const glm::ivec2& begin, const glm::ivec2& end, int edge, Use&& use) {
  for (int y = begin.y; y < end.y; y += edge)
    for (int x = begin.x; x < end.x; x += edge) use(glm::ivec2(x, y), glm::min(glm::ivec2(x, y) + edge, end));
}

}  // namespace

PixelSquares PixelSquares::draw(int edge, Rng rng) {
  const auto below_edge = [&] { return static_cast<int>(rng.uniform() * static_cast<float>(edge)); };
  PixelSquares squares{edge};
  squares.first = {-below_edge(), -below_edge()};
  squares.leader = {below_edge(), below_edge()};
  return squares;
}

std::vector<glm::ivec2> PixelSquares::tiles_in(const PixelRect& pixels) const {
  std::vector<glm::ivec2> corners;
  const glm::ivec2 from{pixels.x0, pixels.y0};
  for_each_part(from - (from - first) % tile(), {pixels.x1, pixels.y1}, tile(),
                [&](const glm::ivec2& corner, const glm::ivec2&) { corners.push_back(corner); });
  return corners;
}

PixelOrder::PixelOrder(const glm::ivec2& corner, const glm::ivec2& size, const PixelSquares& squares)
    : size_(size), lattice_(squares) {
  for_each_part(corner, corner + squares.tile(), kBlockEdge * squares.edge,
                [&](const glm::ivec2& block, const glm::ivec2& block_end) {
                  for_each_part(block, block_end, kSquareEdge * squares.edge,
                                [&](const glm::ivec2& some, const glm::ivec2& some_end) {
                                  for_each_part(some, some_end, squares.edge,
                                                [&](const glm::ivec2& one, const glm::ivec2&) { add_square(one); });
                                });
                  if (items_.size() > (ends_.empty() ? 0 : ends_.back())) ends_.push_back(items_.size());
                });
  for (size_t i = 0; i < rest_.size(); i += kEyeRays)
    ends_.push_back(items_.size() + std::min(i + kEyeRays, rest_.size()));
  items_.insert(items_.end(), rest_.begin(), rest_.end());
}

void PixelOrder::add_square(const glm::ivec2& begin) {
  const auto in_picture = [&](const glm::ivec2& p) { return p.x >= 0 && p.y >= 0 && p.x < size_.x && p.y < size_.y; };
  const glm::ivec2 leader = begin + lattice_.leader;
  const bool led = in_picture(leader);
  for_each_part(begin, begin + lattice_.edge, 1, [&](const glm::ivec2& pixel, const glm::ivec2&) {
    if (pixel != leader && in_picture(pixel)) rest_.push_back({pixel, led ? squares_ : -1, false});
  });
  if (!led) return;
  items_.push_back({leader, squares_, true});
  ++squares_;
}

}  // namespace vpm
