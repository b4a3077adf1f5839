// Marching an eye ray through a medium. The step size may change cost and noise, but never brightness.
//
// The integral of Tr(t) density(t) f(t) over the ray is cut into steps. Each step takes ONE sample of f, at a point
// drawn in proportion to density times the transmittance of the thickest channel, and weights it, in that channel, by
// the exact integral of Tr(t) density(t) over the step. Density integrals come from the exact quartics of the cells, so
// the result is unbiased for any step. For f = 1 it is (1 - Tr)/sigma_t without noise in the thickest channel, up to
// where Russian roulette begins.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "vpm/base/cancel.h"
#include "vpm/base/counters.h"
#include "vpm/base/rng.h"
#include "vpm/medium/grid/density_integrals_along.h"
#include "vpm/photon/kernel.h"

namespace vpm {

/// How fine steps are, and for what.
struct StepLimits {
  float length = kInfinity;   // m, > 0; finite in endless media
  float optical = kInfinity;  // optical thickness of the thickest channel, > 0
  glm::bvec3 matters{true};   // channels whose integrand is not 0
};

/// The outcome of a march.
struct Marched {
  double integral = 0.0;  // of the whole interval, m: exact
  uint32_t lookups = 0;   // of density
  uint32_t steps = 0;
};

/// Marches eye rays. Keeps its buffers between calls: one for each thread.
class Marcher {
 public:
  /// Calls add(point, weight) for each step. The sum of weight * f(point), per channel, estimates the integral of Tr
  /// density f over the interval (weights are in m). Where the transmittance of all channels that matter is below 1 %,
  /// the march goes on by Russian roulette, so that it ends in endless media.
  template <class Add>
  Marched march(const Medium& medium, const Ray& ray, const Interval& interval, const StepLimits& limits, Rng& rng,
                Add&& add);

 private:
  /// The part of a piece that lies in the present step.
  struct Part {
    DensityPiece piece;
    double s0;        // m from the piece's start
    double integral;  // m
  };

  /// Adds a part of a piece to the step. The part starts at `s` (m from the start of the piece) and is at most `length`
  /// m long; it ends early where the density integral of the step reaches `most_integral`, m. Returns where the part
  /// ends, m from the start of the piece.
  double extend(const DensityPiece& piece, double s, double length, double most_integral);
  /// Returns the distance along the ray, m, at which the step's density integral reaches `integral`, m.
  double locate(double integral) const;

