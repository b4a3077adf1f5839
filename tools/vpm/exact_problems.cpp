// The problems of vpm exact: from keys to the solvers of study/exact, and from their solutions to quantities.
#include "exact_problems.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "vpm/base/error.h"
#include "vpm/base/vec.h"
#include "vpm/input/phase_file.h"
#include "vpm/medium/phase/phase.h"
#include "vpm/study/exact/airlight.h"
#include "vpm/study/exact/point_source.h"
#include "vpm/study/exact/profile.h"
#include "vpm/study/exact/slab.h"
#include "vpm/study/exact/sphere.h"

namespace vpm::tools {

namespace {

using namespace exact;

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kRounding = 1e-14;  // of closed forms, relative
constexpr ExactLimits kFraction{0.0, 1.0};
constexpr ExactLimits kPositive{0.0, kInfinite, true, true};
constexpr ExactLimits kNotNegative{0.0, kInfinite, false, true};
constexpr ExactLimits kAnchored{-kInfinite, kInfinite, true, true};  // any finite number
constexpr ExactLimits kMeanCosine{-0.999, 0.999};  // beyond, it takes thousands of Legendre moments and more

const ExactKey kAlbedoKey{"albedo", "single scattering albedo, 0 to 1", "1"};
const std::vector<ExactKey> kPhaseKeys{
    {"phase", "hg (Henyey-Greenstein), isotropic, rayleigh, draine, two-lobes, droplets or table", "hg"},
    {"g", "of phase=hg, draine, and the first of two-lobes, -0.999 to 0.999", "0"},
    {"alpha", "of phase=draine, 0 to 10000", "0"},
    {"g2", "of the second of phase=two-lobes, -0.999 to 0.999", "0"},
    {"share", "that the first of phase=two-lobes scatters, 0 to 1", "0.5"},
    {"diameter", "of phase=droplets, micrometres, 5 to 50", "10"},
    {"table", "of phase=table: a file of angles and values, as scenes have it", ""}};

std::vector<std::optional<double>> optionals(const std::vector<double>& values) {
  return {values.begin(), values.end()};
}

ExactQuantity single(const std::string& name, const std::string& unit, const Bounded& value) {
  return {name, unit, "", "", {}, {value.value}, {value.error}};
}
ExactQuantity series(const std::string& name, const std::string& unit, const std::string& place,
                     const std::vector<double>& places, const BoundedSeries& values) {
  return {
      name, unit, place, "", places, optionals(values.values), std::vector<double>(values.values.size(), values.error)};
}
/// Values known to rounding.
ExactQuantity closed_form(const std::string& name, const std::string& unit, const std::string& place,
                          const std::vector<double>& places, const std::vector<double>& values) {
  ExactQuantity quantity{name, unit, place, "", places, optionals(values), {}};
  for (const double value : values) quantity.errors.push_back(kRounding * std::fabs(value));
  return quantity;
}

PhaseMoments read_phase(ExactArguments& arguments) {
  const std::string phase =
      arguments.word("phase", {"hg", "isotropic", "rayleigh", "draine", "two-lobes", "droplets", "table"});
  if (phase == "isotropic") return isotropic_moments();
  if (phase == "rayleigh") return rayleigh_moments();
  if (phase == "table") return table_moments(*load_phase_table(arguments.path("table")));
  if (phase == "droplets") return moments_of(Droplets(static_cast<float>(arguments.number("diameter", {5.0, 50.0}))));
  const double g = arguments.number("g", kMeanCosine);
  if (phase == "draine") return draine_moments(g, arguments.number("alpha", {0.0, 1e4}));
  if (phase == "two-lobes")
    return mixed_moments(henyey_greenstein_moments(g), henyey_greenstein_moments(arguments.number("g2", kMeanCosine)),
                         arguments.number("share", kFraction));
  return henyey_greenstein_moments(g);
}

/// Keys with those of the phase function behind the first.
std::vector<ExactKey> with_phase(std::vector<ExactKey> keys) {
  keys.insert(keys.begin() + 1, kPhaseKeys.begin(), kPhaseKeys.end());
  return keys;
}

std::vector<ExactQuantity> solve_layer(ExactArguments& arguments, double tau) {
  const Slab slab{tau, arguments.number("albedo", kFraction), read_phase(arguments),
                  arguments.word("incidence", {"collimated", "diffuse"}) == "diffuse" ? Incidence::diffuse
                                                                                      : Incidence::collimated_normal};
  const bool half_space = std::isinf(tau);
  const SlabPlaces places{arguments.list("depths", {0.0, tau, false, half_space}),
                          arguments.list("mus", {0.0, 1.0, true}), arguments.list("mu_edges", kFraction)};
  if (!std::is_sorted(places.mu_edges.begin(), places.mu_edges.end())) arguments.refuse("mu_edges", "must ascend");
  const SlabSolution s = solve_slab(slab, places);

  const std::string share = "of the incident power", depth = "optical depth", mu = "mu", bin = "mu from";
  std::vector<ExactQuantity> quantities{single("reflected", share, s.reflected)};
  if (!half_space) {
    quantities.push_back(single("transmitted", share + ", unscattered light included", s.transmitted));
    quantities.push_back(single("unscattered", share, {s.unscattered, kRounding * s.unscattered}));
  }
  quantities.push_back(single("absorbed", share, s.absorbed));
  const auto add = [&](const char* name, const char* unit, const std::string& place, const std::vector<double>& at,
                       const BoundedSeries& values) {
    if (!values.values.empty()) quantities.push_back(series(name, unit, place, at, values));
  };
  add("fluence", "W/m^2 per W/m^2", depth, places.depths, s.fluence);
  if (!places.depths.empty())
    quantities.push_back(
        closed_form("uncollided fluence", "W/m^2 per W/m^2", depth, places.depths, s.uncollided_fluence));
  add("net flux", "W/m^2 per W/m^2, downwards", depth, places.depths, s.net_flux);
  add("reflected radiance", "1/sr", mu, places.mus, s.reflected_radiance);
  if (!half_space) add("transmitted radiance", "1/sr, scattered light", mu, places.mus, s.transmitted_radiance);
  add("reflected flux", "of the incident power", bin, places.mu_edges, s.reflected_flux);
  if (!half_space)
    add("transmitted flux", "of the incident power, scattered light", bin, places.mu_edges, s.transmitted_flux);
  return quantities;
}

std::vector<ExactKey> layer_keys() {
  return with_phase({kAlbedoKey,
                     {"incidence", "collimated (along the normal) or diffuse", "collimated"},
                     {"depths", "optical depths where fluence and net flux are wanted", ""},
                     {"mus", "cosines to the outward normal where exit radiance is wanted", ""},
                     {"mu_edges", "ascending cosines between which exit flux is wanted", ""}});
}
std::vector<ExactKey> slab_keys() {
  std::vector<ExactKey> keys = layer_keys();
  keys.insert(keys.begin(), {"tau", "optical thickness", "", true});
  return keys;
}

std::vector<ExactQuantity> solve_slab_problem(ExactArguments& arguments) {
  return solve_layer(arguments, arguments.number("tau", kPositive));
}
std::vector<ExactQuantity> solve_half_space_problem(ExactArguments& arguments) {
  return solve_layer(arguments, kInfinite);
}

std::vector<ExactQuantity> solve_point_source_problem(ExactArguments& arguments) {
  const double albedo = arguments.number("albedo", kFraction), sigma_t = arguments.number("sigma_t", kPositive);
  const double power = arguments.number("power", kPositive);
  const PhaseMoments phase = read_phase(arguments);
  const std::vector<double> distances = arguments.list("distances", kPositive);
  std::vector<double> radii;
  for (const double d : distances) radii.push_back(sigma_t * d);
  const PointSourceSolution s = solve_point_source(albedo, phase, radii);

  const double scale = power * sigma_t * sigma_t;
  ExactQuantity total{"fluence", "W/m^2", "distance", "m", distances, {}, {}}, collided = total, collisions = total;
  std::vector<double> uncollided;
  collided.name = "collided fluence";
  collisions.name = "collisions within";
  collisions.unit = "per photon";
  for (size_t i = 0; i < radii.size(); ++i) {
    uncollided.push_back(scale * s.uncollided[i]);
    collided.values.emplace_back(scale * s.collided[i].value);
    collided.errors.push_back(scale * s.collided[i].error);
    total.values.emplace_back(uncollided[i] + scale * s.collided[i].value);
    total.errors.push_back(collided.errors[i] + kRounding * uncollided[i]);
    collisions.values.emplace_back(s.collisions[i].value);
    collisions.errors.push_back(s.collisions[i].error);
  }
  ExactQuantity direct = closed_form("uncollided fluence", "W/m^2", "distance", distances, uncollided);
  direct.place_unit = "m";
  return {total, direct, collided, collisions};
}

std::vector<ExactQuantity> solve_airlight_problem(ExactArguments& arguments) {
  Airlight a;
  a.sigma_t = arguments.number("sigma_t", kPositive);
  a.albedo = arguments.number("albedo", {0.0, 1.0, true});
  a.g = arguments.number("g", {-1.0, 1.0, true, true});
  a.distance = arguments.number("distance", kPositive);
  a.closest = arguments.number("closest", kAnchored);
  a.t0 = arguments.number("t0", kNotNegative);
  a.t1 = arguments.number("t1", {a.t0, kInfinite, true});
  const double intensity = arguments.number("intensity", kPositive);
  const AirlightSolution s = solve_airlight(a);
  const double log10_radiance = s.log10_radiance + std::log10(intensity);
  return {
      single("radiance", "W/(m^2 sr)", {intensity * s.radiance.value, intensity * s.radiance.error}),
      single("log10 of radiance", "log10 of W/(m^2 sr)", {log10_radiance, 1e-12 + 1e-14 * std::fabs(log10_radiance)})};
}

std::vector<ExactQuantity> solve_sphere_problem(ExactArguments& arguments) {
  const double radius = arguments.number("radius", kPositive), albedo = arguments.number("albedo", kFraction);
  const std::vector<double> radii = arguments.list("radii", kFraction), impacts = arguments.list("impacts", kFraction);
  const SphereSolution s = solve_sphere(radius, albedo, radii, impacts);
  const std::string share = "of the power that enters";
  std::vector<ExactQuantity> quantities{single("escaping", share, s.escaping), single("absorbed", share, s.absorbed),
                                        single("uncollided", share, {s.uncollided, kRounding * s.uncollided})};
  if (!radii.empty())
    quantities.push_back(series("fluence", "sr, over the environment's radiance", "r/R", radii, s.fluence));
  if (!impacts.empty())
    quantities.push_back(series("image radiance", "over the environment's", "impact/R", impacts, s.image));
  return quantities;
}

Profile read_voxel(ExactArguments& arguments) {
  const std::vector<double> corners = arguments.list("corners", kNotNegative);
  const std::vector<double> from = arguments.list("from", kFraction), to = arguments.list("to", kFraction);
  if (corners.size() != 8) arguments.refuse("corners", "must be 8 densities, of corners 000, 001, 010, ..., 111 (xyz)");
  if (from.size() != 3) arguments.refuse("from", "must be 3 coordinates from 0 to 1");
  if (to.size() != 3 || to == from) arguments.refuse("to", "must be 3 coordinates from 0 to 1, not those of from");
  double density[2][2][2];
  for (int i = 0; i < 8; ++i) density[i / 4][i / 2 % 2][i % 2] = corners[i];
  return voxel_profile(density, arguments.number("sigma_t", kNotNegative), Vec3d(from[0], from[1], from[2]),
                       Vec3d(to[0], to[1], to[2]));
}

Profile read_layers(ExactArguments& arguments) {
  LayeredProfile layers{arguments.list("ends", kPositive), arguments.list("values", kNotNegative)};
  const auto not_ascending = std::adjacent_find(layers.ends.begin(), layers.ends.end(), std::greater_equal<>());
  if (layers.ends.empty() || not_ascending != layers.ends.end())
    arguments.refuse("ends", "must be distances that ascend");
  if (layers.values.size() != layers.ends.size()) arguments.refuse("values", "must be as many as the ends");
  const double length = layers.ends.back();
  return {std::move(layers), length};
}

Profile read_profile(ExactArguments& arguments) {
  const std::string kind =
      arguments.word("profile", {"constant", "ramp", "exponential", "gaussian", "layers", "voxel"});
  if (kind == "voxel") return read_voxel(arguments);
  if (kind == "layers") return read_layers(arguments);
  const double sigma_t = arguments.number("sigma_t", kNotNegative), length = arguments.number("length", kPositive);
  if (kind == "ramp") {
    const double end = arguments.number("end", kNotNegative);
    return {RampProfile{sigma_t, (end - sigma_t) / length}, length};
  }
  if (kind == "exponential") return {ExponentialProfile{sigma_t, arguments.number("rate", kAnchored)}, length};
  if (kind == "gaussian") {
    const double width = arguments.number("width", kPositive);
    return {GaussianProfile{sigma_t, width, arguments.number("centre", kAnchored)}, length};
  }
  return {ConstantProfile{sigma_t}, length};
}

std::vector<ExactQuantity> solve_transmittance_problem(ExactArguments& arguments) {
  const Profile profile = read_profile(arguments);
  std::vector<double> t = arguments.list("t", {0.0, profile.length});
  const std::vector<double> u = arguments.list("u", {0.0, 1.0, false, true});
  if (t.empty()) t.push_back(profile.length);
  ExactQuantity thickness{"optical thickness", "", "t", "m", t, {}, {}}, pass = thickness, cdf = thickness;
  pass.name = "transmittance";
  cdf.name = "flights that end before";
  const auto add = [](ExactQuantity& quantity, const Bounded& value) {
    quantity.values.emplace_back(value.value);
    quantity.errors.push_back(value.error);
  };
  for (const double at : t) {
    add(thickness, optical_thickness(profile, at));
    add(pass, exact::transmittance(profile, at));
    add(cdf, collision_cdf(profile, at));
  }
  std::vector<ExactQuantity> quantities{thickness, pass, cdf,
                                        single("mean flight", "m, to the ray's end at most", mean_flight(profile))};
  if (u.empty()) return quantities;
  ExactQuantity quantile{"flight quantile", "m; none: it leaves", "u", "", u, {}, {}};
  for (const double share : u) {
    const std::optional<Bounded> at = flight_quantile(profile, share);
    quantile.values.push_back(at ? std::optional(at->value) : std::nullopt);
    quantile.errors.push_back(at ? at->error : 0.0);
  }
  quantities.push_back(quantile);
  return quantities;
}

}  // namespace

const std::vector<ExactProblem>& exact_problems() {
  static const std::vector<ExactProblem> problems{
      {"slab", "plane-parallel slab, all orders of scattering", slab_keys(), solve_slab_problem},
      {"half-space", "the same without an end", layer_keys(), solve_half_space_problem},
      {"point-source", "isotropic point source in an infinite medium, all orders of scattering",
       with_phase({kAlbedoKey,
                   {"distances", "from the source, m", "", true},
                   {"sigma_t", "extinction coefficient, 1/m", "1"},
                   {"power", "of the source, W", "1"}}),
       solve_point_source_problem},
      {"airlight",
       "point source seen through an infinite medium, single scattering",
       {{"distance", "of the source from the ray, m", "", true},
        {"closest", "t where the ray passes the source, m", "0"},
        {"t0", "where scattering begins, m; extinction begins at the camera, t = 0", "0"},
        {"t1", "where scattering ends, m", "inf"},
        {"sigma_t", "extinction coefficient, 1/m", "1"},
        {"albedo", "single scattering albedo, above 0, to 1", "1"},
        {"g", "mean cosine of Henyey and Greenstein's phase function", "0"},
        {"intensity", "of the source, W/sr", "1"}},
       solve_airlight_problem},
      {"transmittance",
       "extinction along a ray: transmittance and free flights",
       {{"profile", "constant, ramp, exponential, gaussian, layers or voxel", "constant"},
        {"sigma_t", "extinction, 1/m: everywhere, at t = 0 (ramp, exponential), at the peak, at density 1 (voxel)",
         "1"},
        {"length", "of the ray, m; not of layers and voxels", "1"},
        {"end", "ramp: extinction at the end, 1/m", "0"},
        {"rate", "exponential: of decay along the ray, 1/m", "1"},
        {"width", "gaussian: standard deviation, m", "1"},
        {"centre", "gaussian: t of the peak, m", "0"},
        {"ends", "layers: where each ends, m", ""},
        {"values", "layers: extinction of each, 1/m", ""},
        {"corners", "voxel: densities at its corners 000, 001, 010, ..., 111 (xyz)", ""},
        {"from", "voxel: start of the ray in the unit cube, m", "0,0,0"},
        {"to", "voxel: its end", "1,1,1"},
        {"t", "where, m; otherwise at the end", ""},
        {"u", "shares of flights whose distances are wanted", ""}},
       solve_transmittance_problem},
      {"sphere",
       "isotropically scattering sphere in a uniform environment, all orders of scattering",
       {{"radius", "optical radius", "", true},
        kAlbedoKey,
        {"radii", "over the sphere's, where fluence is wanted", ""},
        {"impacts", "distances of rays from the centre over the radius, for the image", ""}},
       solve_sphere_problem},
  };
  return problems;
}

const ExactProblem& find_exact_problem(const std::string& name) {
  std::string names;
  for (const ExactProblem& problem : exact_problems()) {
    if (problem.name == name) return problem;
    names += (names.empty() ? "" : ", ") + problem.name;
  }
  throw InputError(fmt::format("exact: there is no problem {}; problems: {}", name, names));
}

std::vector<ExactQuantity> solve(const ExactProblem& problem, ExactArguments& arguments) {
  std::vector<ExactQuantity> quantities = problem.solve(arguments);
  arguments.expect_all_read();
  for (const ExactQuantity& quantity : quantities)
    for (const std::optional<double>& value : quantity.values)
      if (value && !std::isfinite(*value))
        throw InputError(fmt::format("exact {}: the phase function's peak is too narrow to be solved: g nearer to 0 is",
                                     problem.name));
  return quantities;
}

}  // namespace vpm::tools
