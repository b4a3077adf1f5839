#include "vpm/study/exact/quadrature.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <queue>

namespace vpm::exact {

namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

/// One implicit QL sweep with a Wilkinson shift on rows l to m; `z` is the first row of the eigenvectors.
void ql_sweep(std::vector<double>& d, std::vector<double>& e, std::vector<double>& z, size_t l, size_t m) {
  double g = (d[l + 1] - d[l]) / (2.0 * e[l]);
  g = d[m] - d[l] + e[l] / (g + std::copysign(std::hypot(g, 1.0), g));
  double s = 1.0, c = 1.0, p = 0.0;
  for (size_t i = m; i-- > l;) {
    const double f = s * e[i], b = c * e[i];
    const double r = std::sqrt(f * f + g * g);
    e[i + 1] = r;
    if (r == 0.0) {  // the matrix splits here
      d[i + 1] -= p;
      e[m] = 0.0;
      return;
    }
    s = f / r;
    c = g / r;
    g = d[i + 1] - p;
    const double q = (d[i] - g) * s + 2.0 * c * b;
    p = s * q;
    d[i + 1] = g + p;
    g = c * q - b;
    const double next = z[i + 1];
    z[i + 1] = s * z[i] + c * next;
    z[i] = c * z[i] - s * next;
  }
  d[l] -= p;
  e[l] = g;
  e[m] = 0.0;
}

/// A piece of an integral: by one rule, and by the same rule on its halves.
struct Piece {
  double a, b, value, magnitude, error;
  bool operator<(const Piece& other) const { return error < other.error; }
};

Piece make_piece(const std::function<double(double)>& f, double a, double b) {
  static const GaussRule rule = gauss_legendre(12);
  const auto sum = [&](double lo, double width, double& magnitude) {
    double total = 0.0;
    for (size_t i = 0; i < rule.nodes.size(); ++i) {
      const double term = rule.weights[i] * f(lo + width * rule.nodes[i]) * width;
      total += term;
      magnitude += std::fabs(term);
    }
    return total;
  };
  const double half = 0.5 * (b - a);
  double coarse_magnitude = 0.0, magnitude = 0.0;
  const double whole = sum(a, b - a, coarse_magnitude);
  const double halves = sum(a, half, magnitude) + sum(a + half, half, magnitude);
  return {a, b, halves, magnitude, std::fabs(halves - whole)};
}

}  // namespace

GaussRule jacobi_rule(std::vector<double> diagonal, std::vector<double> off) {
  const size_t n = diagonal.size();
  assert(n > 0 && off.size() == n - 1);
  std::vector<double>&d = diagonal, &e = off, z(n, 0.0);
  e.push_back(0.0);
  z[0] = 1.0;
  for (size_t l = 0; l < n; ++l) {
    while (true) {
      size_t m = l;
      while (m + 1 < n && std::fabs(e[m]) > kEpsilon * (std::fabs(d[m]) + std::fabs(d[m + 1]))) ++m;
      if (m == l) break;
      ql_sweep(d, e, z, l, m);
    }
  }
  std::vector<size_t> order(n);
  for (size_t i = 0; i < n; ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](size_t i, size_t j) { return d[i] < d[j]; });
  GaussRule rule;
  for (const size_t i : order) {
    rule.nodes.push_back(d[i]);
    rule.weights.push_back(z[i] * z[i]);
  }
  return rule;
}

GaussRule gauss_legendre(int n) {
  std::vector<double> off;
  for (int l = 1; l < n; ++l) off.push_back(0.5 * l / std::sqrt(4.0 * l * l - 1.0));
  return jacobi_rule(std::vector<double>(n, 0.5), off);
}

GaussRule gauss_radau(int n) {
  std::vector<double> diagonal(n, 0.5), off;
  for (int l = 1; l < n; ++l) off.push_back(0.5 * l / std::sqrt(4.0 * l * l - 1.0));
  // The last element that makes 1 an eigenvalue [Golub1973]; for Legendre's polynomials the recurrence closes.
  diagonal.back() = 0.5 + 0.5 * n / (2.0 * n - 1.0);
  return jacobi_rule(std::move(diagonal), std::move(off));
}

Bounded integrate(const std::function<double(double)>& f, double a, double b, double tolerance) {
  constexpr size_t kMostPieces = 4000;
  std::priority_queue<Piece> pieces;
  pieces.push(make_piece(f, a, b));
  double error = pieces.top().error, magnitude = pieces.top().magnitude;
  while (error > tolerance * magnitude && pieces.size() < kMostPieces) {
    const Piece worst = pieces.top();
    const double middle = 0.5 * (worst.a + worst.b);
    if (!(worst.a < middle && middle < worst.b)) break;
    pieces.pop();
    error -= worst.error;
    magnitude -= worst.magnitude;
    for (const Piece& piece : {make_piece(f, worst.a, middle), make_piece(f, middle, worst.b)}) {
      error += piece.error;
      magnitude += piece.magnitude;
      pieces.push(piece);
    }
  }
  Bounded total{0.0, 0.0};
  magnitude = 0.0;
  for (; !pieces.empty(); pieces.pop()) {
    total.value += pieces.top().value;
    total.error += pieces.top().error;
    magnitude += pieces.top().magnitude;
  }
  total.error += 8.0 * kEpsilon * magnitude;
  return total;
}

}  // namespace vpm::exact
