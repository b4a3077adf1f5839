// A picture of the radiance that arrives from everywhere.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "vpm/base/vec.h"

namespace vpm {

/// How directions lie in the picture, whose upper left corner is (0, 0), and whose lower right one is (1, 1).
enum class SkyMapping {
  /// Latitude and longitude, as OpenEXR has it [Kainz2013]: the upper edge is +y, the middle
  /// +z, the left quarter +x, so that what is seen from within is not mirrored.
  equirectangular,
  /// A square, of which equal areas are equal solid angles [Clarberg2008], as pbrt-v4 has it: the middle is +z, the
  /// right edge's middle +x, the lower one's +y, and the corners are -z.
  equal_area,
};

/// Radiance by direction, piecewise constant over a picture's pixels. Sampled by luminance.
class ImageEnvironment {
 public:
  /// `texels`: width * height radiances in W/(m^2 sr), rows from the top. `rotation` turns the directions of the
  /// mapping into those of the scene. Throws InputError unless all texels are finite and >= 0, and not all black, and
  /// where a picture of equal areas is no square.
  ImageEnvironment(int width, int height, std::vector<Rgb> texels, SkyMapping mapping = SkyMapping::equirectangular,
                   const Mat3d& rotation = Mat3d(1.0));
  /// Radiance that arrives from direction `d` (unit, pointing away from the scene).
  Rgb radiance(const Vec3& d) const { return texels_[texel_at(d)]; }
  /// A direction away from the scene, distributed as pdf(): the uniform number `choice` picks the texel, `u` the place
  /// in it.
  struct Sample {
    Vec3 direction{0.0f};  // unit
    float pdf = 0.0f;      // of the sampled texel, 1/sr
    Rgb radiance{0.0f};    // of the sampled texel, even if rounding puts the direction into its neighbour
  };
  Sample sample(double choice, const Vec2& u) const;
  /// The density of sample() at `d`, 1/sr: the luminance over its integral.
  float pdf(const Vec3& d) const;
  /// Integral of radiance over the sphere, W/m^2.
  Rgbd integral() const { return integral_; }
  /// Integrals over the sphere of radiance times |cosine| to the x, y and z axes, W/m^2: the power per area that passes
  /// a plane perpendicular to each axis, from both sides together. To 1e-5 of them, unless the picture is a mere strip.
  const std::array<Rgbd, 3>& flux_across() const { return flux_across_; }
  /// Are all texels grey?
  bool grey() const { return grey_; }
  size_t memory_bytes() const { return texels_.size() * sizeof(Rgb) + cumulative_.size() * sizeof(double); }

 private:
  size_t texel_at(const Vec3& d) const;
  double solid_angle(int row) const;
  Vec3d direction_in(int column, int row, double u, double v) const;
  Vec3d mean_cosines(int column, int row) const;

  int width_ = 0, height_ = 0;
  SkyMapping mapping_;
  Mat3d rotation_;
  std::vector<Rgb> texels_;
  std::vector<double> cumulative_;  // of luminance times solid angle, size width * height + 1
  Rgbd integral_{0.0};
  std::array<Rgbd, 3> flux_across_{};
  bool grey_ = false;
};

}  // namespace vpm
