#include "vpm/study/exact/profile.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "vpm/study/exact/quadrature.h"

namespace vpm::exact {

namespace {

constexpr double kRounding = 8.0 * std::numeric_limits<double>::epsilon();

double extinction_of(const ConstantProfile& p, double) { return p.sigma_t; }
double extinction_of(const RampProfile& p, double t) { return p.start + p.slope * t; }
double extinction_of(const ExponentialProfile& p, double t) { return p.start * std::exp(-p.rate * t); }
double extinction_of(const GaussianProfile& p, double t) {
  const double x = (t - p.center) / p.width;
  return p.peak * std::exp(-0.5 * x * x);
}
double extinction_of(const LayeredProfile& p, double t) {
  const auto i = std::upper_bound(p.ends.begin(), p.ends.end(), t) - p.ends.begin();
  return p.values[std::min<size_t>(i, p.values.size() - 1)];
}
double extinction_of(const CubicProfile& p, double t) { return p.c[0] + t * (p.c[1] + t * (p.c[2] + t * p.c[3])); }

Bounded thickness_of(const ConstantProfile& p, double t) { return {p.sigma_t * t, kRounding * p.sigma_t * t}; }
Bounded thickness_of(const RampProfile& p, double t) {
  return {t * (p.start + 0.5 * p.slope * t), kRounding * t * (p.start + std::fabs(0.5 * p.slope * t))};
}
Bounded thickness_of(const ExponentialProfile& p, double t) {
  const double tau = p.rate == 0.0 ? p.start * t : -p.start * std::expm1(-p.rate * t) / p.rate;
  return {tau, kRounding * tau};
}
Bounded thickness_of(const GaussianProfile& p, double t) {
  const double unit = p.width * std::sqrt(2.0), from = -p.center / unit, to = (t - p.center) / unit;
  // On one side of the center, the complements differ without cancelling as much. Arguments are as good as rounding.
  const auto size = [](double value, double x) { return std::fabs(value) + std::fabs(x) * std::exp(-x * x); };
  const auto difference = [&](double a, double b) {
    const double scale = p.peak * unit * 0.5 * std::sqrt(kPiD);
    return Bounded{scale * (a - b), kRounding * scale * (size(a, from) + size(b, to))};
  };
  if (to < 0.0) return difference(std::erfc(-to), std::erfc(-from));
  if (from > 0.0) return difference(std::erfc(from), std::erfc(to));
  return difference(std::erf(to), std::erf(from));
}
Bounded thickness_of(const LayeredProfile& p, double t) {
  double tau = 0.0, begin = 0.0;
  for (size_t i = 0; i < p.ends.size() && begin < t; begin = p.ends[i++])
    tau += p.values[i] * (std::min(t, p.ends[i]) - begin);
  return {tau, kRounding * tau};
}
Bounded thickness_of(const CubicProfile& p, double t) {
  const auto sum = [t](double a, double b, double c, double d) {
    return t * (a + t * (b / 2.0 + t * (c / 3.0 + t * d / 4.0)));
  };
  return {sum(p.c[0], p.c[1], p.c[2], p.c[3]),
          kRounding * sum(std::fabs(p.c[0]), std::fabs(p.c[1]), std::fabs(p.c[2]), std::fabs(p.c[3]))};
}

/// The t in [0, length] where the thickness is tau, by Newton's steps kept inside a shrinking bracket: extinction may
/// vanish anywhere in it.
template <class Shape>
double search(const Shape& shape, double length, double tau) {
  double lo = 0.0, hi = length, t = 0.5 * length;
  for (int i = 0; i < 200; ++i) {
    const double excess = thickness_of(shape, t).value - tau;
    if (excess == 0.0) return t;
    (excess < 0.0 ? lo : hi) = t;
    const double step = excess / extinction_of(shape, t);
    const double next = t - step > lo && t - step < hi ? t - step : 0.5 * (lo + hi);
    if (std::fabs(next - t) <= 1e-16 * t) return next;
    t = next;
  }
  return t;
}

// Distances at which the thickness is tau > 0, no more than that of the whole ray.
double distance_of(const ConstantProfile& p, double, double tau) { return tau / p.sigma_t; }
double distance_of(const RampProfile& p, double, double tau) {
  const double square = p.start * p.start + 2.0 * p.slope * tau;  // of sigma_t there: below 0 by rounding only
  return 2.0 * tau / (p.start + std::sqrt(std::max(0.0, square)));
}
double distance_of(const ExponentialProfile& p, double, double tau) {
  return p.rate == 0.0 ? tau / p.start : -std::log1p(-p.rate * tau / p.start) / p.rate;
}
double distance_of(const GaussianProfile& p, double length, double tau) { return search(p, length, tau); }
double distance_of(const LayeredProfile& p, double length, double tau) {
  double begin = 0.0;
  for (size_t i = 0; i < p.ends.size(); begin = p.ends[i++]) {
    const double layer = p.values[i] * (p.ends[i] - begin);
    if (tau <= layer && layer > 0.0) return begin + tau / p.values[i];
    tau -= layer;
  }
  return length;  // what rounding left over
}
double distance_of(const CubicProfile& p, double length, double tau) { return search(p, length, tau); }

std::optional<double> distance_at(const Profile& profile, double tau) {
  if (tau > optical_thickness(profile, profile.length).value) return std::nullopt;
  if (tau == 0.0) return 0.0;
  const double t = std::visit([&](const auto& p) { return distance_of(p, profile.length, tau); }, profile.shape);
  return std::min(t, profile.length);
}

using Polynomial = std::array<double, 4>;

/// a + (b - a) (x0 + slope t), for polynomials a and b in t of degree 2 at most.
Polynomial mix(const Polynomial& a, const Polynomial& b, double x0, double slope) {
  Polynomial sum = a;
  for (size_t i = 0; i < 4; ++i) {
    sum[i] += (b[i] - a[i]) * x0;
    if (i > 0) sum[i] += (b[i - 1] - a[i - 1]) * slope;
  }
  return sum;
}

}  // namespace

Profile voxel_profile(const double (&corners)[2][2][2], double scale, const Vec3d& p0, const Vec3d& p1) {
  const double length = glm::length(p1 - p0);
  const Vec3d slope = (p1 - p0) / length;
  const auto along_z = [&](int x, int y) { return mix({corners[x][y][0]}, {corners[x][y][1]}, p0.z, slope.z); };
  const auto along_yz = [&](int x) { return mix(along_z(x, 0), along_z(x, 1), p0.y, slope.y); };
  Polynomial sum = mix(along_yz(0), along_yz(1), p0.x, slope.x);
  for (double& c : sum) c *= scale;
  return {CubicProfile{sum}, length};
}

double extinction(const Profile& profile, double t) {
  return std::visit([&](const auto& p) { return extinction_of(p, t); }, profile.shape);
}

Bounded optical_thickness(const Profile& profile, double t) {
  assert(t >= 0.0 && t <= profile.length);
  return std::visit([&](const auto& p) { return thickness_of(p, t); }, profile.shape);
}

Bounded transmittance(const Profile& profile, double t) {
  const Bounded tau = optical_thickness(profile, t);
  const double value = std::exp(-tau.value);
  return {value, value * (tau.error + kRounding)};
}

Bounded collision_cdf(const Profile& profile, double t) {
  const Bounded tau = optical_thickness(profile, t);
  const double value = -std::expm1(-tau.value);
  return {value, std::exp(-tau.value) * tau.error + kRounding * value};
}

std::optional<Bounded> flight_quantile(const Profile& profile, double u) {
  assert(u >= 0.0 && u < 1.0);
  const std::optional<double> t = distance_at(profile, -std::log1p(-u));
  if (!t) return std::nullopt;
  if (*t == 0.0) return Bounded{0.0, 0.0};
  // A thickness wrong by rounding moves the place by that over the extinction there.
  const Bounded tau = optical_thickness(profile, *t);
  return Bounded{*t, kRounding * *t + (tau.error + kRounding * tau.value) / extinction(profile, *t)};
}

Bounded mean_flight(const Profile& profile) {
  // Cut where transmittance has its features: after a few free paths, and at the edges of layers.
  std::vector<double> cuts{0.0, profile.length};
  for (const double tau : {1.0, 37.0})
    if (const std::optional<double> t = distance_at(profile, tau)) cuts.push_back(*t);
  if (const auto* layered = std::get_if<LayeredProfile>(&profile.shape))
    cuts.insert(cuts.end(), layered->ends.begin(), layered->ends.end());
  std::sort(cuts.begin(), cuts.end());
  Bounded sum;
  for (size_t i = 0; i + 1 < cuts.size(); ++i) {
    if (cuts[i] == cuts[i + 1]) continue;
    const auto pass = [&](double t) { return std::exp(-optical_thickness(profile, t).value); };
    const Bounded piece = integrate(pass, cuts[i], cuts[i + 1]);
    sum.value += piece.value;
    sum.error += piece.error;
  }
  sum.error += kRounding * sum.value;
  return sum;
}

}  // namespace vpm::exact