  std::vector<Part> parts_;
  double integral_ = 0.0;  // of the step so far, m
};

/// The integral of exp(-sigma c) over c in [0, integral]: (1 - exp(-sigma integral))/sigma. Its limit for sigma -> 0 is
/// `integral`.
inline double attenuated_integral(double sigma, double integral) {
  return sigma * integral > 1e-8 ? -std::expm1(-sigma * integral) / sigma : integral;
}

/// Draws a density integral c in [0, integral] with a probability density proportional to exp(-sigma c), by a uniform
/// number u in [0, 1).
inline double draw_attenuated(double sigma, double integral, double u) {
  return sigma * integral > 1e-8 ? -std::log1p(u * std::expm1(-sigma * integral)) / sigma : u * integral;
}

/// A ray, and the medium that its light passes on the way to the eye.
struct SeenThrough {
  const Ray& ray;
  const DensityIntegralsAlong& integrals;  // along the ray
  Rgb sigma_t{0.0f};                       // 1/m at density 1
};

/// Cuts the interval, which must be finite, into equal parts of at most `length` m, and calls add(point, weight) for a
/// point drawn uniformly in each. The sum of weight * f(point) estimates the integral of Tr f over the interval, with
/// the transmittance to seen_at(t) for the distance t, m.
template <class Add, class SeenAt = std::identity>
void march_evenly(const SeenThrough& seen, const Interval& interval, float length, Rng& rng, Add&& add,
                  SeenAt&& seen_at = {}) {
  const auto strata = static_cast<uint32_t>(std::max(1.0f, std::ceil(interval.length() / length)));
  const double width = static_cast<double>(interval.length()) / strata;
  double t = interval.t0 + rng.uniform_double() * width;
  for (uint32_t next = 0; next < strata;) {
    cancellation_point();
    const auto integral = static_cast<float>(seen.integrals.at(seen_at(t)).integral);
    add(seen.ray.at(static_cast<float>(t)), glm::exp(-seen.sigma_t * integral) * static_cast<float>(width));
    t = interval.t0 + (++next + rng.uniform_double()) * width;
  }
}

/// The sum of length times sum_at(point) over points of an interval of a ray, one drawn uniformly in each of its equal
/// parts of at most `length` m: of light, W/(m^3 sr), that is attenuated to the eye already. most_seen(t) is no less
/// than the share of light that comes to the eye from the surroundings of the distance t, m. Where it is below 1 %, the
/// march goes on by Russian roulette.
template <class MostSeen, class SumAt>
KernelEstimate march_seen(const Ray& ray, const Interval& interval, float length, Rng& rng, MostSeen&& most_seen,
                          SumAt&& sum_at) {
  constexpr float kRouletteBelow = 0.01f;
  const auto strata = static_cast<uint32_t>(std::max(1.0f, std::ceil(interval.length() / length)));
  const float width = interval.length() / static_cast<float>(strata);
  KernelPair<Rgbd> sum;
  float scale = width;  // of what survived roulette, m
  for (uint32_t i = 0; i < strata && scale > 0.0f; ++i) {
    cancellation_point();
    const float t = interval.t0 + (static_cast<float>(i) + rng.uniform()) * width;
    const KernelEstimate seen = sum_at(ray.at(t));
    sum += {Rgbd(scale * seen.value), Rgbd(scale * seen.correction)};
    if (most_seen(t) * scale < kRouletteBelow * width) scale = rng.uniform() < 0.5f ? 2.0f * scale : 0.0f;
  }
  return {Rgb(sum.value), Rgb(sum.correction)};
}

inline double Marcher::extend(const DensityPiece& piece, double s, double length, double most_integral) {
  double end = std::min(piece.length(), s + length);
  const double before = piece.integral(s);
  double here = std::max(0.0, piece.integral(end) - before);
  if (integral_ + here >= most_integral) {
    here = most_integral - integral_;
    end = std::max(s, piece.invert(before + here));
  }
  parts_.push_back({piece, s, here});
  integral_ += here;
  return end;
}

inline double Marcher::locate(double integral) const {
  for (const Part& part : parts_) {
    if (integral <= part.integral || &part == &parts_.back())
      return part.piece.t0 + part.piece.invert(part.piece.integral(part.s0) + std::min(integral, part.integral));
    integral -= part.integral;
  }
  return 0.0;
}

template <class Add>
Marched Marcher::march(const Medium& medium, const Ray& ray, const Interval& interval, const StepLimits& limits,
                       Rng& rng, Add&& add) {
  constexpr double kRouletteBelow = 0.01;
  const Rgbd sigma_t(medium.sigma_t);
  const double thickest = std::max(sigma_t.r, std::max(sigma_t.g, sigma_t.b));
  double thinnest = thickest;
  for (int c = 0; c < 3; ++c)
    if (limits.matters[c]) thinnest = std::min(thinnest, sigma_t[c]);
  const double most_integral = thickest > 0.0 ? limits.optical / thickest : static_cast<double>(kInfinity);
  Marched result;
  double crossed = 0.0;  // density integral before the present step, m
  double scale = 1.0;    // of what survived roulette
  double start = 0.0;    // of the present step
  parts_.clear();
  integral_ = 0.0;
  const auto finish_step = [&] {
    cancellation_point();
    if (integral_ > 0.0) {
      const double c = draw_attenuated(thickest, integral_, rng.uniform_double());
      const double per_density = attenuated_integral(thickest, integral_) * scale;
      add(ray.at(static_cast<float>(locate(c))), Rgb(glm::exp(-sigma_t * (crossed + c) + thickest * c) * per_density));
      count(result.steps);
      crossed += integral_;
    }
    parts_.clear();
    integral_ = 0.0;
    if (std::exp(-thinnest * crossed) * scale >= kRouletteBelow) return;
    scale = rng.uniform() < 0.5f ? 2.0 * scale : 0.0;
  };
  result.lookups = medium.visit_pieces(ray, interval, [&](const DensityPiece& piece) {
    result.integral += piece.integral();
    for (double s = 0.0; s < piece.length() && scale > 0.0;) {
      const double t = piece.t0 + s;
      if (parts_.empty()) start = t;
      const double left = start + limits.length - t;
      if (!(s + left > s)) {  // the step is used up: by empty space, or to the last bit
        finish_step();
        continue;
      }
      s = extend(piece, s, left, most_integral);
      if (integral_ >= most_integral || piece.t0 + s - start >= limits.length) finish_step();
    }
    return true;
  });
  if (scale > 0.0) finish_step();
  return result;
}

}  // namespace vpm
