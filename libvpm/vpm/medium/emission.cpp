// A walk along the pieces of the densities and those of the source, from border to border of either.
#include "vpm/medium/emission.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "vpm/base/counters.h"
#include "vpm/medium/blackbody.h"
#include "vpm/medium/medium.h"

namespace vpm {
namespace {

constexpr double kOpaque = 25.0;  // optical depth

/// The density integral of a part of a piece, m; 0 of none.
double integral_of(const DensityPiece* density, double t0, double t1) {
  return density ? density->integral(t1 - density->t0) - density->integral(t0 - density->t0) : 0.0;
}

/// A part of a ray within one piece of the source, and of the density or none.
class Part {
 public:
  Part(const Medium& medium, const DensityPiece* density, const DensityPiece& source, double before)
      : emission_(*medium.emission),
        sigma_a_(medium.sigma_t - medium.sigma_s),
        sigma_t_(medium.sigma_t),
        density_(density),
        source_(source),
        before_(before) {}

  /// From t0, at which the density integral is `before`, to t1.
  Rgbd emitted(double t0, double t1) const {
    const bool thermal = emission_.meaning == MediumEmission::Meaning::thermal;
    if (thermal && !density_) return Rgbd(0.0);
    if (source_.uniform() && thermal) return even_source(t0, t1);
    if (source_.uniform() && (!density_ || density_->uniform())) return even_emission(t0, t1);
    return by_points(t0, t1, t0, kMostHalvings);
  }

 private:
  static constexpr int kMostHalvings = 12;

  double kept(int channel, double integral) const { return std::exp(-double{sigma_t_[channel]} * integral); }
  double value(double t) const { return std::max(0.0, source_.density(t - source_.t0)); }

  Rgbd even_source(double t0, double t1) const {
    const Rgbd source = emission_.source(source_.c0);
    const double crossed = integral_of(density_, t0, t1);
    Rgbd sum(0.0);
    for (int c = 0; c < 3; ++c)
      if (sigma_a_[c] > 0.0f)
        sum[c] = sigma_a_[c] / sigma_t_[c] * source[c] * kept(c, before_) * -std::expm1(-sigma_t_[c] * crossed);
    return sum;
  }

  Rgbd even_emission(double t0, double t1) const {
    const Rgbd source = emission_.source(source_.c0);
    const double density = density_ ? density_->c0 : 0.0, length = t1 - t0;
    Rgbd sum(0.0);
    for (int c = 0; c < 3; ++c) {
      const double sigma = sigma_t_[c] * density;
      sum[c] = source[c] * kept(c, before_) * (sigma > 0.0 ? -std::expm1(-sigma * length) / sigma : length);
    }
    return sum;
  }

  /// Halves the part until it is smooth enough for five points; `begin` is where the density integral is `before`.
  Rgbd by_points(double t0, double t1, double begin, int halvings) const {
    constexpr double kMostDepth = 1.0, kMostHotter = 1.15;
    double largest = 0.0;  // of the channels that are not opaque yet
    const double crossed_before = before_ + integral_of(density_, begin, t0);
    for (int c = 0; c < 3; ++c)
      if (sigma_t_[c] * crossed_before < kOpaque) largest = std::max(largest, double{sigma_t_[c]});
    bool rough = largest * integral_of(density_, t0, t1) > kMostDepth;
    if (emission_.blackbody) {
      const auto kelvin = [&](double t) { return std::max(kColdestSeen, emission_.kelvin(value(t))); };
      const std::array<double, 3> three{kelvin(t0), kelvin(0.5 * (t0 + t1)), kelvin(t1)};
      const auto [coldest, hottest] = std::minmax_element(three.begin(), three.end());
      rough |= *hottest > kMostHotter * *coldest;
    }
    if (rough && halvings > 0) {
      const double middle = 0.5 * (t0 + t1);
      return by_points(t0, middle, begin, halvings - 1) + by_points(middle, t1, begin, halvings - 1);
    }
    static constexpr std::array<double, 5> kPlaces{0.04691007703066800, 0.23076534494715845, 0.5, 0.76923465505284155,
                                                   0.95308992296933200};
    static constexpr std::array<double, 5> kWeights{0.11846344252809454, 0.23931433524968324, 0.28444444444444444,
                                                    0.23931433524968324, 0.11846344252809454};
    Rgbd sum(0.0);
    for (size_t i = 0; i < kPlaces.size(); ++i) {
      const double t = t0 + kPlaces[i] * (t1 - t0), weight = kWeights[i] * (t1 - t0);
      const Rgbd source = emission_.source(value(t));
      if (source == Rgbd(0.0)) continue;
      const double density = density_ ? std::max(0.0, density_->density(t - density_->t0)) : 0.0;
      const double crossed = before_ + integral_of(density_, begin, t);
      const bool thermal = emission_.meaning == MediumEmission::Meaning::thermal;
      for (int c = 0; c < 3; ++c)
        sum[c] += weight * (thermal ? sigma_a_[c] * density : 1.0) * source[c] * kept(c, crossed);
    }
    return sum;
  }

