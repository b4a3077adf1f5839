// The perspective camera and the pixel filters.
#pragma once

#include <optional>

#include "vpm/base/vec.h"
#include "vpm/image/image.h"

namespace vpm {

enum class FilterKind { box, tent, gaussian };

/// The reconstruction filter of a pixel. Pixels draw their samples from it, so that every sample has weight 1 and
/// pixels stay independent [Ernst2006].
struct Filter {
  FilterKind kind = FilterKind::box;
  float radius = 0.5f;  // half width, pixels; a gaussian's standard deviation is a third of it
};
/// An offset from the pixel's center in pixels, distributed as the filter over the square |x|, |y| <= radius. `u` is
/// uniform in [0, 1)^2.
Vec2 sample_filter(const Filter& filter, const Vec2& u);
/// The density of such an offset, 1/pixel^2.
double filter_value(const Filter& filter, const Vec2& offset);

/// Films have at most so many pixels a side.
inline constexpr int kLargestFilm = 32768;

/// The film: its size and how pixels are reconstructed.
struct FilmFormat {
  int width = 256, height = 256;  // pixels, 1 to kLargestFilm
  Filter filter{};
  std::optional<PixelRect> crop{};  // the pixels to render; nothing: all
};

struct Camera {
  Vec3 position{0.0f};                                                             // m
  Vec3 forward{0.0f, 0.0f, -1.0f}, right{1.0f, 0.0f, 0.0f}, up{0.0f, 1.0f, 0.0f};  // orthonormal
  float tan_half_fov = 0.5f;      // of the full vertical angle; pixels are square
  int width = 256, height = 256;  // pixels
  Filter filter;
  std::optional<PixelRect> crop{};  // the pixels to render, some of them; nothing: all

  /// The pixels that are rendered.
  PixelRect rendered() const { return crop.value_or(PixelRect{0, 0, width, height}); }
  /// The ray through film coordinates in pixels: (0, 0) is the image's upper left corner, (width, height) the lower
  /// right.
  Ray ray(const Vec2& film) const;
  /// The film coordinates where light that comes along `towards`, a direction from the camera (unit), meets the film;
  /// nothing for directions that do not point ahead.
  std::optional<Vec2> film_of(const Vec3& towards) const;
  /// The area of the film, pixels^2, for each solid angle about that direction, 1/sr.
  double film_per_angle(const Vec3& towards) const;
};

/// A camera at `position` (m) that looks at `target`. `fov` is the full vertical angle in degrees, in (0, 180). Throws
/// InputError where these define no camera, for a film of no such size, for a crop that is empty or not inside, and for
/// a filter without width.
Camera make_camera(const Vec3& position, const Vec3& target, const Vec3& up, float fov, const FilmFormat& film);

}  // namespace vpm
