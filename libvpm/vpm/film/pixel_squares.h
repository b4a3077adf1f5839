// In which order the rays of pixels are followed, where one of each square of pixels gathers for all (SharedGather).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "vpm/base/rng.h"
#include "vpm/base/vec.h"
#include "vpm/image/image.h"

namespace vpm {

/// A lattice of squares over the pixels, and the place in all of them of the pixel that gathers. Tiles of squares are
/// chunks of parallel work.
struct PixelSquares {
  static constexpr int kTile = 16;  // pixels along an edge of a tile, at the most

  int edge = 1;             // pixels; 1: each pixel gathers for itself
  glm::ivec2 first{0, 0};   // a corner of the lattice, from -edge + 1 to 0
  glm::ivec2 leader{0, 0};  // of a square, from 0 to edge - 1

  /// Those of a pass.
  static PixelSquares draw(int edge, Rng rng);
  /// The edge of a tile, pixels.
  int tile() const { return kTile / edge * edge; }
  /// The corners of the tiles that meet a rectangle.
  std::vector<glm::ivec2> tiles_in(const PixelRect& pixels) const;
};

/// The pixels of a tile.
class PixelOrder {
 public:
  struct Item {
    glm::ivec2 pixel;
    int square;  // counted in the tile; -1: the pixel gathers for itself, as that of the square lies off the picture
    bool leads;  // does it gather for its square?
  };

  /// Of the tile of squares whose first pixel is `corner`, what lies in a picture of `size` pixels.
  PixelOrder(const glm::ivec2& corner, const glm::ivec2& size, const PixelSquares& squares);

  /// First those that gather for others, then the rest.
  std::span<const Item> items() const { return items_; }
  /// Where bundles end whose rays are followed together: at most kEyeRays each, in which kBlock after kBlock lie side
  /// by side. Those of a bundle gather for others, or none does.
  std::span<const size_t> ends() const { return ends_; }
  int squares() const { return squares_; }

 private:
  void add_square(const glm::ivec2& begin);

  glm::ivec2 size_;
  PixelSquares lattice_;
  int squares_ = 0;
  std::vector<Item> items_, rest_;
  std::vector<size_t> ends_;
};

}  // namespace vpm
