#include "vpm/study/exact/ordinates.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <cassert>
#include <cmath>

#include "vpm/base/vec.h"
#include "vpm/study/exact/quadrature.h"

namespace vpm::exact {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// P_l at each of `mu` for l < orders: a row per order.
MatrixXd legendre(int orders, const VectorXd& mu) {
  MatrixXd p(std::max(orders, 2), mu.size());
  p.row(0).setOnes();
  p.row(1) = mu;
  for (int l = 2; l < orders; ++l)
    p.row(l) = ((2 * l - 1) * mu.transpose().cwiseProduct(p.row(l - 1)) - (l - 1) * p.row(l - 2)) / l;
  return p.topRows(orders);
}

/// 1 - albedo sum (2l+1) chi_l sqrt(w) P_l P_l^T sqrt(w) over the orders of one parity.
MatrixXd removal(double albedo, const PhaseMoments& phase, const MatrixXd& weighted, int parity) {
  MatrixXd m = MatrixXd::Identity(weighted.cols(), weighted.cols());
  for (int l = parity; l < weighted.rows(); l += 2)
    m.selfadjointView<Eigen::Lower>().rankUpdate(weighted.row(l).transpose(), -albedo * (2 * l + 1) * phase[l]);
  return m.selfadjointView<Eigen::Lower>();
}

std::vector<double> to_vector(const MatrixXd& m) { return {m.data(), m.data() + m.size()}; }
auto matrix(const std::vector<double>& v, size_t columns) {
  return Eigen::Map<const MatrixXd>(v.data(), static_cast<Eigen::Index>(v.size() / columns), columns);
}
auto vector(const std::vector<double>& v) {
  return Eigen::Map<const VectorXd>(v.data(), static_cast<Eigen::Index>(v.size()));
}

/// cosh(k (t - tau/2)) / cosh(k tau/2); exp(-k t) in a half space.
double even_shape(double k, double tau, double t) {
  if (k == 0.0) return 1.0;
  return (std::exp(-k * t) + std::exp(-k * (tau - t))) / (1.0 + std::exp(-k * tau));
}
/// sinh(k (t - tau/2)) / sinh(k tau/2).
double odd_shape(double k, double tau, double t) {
  if (k * tau == 0.0) return 2.0 * t / tau - 1.0;
  if (t > 0.5 * tau) return -odd_shape(k, tau, tau - t);
  return -std::exp(-k * t) * std::expm1(-k * (tau - 2.0 * t)) / std::expm1(-k * tau);
}
/// The slope of the even shape over the odd shape, and of the odd over the even.
double even_slope(double k, double tau) { return k == 0.0 ? 0.0 : k * std::tanh(0.5 * k * tau); }
double odd_slope(double k, double tau) { return k == 0.0 ? 2.0 / tau : k / std::tanh(0.5 * k * tau); }

/// int_0^tau even_shape exp(-a t) dt, a >= 1.
double even_integral(double k, double tau, double a) {
  const auto decay = [&](double rate) { return rate * tau == 0.0 ? tau : -std::expm1(-rate * tau) / rate; };
  if (std::isinf(tau)) return 1.0 / (a + k);
  const double away = std::exp(-std::min(a, k) * tau) * decay(std::fabs(a - k));
  return (away + decay(a + k)) / (1.0 + std::exp(-k * tau));
}
/// int_0^tau odd_shape exp(-a t) dt from the other one, by parts.
double odd_integral(double k, double tau, double a, double even) {
  return (odd_slope(k, tau) * even - 1.0 - std::exp(-a * tau)) / a;
}

/// sum (2l+1) chi_l P_l(mu) sum_j w_j P_l(mu_j) of each mode, over the even and over the odd orders.
struct Scattered {
  VectorXd even, odd;
};
Scattered scattered(const Modes& modes, double mu) {
  const size_t n = modes.k.size();
  const MatrixXd p = legendre(modes.orders, VectorXd::Constant(1, mu));
  const auto moments = matrix(modes.moments, n);
  VectorXd even = p.col(0), odd = p.col(0);
  for (int l = 0; l < modes.orders; ++l) (l % 2 == 0 ? odd : even)[l] = 0.0;
  return {moments.transpose() * even, moments.transpose() * odd};
}

/// Radiance leaving at depth 0 (side +1) or at tau (side -1): the source of scattered light, attenuated.
double exit_radiance(const LayerField& field, double mu, double side) {
  const Modes& modes = *field.modes;
  const Scattered s = scattered(modes, mu);
  double sum = 0.0;
  for (size_t m = 0; m < modes.k.size(); ++m) {
    const double k = modes.k[m], a = field.even[m], b = field.odd.empty() ? 0.0 : field.odd[m];
    const double even = even_integral(k, field.tau, 1.0 / mu);
    const double odd = odd_integral(k, field.tau, 1.0 / mu, even);
    const double rise = b == 0.0 ? 0.0 : b * odd_slope(k, field.tau);
    sum += even * (a * s.even[m] + side * rise * s.odd[m]);
    sum += odd * (side * b * s.even[m] + a * even_slope(k, field.tau) * s.odd[m]);
  }
  return 0.5 * modes.albedo * sum / mu;
}

}  // namespace

