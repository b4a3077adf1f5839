// Tails and quantiles, computed by Boost.Math.
#include "vpm/base/statistics/tails.h"

#include <boost/math/distributions/students_t.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <cassert>
#include <cmath>
#include <limits>

namespace vpm {
namespace {

namespace math = boost::math;

/// In doubles all through, and without errors where a tail is too small for them: it is 0 then.
using Policy = math::policies::policy<math::policies::promote_double<false>,
                                      math::policies::underflow_error<math::policies::ignore_error>>;
using StudentsT = math::students_t_distribution<double, Policy>;

}  // namespace

double normal_tail(double z) { return std::erfc(std::fabs(z) / std::sqrt(2.0)); }

double normal_quantile(double p) {
  assert(p > 0.0 && p <= 1.0);
  return std::sqrt(2.0) * math::erfc_inv(p, Policy());
}

double chi2_tail(double statistic, double dof) {
  assert(dof > 0.0 && !(statistic < 0.0));
  if (std::isnan(statistic)) return statistic;
  return std::isinf(statistic) ? 0.0 : math::gamma_q(0.5 * dof, 0.5 * statistic, Policy());
}

double student_tail(double t, double dof) {
  assert(!(dof <= 0.0));
  if (std::isnan(t) || std::isnan(dof)) return std::numeric_limits<double>::quiet_NaN();
  return 2.0 * math::cdf(math::complement(StudentsT(dof), std::fabs(t)));
}

double student_quantile(double p, double dof) {
  assert(p > 0.0 && p <= 1.0 && dof > 0.0);
  return math::quantile(math::complement(StudentsT(dof), 0.5 * p));
}

}  // namespace vpm
