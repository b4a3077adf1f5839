// Sampling of the pixel filters: each is a product of two equal curves, inverted exactly.
#include "vpm/scene/camera.h"

namespace vpm {

namespace {

/// An offset in [-1, 1] with density 1 - |x|.
float sample_tent(float u) { return u < 0.5f ? std::sqrt(2.0f * u) - 1.0f : 1.0f - std::sqrt(2.0f * (1.0f - u)); }

/// The x with erf(x) = y for 0 <= y <= erf(3 / sqrt 2). Newton's iteration: erf is concave there, so from y sqrt(pi) /
/// 2, which lies below x, every step goes up and none beyond x.
double inverse_erf(double y) {
  double x = 0.5 * std::sqrt(kPiD) * y;
  for (double step = 1.0; step > 1e-12;) {
    step = 0.5 * std::sqrt(kPiD) * std::exp(x * x) * (y - std::erf(x));
    x += step;
  }
  return x;
}

/// An offset in [-1, 1] with a normal density of standard deviation 1/3, cut off at 1.
float sample_gaussian(float u) {
  static const double kEdge = std::erf(3.0 / std::sqrt(2.0));
  const double y = (2.0 * u - 1.0) * kEdge;
  return static_cast<float>(std::copysign(inverse_erf(std::abs(y)) * std::sqrt(2.0) / 3.0, y));
}

float sample_curve(FilterKind kind, float u) {
  switch (kind) {
    case FilterKind::box:
      return 2.0f * u - 1.0f;
    case FilterKind::tent:
      return sample_tent(u);
    case FilterKind::gaussian:
      return sample_gaussian(u);
  }
  __builtin_unreachable();
}

/// The density of sample_curve() at x in [-1, 1].
double curve(FilterKind kind, double x) {
  static const double kGaussian = 3.0 / (std::sqrt(2.0 * kPiD) * std::erf(3.0 / std::sqrt(2.0)));
  switch (kind) {
    case FilterKind::box:
      return 0.5;
    case FilterKind::tent:
      return 1.0 - std::abs(x);
    case FilterKind::gaussian:
      return kGaussian * std::exp(-4.5 * x * x);
  }
  __builtin_unreachable();
}

}  // namespace

double filter_value(const Filter& filter, const Vec2& offset) {
  const Vec2 at = offset / filter.radius;
  if (std::max(std::abs(at.x), std::abs(at.y)) > 1.0f) return 0.0;
  return curve(filter.kind, at.x) * curve(filter.kind, at.y) / (double{filter.radius} * filter.radius);
}

Vec2 sample_filter(const Filter& filter, const Vec2& u) {
  return filter.radius * Vec2(sample_curve(filter.kind, u.x), sample_curve(filter.kind, u.y));
}

}  // namespace vpm