Ordinates make_ordinates(int count) {
  Ordinates ordinates;
  const GaussRule rule = gauss_radau(count);
  for (int i = 0; i < count; ++i) {  // mu = s^2: mu^n log(mu) dmu becomes s^(2n+1) log(s) ds
    const double s = i + 1 == count ? 1.0 : rule.nodes[i];
    ordinates.mu.push_back(s * s);
    ordinates.weight.push_back(2.0 * s * rule.weights[i]);
  }
  return ordinates;
}

Modes make_modes(double albedo, const PhaseMoments& phase, const Ordinates& ordinates) {
  assert(albedo >= 0.0 && albedo <= 1.0 && !phase.empty());
  const auto n = static_cast<Eigen::Index>(ordinates.mu.size());
  const VectorXd mu = vector(ordinates.mu), root = vector(ordinates.weight).cwiseSqrt();
  const auto orders = static_cast<int>(phase.size());
  const MatrixXd weighted = legendre(orders, mu) * root.asDiagonal();

  // In the unknowns sqrt(w) J and sqrt(w) H, A and B are symmetric. A x = k^2 M B^-1 M x is solved for 1/(k^2 + 1),
  // which has no pole where the albedo is 1 and k is 0: the squared singular values of L^-1 M L_B^-T.
  const MatrixXd a = removal(albedo, phase, weighted, 0), b = removal(albedo, phase, weighted, 1);
  const Eigen::LLT<MatrixXd> b_root(b);
  const MatrixXd m_b = b_root.matrixL().solve(MatrixXd(mu.asDiagonal())).transpose();  // M L_B^-T
  const Eigen::LLT<MatrixXd> root_shifted(a + m_b * m_b.transpose());
  assert(b_root.info() == Eigen::Success && root_shifted.info() == Eigen::Success);
  const Eigen::JacobiSVD<MatrixXd, Eigen::NoQRPreconditioner> svd(root_shifted.matrixL().solve(m_b),
                                                                  Eigen::ComputeFullU | Eigen::ComputeFullV);
  const VectorXd& s = svd.singularValues();

  Modes modes;
  modes.ordinates = ordinates;
  modes.albedo = albedo;
  modes.orders = orders;
  const MatrixXd x = root_shifted.matrixL().transpose().solve(svd.matrixU());
  const MatrixXd y = b_root.matrixL().transpose().solve(svd.matrixV() * s.asDiagonal());
  // The slowest mode from what it absorbs: without the cancellation at small k, and 0 where the albedo is 1.
  modes.k.push_back(std::sqrt((1.0 - albedo) * root.dot(x.col(0)) / root.cwiseProduct(mu).dot(y.col(0))));
  for (Eigen::Index m = 1; m < n; ++m) modes.k.push_back(std::sqrt((1.0 - s[m]) * (1.0 + s[m])) / s[m]);
  MatrixXd moments(orders, n);
  for (int l = 0; l < orders; ++l) moments.row(l) = (2 * l + 1) * phase[l] * (weighted.row(l) * (l % 2 == 0 ? x : y));
  modes.x = to_vector(root.cwiseInverse().asDiagonal() * x);
  modes.y = to_vector(root.cwiseInverse().asDiagonal() * y);
  modes.moments = to_vector(moments);
  return modes;
}

