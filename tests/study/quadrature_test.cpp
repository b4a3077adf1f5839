// Gauss rules, the adaptive integral and special functions against closed forms.
#include "vpm/study/exact/quadrature.h"

#include <gtest/gtest.h>

#include <cmath>

#include "vpm/study/exact/special_functions.h"

namespace vpm::exact {
namespace {

void expect_exact_to_degree(const GaussRule& rule, int degree) {
  for (int power = 0; power <= degree; ++power) {
    double sum = 0.0;
    for (size_t i = 0; i < rule.nodes.size(); ++i) sum += rule.weights[i] * std::pow(rule.nodes[i], power);
    EXPECT_NEAR(sum, 1.0 / (power + 1), 2e-15) << "power " << power;
  }
}

TEST(ExactQuadrature, RulesAreExactForTheirPolynomials) {
  for (const int n : {1, 2, 5, 40}) {
    expect_exact_to_degree(gauss_legendre(n), 2 * n - 1);
    expect_exact_to_degree(gauss_radau(n), 2 * n - 2);
    EXPECT_NEAR(gauss_radau(n).nodes.back(), 1.0, 2e-15);
  }
}

TEST(ExactQuadrature, IntegratesSingularAndPeakedFunctions) {
  const auto expect = [](const std::function<double(double)>& f, double a, double b, double truth) {
    const Bounded ours = integrate(f, a, b);
    EXPECT_NEAR(ours.value, truth, ours.error + 1e-15 * truth);
    EXPECT_LT(ours.error, 1e-13 * std::abs(truth));
  };
  expect([](double x) { return std::log(x); }, 0.0, 1.0, -1.0);
  expect([](double x) { return 1.0 / (1e-8 + x * x); }, -1.0, 1.0, 2e4 * std::atan(1e4));
  expect([](double x) { return std::exp(-x); }, 0.0, 700.0, 1.0);
  expect([](double x) { return std::fabs(x - 0.3); }, 0.0, 1.0, 0.29);
}

TEST(ExactQuadrature, SpecialFunctionsKeepTheirDigits) {
  EXPECT_NEAR(exponential_integral(1, 0.5), 0.55977359477616081, 3e-15);
  EXPECT_NEAR(exponential_integral(1, 2.0), 0.048900510708061120, 3e-16);
  EXPECT_NEAR(exponential_integral(3, 0.0), 0.5, 0.0);
  for (const double x : {0.2, 0.999, 1.001, 7.0, 300.0})
    for (const int n : {1, 2, 3}) {
      const double above = exponential_integral(n + 1, x), below = exponential_integral(n, x);
      EXPECT_NEAR(n * above + x * below, std::exp(-x), 1e-14 * std::exp(-x)) << n << " " << x;
    }
  for (const double x : {0.0999999, 0.1000001, 1e-6, 3.0}) {
    const double s = x * x;
    if (x < 0.2) {
      EXPECT_NEAR(coth_excess(x), s / 3.0 - s * s / 45.0 + 2.0 * s * s * s / 945.0 - s * s * s * s / 4725.0, 1e-12 * s);
    }
    const double numeric = integrate([&](double t) { return t * std::exp(-x * t); }, 0.0, 1.7).value;
    EXPECT_NEAR(exponential_moment(x, 1.7), numeric, 1e-14 * numeric);
  }
  EXPECT_NEAR(exponential_moment(0.2499999 * 2.0, 1.0), exponential_moment(0.2500001 * 2.0, 1.0), 1e-7);
}

}  // namespace
}  // namespace vpm::exact
