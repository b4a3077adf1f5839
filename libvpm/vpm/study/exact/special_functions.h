// Functions that transport in layers and balls keeps asking for, without the cancellation of their plain forms.
#pragma once

namespace vpm::exact {

/// E_n(x) = int_1^inf exp(-x t) / t^n dt, for n >= 1 and x >= 0 (x > 0 for n = 1).
double exponential_integral(int n, double x);

/// x coth(x) - 1, for x >= 0.
double coth_excess(double x);

/// int_0^r s exp(-a s) ds = (1 - (1 + a r) exp(-a r)) / a^2, for a >= 0 and r >= 0.
double exponential_moment(double a, double r);

}  // namespace vpm::exact
