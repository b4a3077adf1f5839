// Extinction along a ray by closed forms, and what follows exactly: optical thickness, transmittance, and the
// distribution of free flights.
#pragma once

#include <array>
#include <optional>
#include <variant>
#include <vector>

#include "vpm/base/vec.h"
#include "vpm/study/exact/quadrature.h"

namespace vpm::exact {

/// sigma_t does not change.
struct ConstantProfile {
  double sigma_t;  // 1/m
};
/// sigma_t = start + slope t.
struct RampProfile {
  double start;  // 1/m
  double slope;  // 1/m^2
};
/// sigma_t = start exp(-rate t): an exponential atmosphere seen along a ray, rate = cos(zenith) / scale height.
struct ExponentialProfile {
  double start;  // 1/m
  double rate;   // 1/m; negative downwards
};
/// sigma_t = peak exp(-(t - center)^2 / (2 width^2)): a Gaussian blob seen along a ray.
struct GaussianProfile {
  double peak;           // 1/m, at the ray's closest point
  double width, center;  // m
};
/// sigma_t is values[i] between ends[i - 1] (0 for the first) and ends[i]; the last end is the ray's.
struct LayeredProfile {
  std::vector<double> ends;    // m
  std::vector<double> values;  // 1/m
};
/// sigma_t = c[0] + c[1] t + c[2] t^2 + c[3] t^3: trilinear interpolation in one voxel.
struct CubicProfile {
  std::array<double, 4> c;  // 1/m, ..., 1/m^4
};

using ProfileShape =
    std::variant<ConstantProfile, RampProfile, ExponentialProfile, GaussianProfile, LayeredProfile, CubicProfile>;

/// A ray of `length` metres from t = 0. Extinction is never negative on it.
struct Profile {
  ProfileShape shape;
  double length = 1.0;  // m
};

/// The unit voxel with corners[x][y][z], times `scale` (1/m), from p0 to p1.
Profile voxel_profile(const double (&corners)[2][2][2], double scale, const Vec3d& p0, const Vec3d& p1);

/// sigma_t at t, 1/m.
double extinction(const Profile& profile, double t);
/// int_0^t sigma_t.
Bounded optical_thickness(const Profile& profile, double t);
/// exp(-tau): also the fraction of flights that pass t.
Bounded transmittance(const Profile& profile, double t);
/// 1 - exp(-tau): the fraction of flights that end before t.
Bounded collision_cdf(const Profile& profile, double t);
/// The t with collision_cdf = u, for u in [0, 1); nothing where the flight leaves the ray.
std::optional<Bounded> flight_quantile(const Profile& profile, double u);
/// Mean length of flights, where those that leave the ray count with its length: int_0^length exp(-tau) dt, m.
Bounded mean_flight(const Profile& profile);

}  // namespace vpm::exact
