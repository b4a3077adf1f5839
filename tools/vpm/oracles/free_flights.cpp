// S1: transmittance and free flights along a ray.
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <optional>

#include "oracles/cases.h"
#include "vpm/base/error.h"
#include "vpm/medium/grid/make_grid.h"
#include "vpm/medium/transmittance/estimator.h"
#include "vpm/study/careful_settings.h"
#include "vpm/study/estimates/flights.h"
#include "vpm/study/estimates/layers.h"

namespace vpm::tools {
namespace {

constexpr double kExact = 3e-6;    // relative, of what grids hold exactly: float
constexpr double kSampled = 2e-5;  // of smooth profiles: linear between nodes a 160th of their scale apart

/// A path with its relative error.
struct Profile {
  FlightPath path;
  double error = kExact;
};

Profile down_through(const Layers& layers, double error) {
  LayeredMedia layered = layered_media(layers, layers.thickness());
  return {{std::move(layered.media[0]), {Vec3(0.0f), Vec3(0.0f, -1.0f, 0.0f)}, layers.thickness()}, error};
}

/// Nodes of a smooth profile whose features are `scale` m long.
template <class F>
Profile sampled(double length, double scale, F&& sigma_t) {
  const int n = static_cast<int>(std::clamp(std::ceil(160.0 * length / scale), 64.0, 16384.0));
  Layers layers;
  for (int i = 0; i <= n; ++i) {
    layers.depth.push_back(length * i / n);
    layers.sigma_t.push_back(sigma_t(layers.depth.back()));
  }
  return down_through(layers, kSampled);
}

Profile piecewise_constant(const OracleCase& p) {
  const std::vector<double> edges = p.numbers("boundaries"), sigma = p.numbers("sigma", edges.size() - 1);
  Layers layers;
  for (size_t i = 0; i < sigma.size(); ++i) {
    layers.depth.insert(layers.depth.end(), {edges[i] - edges[0], edges[i + 1] - edges[0]});
    layers.sigma_t.insert(layers.sigma_t.end(), {sigma[i], sigma[i]});
  }
  return down_through(layers, kExact);
}

/// One cell whose corners hold densities.
Profile trilinear_voxel(const OracleCase& p) {
  double corner[2][2][2];
  const OracleValue::List* xs = p.value("corner_density_xyz").list();
  for (size_t x = 0; x < 2; ++x)
    for (size_t y = 0; y < 2; ++y)
      for (size_t z = 0; z < 2; ++z) {
        const OracleValue::List* ys = xs && xs->size() == 2 ? (*xs)[x].list() : nullptr;
        const OracleValue::List* zs = ys && ys->size() == 2 ? (*ys)[y].list() : nullptr;
        if (!zs || zs->size() != 2 || !(*zs)[z].number()) p.refuse("\"corner_density_xyz\" must be 2 x 2 x 2 numbers");
        corner[x][y][z] = *(*zs)[z].number();
      }
  GridFrame frame;
  frame.hi = Vec3i(1);
  Medium medium = make_medium(make_grid(frame, [&](int x, int y, int z) { return corner[x][y][z]; }),
                              Rgb(static_cast<float>(p.number("scale"))));
  const Vec3d from = p.vector("p0"), to = p.vector("p1");
  return {{std::move(medium), {Vec3(from), Vec3(glm::normalize(to - from))}, glm::distance(from, to)}, kExact};
}

/// Nothing where the kind is not known.
std::optional<Profile> read_profile(const OracleCase& c) {
  const OracleCase p = c.object("params");
  const std::string kind = c.text("kind");
  const double length = c.number_in("L", 1e-9, 1e9);
  if (kind == "homogeneous") return down_through({{0.0, length}, {p.number("sigma_t"), p.number("sigma_t")}}, kExact);
  if (kind == "linear_ramp") return down_through({{0.0, length}, {p.number("sigma0"), p.number("sigmaL")}}, kExact);
  if (kind == "exponential_atmosphere") {
    const double s0 = p.number("sigma0"), scale = p.number("H"), h0 = p.number("h0"), mu = p.number("mu");
    return sampled(length, scale / std::max(std::abs(mu), 1e-9),
                   [&](double t) { return s0 * std::exp(-(h0 + mu * t) / scale); });
  }
  if (kind == "gaussian_blob") {
    const double s0 = p.number("sigma0"), width = p.number("width"), b = p.number("impact"), t0 = p.number("t_closest");
    return sampled(length, width,
                   [&](double t) { return s0 * std::exp(-(b * b + (t - t0) * (t - t0)) / (2.0 * width * width)); });
  }
  if (kind == "piecewise_constant") return piecewise_constant(p);
  if (kind == "trilinear_voxel") return trilinear_voxel(p);
  return std::nullopt;
}

/// sigma_t at t; at a jump the side that is nearer to what it should be.
double extinction_near(const FlightPath& path, double t, double expected) {
  double best = HUGE_VAL;
  for (const double side : {-1e-6, 0.0, 1e-6}) {
    const double at = std::clamp(t + side * path.length, 0.0, path.length);
    const double sigma_t = path.medium.sigma_t.r * double{path.medium.density(path.ray.at(static_cast<float>(at)))};
    if (std::abs(sigma_t - expected) < std::abs(best - expected)) best = sigma_t;
  }
  return best;
}

/// Density integrals, transmittance and extinction along the ray: no random numbers.
void check_profile(std::vector<Check>& checks, const OracleCase& c, const Profile& profile) {
  const FlightPath& path = profile.path;
  const auto estimator = make_transmittance_estimator({});
  Rng rng(0, 0, 0);
  const double largest = path.medium.sigma_t.r * double{path.medium.max_density()}, total = c.number("tau_total");
  const auto check_at = [&](const std::string& name, double t, double tau, double transmittance) {
    const Interval crossed{0.0f, static_cast<float>(t)};
    checks.push_back(check_bound("tau" + name,
                                 path.medium.sigma_t.r * density_integral(path.medium, path.ray, crossed).value, tau,
                                 profile.error * total));
    checks.push_back(check_bound("transmittance" + name,
                                 estimator->estimate(path.medium, path.ray, crossed, rng).value.r, transmittance,
                                 profile.error * std::max(1.0, total) * transmittance));
  };
  check_at("", path.length, total, c.number("transmittance"));
  for (const OracleCase& at : c.objects("profile")) {
    const double t = at.number("t"), sigma_t = at.number("sigma_t");
    const std::string name = fmt::format("({:.4g} m)", t);
    check_at(name, t, at.number("tau"), at.number("transmittance"));
    checks.push_back(
        check_bound("sigma_t" + name, extinction_near(path, t, sigma_t), sigma_t, (profile.error + 1e-5) * largest));
  }
}

/// The rate at which a weighted strategy draws flights along the path, 1/m.
double rate_of(const StrategyInfo& info, const FlightPath& path) {
  const double mean = path.medium.mean_density(), start = path.medium.density(path.ray.origin);
  const bool local = info.name == "local-extinction";
  return path.medium.sigma_t.r *
         (local ? std::max(start, number_of(info.parameters, {}, "extinction_floor") * mean) : mean);
}

/// Flights by every strategy that is unbiased in this medium.
void check_flights(std::vector<Check>& checks, const OracleCase& c, const FlightPath& path, const Effort& effort) {
  std::vector<double> distances, probabilities;
  const double collided = c.number("collision_probability");
  for (const OracleCase& q : c.objects("quantiles")) {
    if (q.has("t")) {  // else the photon leaves before
      distances.push_back(q.number("t"));
      probabilities.push_back(q.number("u"));
    }
    distances.push_back(q.number("t_conditional"));
    probabilities.push_back(q.number("u") * collided);
  }
  for (const StrategyInfo& info : distance_strategies()) {
    const bool homogeneous = path.medium.homogeneous();
    if (!homogeneous && (!info.heterogeneous || !info.unbiased)) continue;
    if (!info.positive) continue;  // nothing shows beforehand how many flights its weights need
    const auto strategy = make_distance_strategy(careful_settings(info.name));
    const std::string name = std::string(info.name) + ": ";
    const bool analog = homogeneous || info.bounded_weight;
    const uint64_t flights = effort.count(40'000, 2'000'000);
    if (!analog) {
      const double effective = static_cast<double>(flights) / weight_square(path, rate_of(info, path));
      if (effective < 1000.0) {
        checks.push_back(
            not_determined(name + "all", 0.0, 0.0, fmt::format("effective sample size {:.2g}", effective)));
        continue;
      }
    }
    const FlightEstimate e = estimate_flights(path, *strategy, distances, c.number("mean_t_given_collision"), flights,
                                              effort.seed_of(c.place() + name));
    const auto check = [&](const std::string& what, const Moments& found, double p) {
      checks.push_back(analog ? check_probability(name + what, found, p) : check_weighted_mean(name + what, found, p));
    };
    for (size_t i = 0; i < distances.size(); ++i)
      check(fmt::format("P(t < {:.6g} m)", distances[i]), e.collided_before[i], probabilities[i]);
    check("collision_probability", e.collided, collided);
    checks.push_back(analog ? check_mean(name + "mean_min_t_L", e.reach, c.number("mean_min_t_L"))
                            : check_weighted_mean(name + "mean_min_t_L", e.reach, c.number("mean_min_t_L")));
    if (analog) checks.push_back(check_mean(name + "t - mean_t_given_collision", e.excess, 0.0));
  }
}

CaseResult run_flight(const OracleCase& c, const Effort& effort) {
  CaseResult result;
  if (!c.has("params")) {
    result.unchecked = "the parameters of its profile are not given";
    return result;
  }
  const std::optional<Profile> profile = read_profile(c);
  if (!profile) {
    result.unchecked = "no profile of the kind \"" + c.text("kind") + "\" is known";
    return result;
  }
  check_profile(result.checks, c, *profile);
  for (const OracleCase& q : c.objects("quantiles")) {
    if (!q.has("t") || !q.has("pdf")) continue;
    const double t = q.number("t"), pdf = q.number("pdf");
    const FlightPath& path = profile->path;
    const double tau =
        path.medium.sigma_t.r * density_integral(path.medium, path.ray, {0.0f, static_cast<float>(t)}).value;
    result.checks.push_back(check_bound(fmt::format("pdf({:.6g} m)", t),
                                        extinction_near(path, t, pdf * std::exp(tau)) * std::exp(-tau), pdf,
                                        1e-4 * pdf));
  }
  check_flights(result.checks, c, profile->path, effort);
  return result;
}

}  // namespace

std::vector<CaseResult> run_free_flights(const OracleList& list, const Effort& effort) {
  return run_each(list, [&](const OracleCase& c) { return run_flight(c, effort); });
}

}  // namespace vpm::tools
