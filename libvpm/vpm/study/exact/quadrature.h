// Gauss rules from their Jacobi matrices, and an adaptive integral built from them. Both are our own, each for a
// reason: of eigenvectors a rule needs the first components alone, which takes n^2 steps where Eigen's solver takes n^3
// for all of them (point sources ask for 1601 nodes); and Boost.Math's rules have their number of nodes at compile
// time, and its adaptive integrals stop at a depth without a bound on what is left.
#pragma once

#include <functional>
#include <vector>

namespace vpm::exact {

/// |truth - value| <= error; the unit is the value's.
struct Bounded {
  double value = 0.0;
  double error = 0.0;
};

/// Values of one quantity at several places, with one bound for all of them.
struct BoundedSeries {
  std::vector<double> values;
  double error = 0.0;
};

/// sum_i weights[i] f(nodes[i]) stands for an integral of f; nodes ascend.
struct GaussRule {
  std::vector<double> nodes, weights;
};

/// The rule of the measure (of total 1) whose orthonormal polynomials have this symmetric tridiagonal Jacobi matrix:
/// nodes are its eigenvalues, weights the squared first components of its eigenvectors [Golub1969].
/// `off` has one element less than `diagonal`.
GaussRule jacobi_rule(std::vector<double> diagonal, std::vector<double> off);

/// Exact over [0, 1] for polynomials of degree 2n - 1.
GaussRule gauss_legendre(int n);

/// Exact over [0, 1] for polynomials of degree 2n - 2; its last node is 1.
GaussRule gauss_radau(int n);

/// The integral of f over [a, b], halving the worst piece until the pieces' errors sum to less than `tolerance` times
/// the integral of |f|. Endpoints are never evaluated, so f may have integrable singularities there.
Bounded integrate(const std::function<double(double)>& f, double a, double b, double tolerance = 1e-14);

}  // namespace vpm::exact
