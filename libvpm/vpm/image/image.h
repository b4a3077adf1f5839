// A picture in memory: rows from the top, three float channels. And parts of pictures.
#pragma once

#include <cassert>
#include <vector>

#include "vpm/base/vec.h"

namespace vpm {

struct Image {
  int width = 0, height = 0;
  std::vector<Rgb> pixels;

  Image() = default;
  Image(int w, int h) : width(w), height(h), pixels(static_cast<size_t>(w) * h, Rgb(0.0f)) {}
  Rgb& at(int x, int y) { return pixels[static_cast<size_t>(y) * width + x]; }
  const Rgb& at(int x, int y) const { return pixels[static_cast<size_t>(y) * width + x]; }
};

/// A rectangle of pixels, counted from the upper left corner, without the column x1 and the row y1.
struct PixelRect {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;

  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
  bool operator==(const PixelRect&) const = default;
};

/// Has it a pixel, and all of its pixels in a picture of that size?
constexpr bool lies_in(const PixelRect& rect, int width, int height) {
  return 0 <= rect.x0 && rect.x0 < rect.x1 && rect.x1 <= width && 0 <= rect.y0 && rect.y0 < rect.y1 &&
         rect.y1 <= height;
}

/// The pixels that both have; none may be: then x1 <= x0 or y1 <= y0.
constexpr PixelRect common_pixels(const PixelRect& a, const PixelRect& b) {
  return {a.x0 > b.x0 ? a.x0 : b.x0, a.y0 > b.y0 ? a.y0 : b.y0, a.x1 < b.x1 ? a.x1 : b.x1, a.y1 < b.y1 ? a.y1 : b.y1};
}

/// That part, which lies in the image.
Image cropped(const Image& image, const PixelRect& rect);

}  // namespace vpm