  const MediumEmission& emission_;
  const Rgb sigma_a_, sigma_t_;
  const DensityPiece* density_;
  const DensityPiece& source_;
  const double before_;
};

/// The pieces of a grid along a ray; one of the value 1 where there is none.
uint32_t find_pieces(const DensityGrid* grid, const Ray& ray, const Interval& interval,
                     std::vector<DensityPiece>& pieces) {
  pieces.clear();
  if (!grid) {
    pieces.push_back({interval.t0, interval.t1, 1.0, 0.0, 0.0, 0.0});
    return 0;
  }
  return grid->visit_pieces(ray, interval, [&](const DensityPiece& piece) {
    pieces.push_back(piece);
    return true;
  });
}

}  // namespace

Rgbd MediumEmission::source(double value) const {
  if (!(value > 0.0)) return Rgbd(0.0);
  return blackbody ? Rgbd(colour) * vpm::blackbody(kelvin(value)) : Rgbd(colour) * value;
}

Rgbd emission_coefficient(const Medium& medium, const Vec3& place) {
  const MediumEmission& emission = *medium.emission;
  const Rgbd source = emission.source(medium.emission_grid ? medium.emission_grid->density(place) : 1.0f);
  if (emission.meaning == MediumEmission::Meaning::volume) return source;
  return Rgbd(medium.properties(place).sigma_a()) * double{medium.density(place)} * source;
}

EmittedLight emitted_along(const Medium& medium, const Ray& ray, const Interval& interval, uint64_t& lookups) {
  static thread_local std::vector<DensityPiece> densities, sources;
  count(lookups, find_pieces(medium.grid.get(), ray, interval, densities));
  count(lookups, find_pieces(medium.emission_grid.get(), ray, interval, sources));
  const double opaque =
      kOpaque / std::max(1e-30, double{std::min({medium.sigma_t.r, medium.sigma_t.g, medium.sigma_t.b})});
  EmittedLight light;
  Rgbd sum(0.0);
  double at = interval.t0;
  for (size_t d = 0, s = 0; d < densities.size() || s < sources.size();) {
    if (s < sources.size() && at >= sources[s].t1) {
      ++s;
      continue;
    }
    if (d < densities.size() && at >= densities[d].t1) {
      ++d;
      continue;
    }
    const bool in_source = s < sources.size() && at >= sources[s].t0;
    const bool in_density = d < densities.size() && at >= densities[d].t0;
    double next = kInfinity;
    if (s < sources.size()) next = in_source ? sources[s].t1 : sources[s].t0;
    if (d < densities.size()) next = std::min(next, in_density ? densities[d].t1 : densities[d].t0);
    const DensityPiece* density = in_density ? &densities[d] : nullptr;
    if (in_source && light.integral < opaque)
      sum += Part(medium, density, sources[s], light.integral).emitted(at, next);
    light.integral += integral_of(density, at, next);
    at = next;
  }
  light.radiance = Rgb(sum);
  return light;
}

}  // namespace vpm
