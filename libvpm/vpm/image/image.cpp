// Rows of a rectangle.
#include "vpm/image/image.h"

#include <algorithm>

namespace vpm {

Image cropped(const Image& image, const PixelRect& rect) {
  assert(lies_in(rect, image.width, image.height));
  Image part(rect.width(), rect.height());
  for (int y = 0; y < part.height; ++y) std::copy_n(&image.at(rect.x0, rect.y0 + y), part.width, &part.at(0, y));
  return part;
}

}  // namespace vpm