namespace {

/// Coefficients of the shapes of one parity whose J + H at depth 0 is `entering`.
std::vector<double> fit(const Modes& modes, double tau, double parity, const VectorXd& entering) {
  const size_t n = modes.k.size();
  VectorXd slope(n);
  for (size_t m = 0; m < n; ++m) slope[m] = parity > 0.0 ? even_slope(modes.k[m], tau) : odd_slope(modes.k[m], tau);
  // At depth 0 the shapes are 1 and -1, their slopes -even_slope and odd_slope; H is -y times the slope.
  const MatrixXd system = parity * (matrix(modes.x, n) + matrix(modes.y, n) * slope.asDiagonal());
  const VectorXd root = vector(modes.ordinates.weight).cwiseSqrt();
  return to_vector((root.asDiagonal() * system).partialPivLu().solve(root.cwiseProduct(entering)));
}

}  // namespace

LayerField illuminate(const Modes& modes, double tau, const std::vector<double>& incoming) {
  assert(tau > 0.0);
  const auto entering = vector(incoming);
  if (std::isinf(tau)) return {&modes, tau, fit(modes, tau, 1.0, 2.0 * entering), {}};
  return {&modes, tau, fit(modes, tau, 1.0, entering), fit(modes, tau, -1.0, entering)};
}

LayerField illuminate_antisymmetric(const Modes& modes, double tau, const std::vector<double>& incoming) {
  assert(tau > 0.0 && std::isfinite(tau));
  return {&modes, tau, std::vector<double>(modes.k.size(), 0.0), fit(modes, tau, -1.0, -2.0 * vector(incoming))};
}

std::vector<double> mode_fluence(const Modes& modes) {
  const VectorXd sums = matrix(modes.x, modes.k.size()).transpose() * vector(modes.ordinates.weight);
  return to_vector(2.0 * kPiD * sums);
}

double fluence(const LayerField& field, double t) {
  const Modes& modes = *field.modes;
  const size_t n = modes.k.size();
  const std::vector<double> share = mode_fluence(modes);
  double sum = 0.0;
  for (size_t m = 0; m < n; ++m) {
    sum += share[m] * field.even[m] * even_shape(modes.k[m], field.tau, t);
    if (!field.odd.empty()) sum += share[m] * field.odd[m] * odd_shape(modes.k[m], field.tau, t);
  }
  return sum;
}

double net_flux(const LayerField& field, double t) {
  const Modes& modes = *field.modes;
  const size_t n = modes.k.size();
  const VectorXd projected =
      matrix(modes.y, n).transpose() * vector(modes.ordinates.weight).cwiseProduct(vector(modes.ordinates.mu));
  double sum = 0.0;
  for (size_t m = 0; m < n; ++m) {
    const double k = modes.k[m];
    if (k > 0.0 || std::isfinite(field.tau))
      sum -= projected[m] * field.even[m] * even_slope(k, field.tau) * odd_shape(k, field.tau, t);
    if (!field.odd.empty()) sum -= projected[m] * field.odd[m] * odd_slope(k, field.tau) * even_shape(k, field.tau, t);
  }
  return 2.0 * kPiD * sum;
}

double exit_radiance_top(const LayerField& field, double mu) { return exit_radiance(field, mu, 1.0); }
double exit_radiance_bottom(const LayerField& field, double mu) { return exit_radiance(field, mu, -1.0); }

}  // namespace vpm::exact
