// Looking up images by texture coordinates.
#include "vpm/surface/material/texture.h"

#include <algorithm>
#include <cassert>

namespace vpm {

namespace {

/// Where a coordinate stands among `count` texels, in [0, count].
float wrapped(float coordinate, int count) { return (coordinate - std::floor(coordinate)) * static_cast<float>(count); }

/// The two texels next to a place among `count`, and the weight of the second.
struct Neighbours {
  int first, second;
  float weight;
};
Neighbours neighbours_of(float place, int count) {
  const float from_first_center = place - 0.5f;
  const float below = std::floor(from_first_center);
  const int first = static_cast<int>(below);  // from -1 to count - 1
  return {first < 0 ? count - 1 : first, first + 1 < count ? first + 1 : 0, from_first_center - below};
}

}  // namespace

Texture::Texture(Image image, TextureFilter filter) : image_(std::move(image)), filter_(filter) {
  assert(!image_.pixels.empty());
  Rgbd sum(0.0);
  for (const Rgb& texel : image_.pixels) {
    sum += Rgbd(texel);
    grey_ = grey_ && is_grey(texel);
  }
  mean_ = Rgb(sum / static_cast<double>(image_.pixels.size()));
}

Rgb Texture::bilinear(const Vec2& uv) const {
  const Neighbours x = neighbours_of(wrapped(uv.x, image_.width), image_.width);
  const Neighbours y = neighbours_of(wrapped(-uv.y, image_.height), image_.height);
  const auto row = [&](int at) { return glm::mix(image_.at(x.first, at), image_.at(x.second, at), x.weight); };
  return glm::mix(row(y.first), row(y.second), y.weight);
}

Rgb Texture::nearest(const Vec2& uv) const {
  const auto texel = [](float place, int count) { return std::min(static_cast<int>(place), count - 1); };
  return image_.at(texel(wrapped(uv.x, image_.width), image_.width),
                   texel(wrapped(-uv.y, image_.height), image_.height));
}

}  // namespace vpm
