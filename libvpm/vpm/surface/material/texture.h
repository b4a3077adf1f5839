// Images on surfaces: a colour at every pair of texture coordinates.
#pragma once

#include "vpm/image/image.h"

namespace vpm {

/// How colours between the centers of texels are found.
enum class TextureFilter { bilinear, nearest };

/// A picture over the unit square, repeated in both directions: u runs along its rows from the left, v along its
/// columns from the bottom. Texels stand for the centers of their cells.
class Texture {
 public:
  /// `image` has at least one pixel.
  Texture(Image image, TextureFilter filter);

  /// The colour at finite coordinates.
  Rgb at(const Vec2& uv) const { return filter_ == TextureFilter::bilinear ? bilinear(uv) : nearest(uv); }
  /// The mean over the unit square, for either filter.
  const Rgb& mean() const { return mean_; }
  /// Are the channels of every texel equal?
  bool grey() const { return grey_; }
  size_t memory_bytes() const { return image_.pixels.size() * sizeof(Rgb); }

 private:
  Rgb bilinear(const Vec2& uv) const;
  Rgb nearest(const Vec2& uv) const;

  Image image_;
  TextureFilter filter_;
  Rgb mean_{0.0f};
  bool grey_ = true;
};

}  // namespace vpm
