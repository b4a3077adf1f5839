// S7: irradiance from lights, and closed cavities.
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "oracles/cases.h"
#include "vpm/study/estimates/irradiance.h"

namespace vpm::tools {
namespace {

float radians_cosine(double degrees) { return as_float(std::cos(degrees * kPiD / 180.0)); }

/// One light, or the distribution of lights whose mean it is.
struct OracleLight {
  std::function<Light(Rng&)> draw;
  bool drawn = false;  // anew for each sample
  double size = 1.0;   // m, over which the irradiance varies
};

OracleLight one(const Light& light, double size) {
  return {[light](Rng&) { return light; }, false, size};
}

/// A parallelogram that turns its front to the receiver.
QuadLight facing_quad(const OracleCase& c, const Vec3d& receiver) {
  Vec3d u = c.vector("edge_u"), v = c.vector("edge_v");
  const Vec3d center = c.vector("center");
  if (glm::dot(glm::cross(u, v), receiver - center) < 0.0) std::swap(u, v);
  return {Vec3(center - 0.5 * (u + v)), Vec3(u), Vec3(v), Rgb(as_float(c.number("radiance")))};
}

/// A disc that faces down. Irradiance below it varies over its height at the rim, and over the distance beyond.
OracleLight disc(const OracleCase& c) {
  const auto radius = as_float(c.number("radius")), height = as_float(c.number("height"));
  const DiscLight light{Vec3(0.0f, 0.0f, height), Vec3(0.0f, 0.0f, -1.0f), radius, Rgb(as_float(c.number("radiance")))};
  return one(light, std::hypot(height, std::max(0.0, c.number("lateral_offset") - radius)));
}

/// I = (n + 1) P/(2 pi) cos^n: the mean of cones of full intensity whose cosines are distributed as u^(1/n).
OracleLight cosine_spot(const OracleCase& c, SpotLight spot) {
  const double n = c.number_in("exponent", 1e-3, 1e6);
  spot.intensity = Rgb(as_float((n + 1.0) * c.number("power") / (2.0 * kPiD)));
  return {[=](Rng& rng) {
            SpotLight cone = spot;
            cone.cos_inner = cone.cos_outer = as_float(std::pow(rng.uniform_double(), 1.0 / n));
            return cone;
          },
          true, 0.0};
}

/// Nothing where the kind is not known.
std::optional<OracleLight> read_light(const OracleCase& c, const Vec3d& receiver) {
  const std::string kind = c.text("light");
  const auto distance = [&](const char* field) { return glm::distance(c.vector(field), receiver); };
  if (kind == "point")
    return one(PointLight{Vec3(c.vector("position")), Rgb(as_float(c.number("radiant_intensity")))},
               distance("position"));
  if (kind == "spot_hard_cone" || kind == "spot_cos_power") {
    SpotLight spot;
    spot.position = Vec3(c.vector("position"));
    spot.direction = Vec3(glm::normalize(c.vector("axis")));
    if (kind == "spot_cos_power") return cosine_spot(c, spot);
    const double half = c.number_in("half_angle_deg", 1e-3, 179.0), sine = std::sin(0.5 * half * kPiD / 180.0);
    spot.cos_inner = spot.cos_outer = radians_cosine(half);
    spot.intensity = Rgb(as_float(c.number("power") / (4.0 * kPiD * sine * sine)));
    // Photon maps must not reach across the cone's edge.
    const Vec3d towards = glm::normalize(receiver - c.vector("position"));
    const double angle = std::acos(std::clamp(glm::dot(towards, glm::normalize(c.vector("axis"))), -1.0, 1.0));
    const double edge = distance("position") * std::abs(angle - half * kPiD / 180.0);
    return one(spot, std::min(distance("position"), 3.0 * edge));
  }
  if (kind == "disc_parallel_facing_down") return disc(c);
  if (kind == "quad_one_sided_towards_receiver") return one(facing_quad(c, receiver), 0.0);
  if (kind == "sphere") {
    const double radius = c.number("radius");
    // Where it does not dip below the plane its light is that of a point.
    const double size = c.vector("center").z >= radius ? distance("center") : distance("center") - radius;
    return one(SphereLight{Vec3(c.vector("center")), as_float(radius), Rgb(as_float(c.number("radiance")))}, size);
  }
  return std::nullopt;
}

CaseResult run_irradiance(const OracleCase& c, const Effort& effort) {
  CaseResult result;
  const Vec3d receiver = c.has("receiver") ? c.vector("receiver") : Vec3d(c.number("lateral_offset"), 0.0, 0.0);
  const std::optional<OracleLight> light = read_light(c, receiver);
  if (!light) {
    result.unchecked = "no light of the kind \"" + c.text("light") + "\" is known";
    return result;
  }
  const double exact = c.number("E");
  const uint64_t seed = effort.seed_of(c.place()), samples = effort.count(100'000, 10'000'000);
  if (light->drawn) {
    const Moments found = estimate_mean_irradiance(light->draw, Vec3(receiver), samples, seed);
    result.checks.push_back(check_mean("E", found, exact, 1e-6 * exact));
    return result;
  }
  Rng rng(seed, 0, 0);
  const Light fixed = light->draw(rng);
  const Moments direct = estimate_irradiance(fixed, Vec3(receiver), samples, seed);
  // Lights without an extent have no noise but that of float.
  const bool exactly = direct.variance() <= 1e-12 * exact * exact;
  result.checks.push_back(exactly ? check_bound("E by direct light", direct.mean(), exact, 3e-6 * exact)
                                  : check_mean("E by direct light", direct, exact, 1e-6 * exact));
  const double size = light->size > 0.0 ? light->size : glm::distance(c.vector("center"), receiver);
  for (const bool aimed : {false, true}) {
    const char* name = aimed ? "E by maps of photons that are aimed" : "E by photon maps";
    const uint64_t photons = effort.count(50'000, aimed ? 4'000'000 : 1'000'000);
    const MappedIrradiance mapped =
        estimate_mapped_irradiance(fixed, Vec3(receiver), 0.15 * size, aimed, photons, seed + 1);
    if (exact == 0.0)
      result.checks.push_back(check_bound(name, mapped.unbiased.mean(), 0.0, 0.0));
    else if (mapped.fewest < 30.0)
      result.checks.push_back(
          not_determined(name, mapped.unbiased.mean(), exact, fmt::format("{:.2g} photons in a batch", mapped.fewest)));
    else  // what is left of the bias is of the order of (h/size)^4
      result.checks.push_back(check_mean(name, mapped.unbiased, exact, 5e-4 * exact));
  }
  return result;
}

/// A field that is proportional to the source's power, of 1 W of it.
double per_watt(const OracleCase& c, const char* field) { return c.number(field) / c.number_in("P", 1e-30, 1e30); }

Check check_hits(const OracleCase& c, const Cavity& cavity, const Effort& effort) {
  const Moments hits = estimate_wall_hits(cavity, effort.count(100'000, 5'000'000), effort.seed_of(c.place()));
  return check_mean("total_incident_power", hits, per_watt(c, "total_incident_power"));
}

/// A source at the center: the same irradiance everywhere.
/// The share of reflected light that maps miss in a sphere.
constexpr double kMissed = kCapLoss * kCapRadius * kCapRadius;

void check_sphere(std::vector<Check>& checks, const OracleCase& c, const Cavity& cavity, const Effort& effort) {
  const uint64_t seed = effort.seed_of(c.place());
  const uint64_t photons = effort.count(200'000, 8'000'000);
  const double e = per_watt(c, "E_total_everywhere"), direct = per_watt(c, "E_direct");
  checks.push_back(check_hits(c, cavity, effort));
  if (c.has("mean_number_of_wall_hits_per_photon")) {
    checks.push_back(check_mean("mean_number_of_wall_hits_per_photon", estimate_wall_hits(cavity, photons, seed + 1),
                                c.number("mean_number_of_wall_hits_per_photon")));
  }
  checks.push_back(
      check_bound("E_direct", direct_wall_irradiance(cavity, Vec3(0.6f, 0.0f, -0.8f)), direct, 1e-5 * direct));
  const Moments mapped = estimate_wall_irradiance(cavity, false, photons, seed + 2);
  const auto by_map = [&](double total) { return total - kMissed * (total - direct); };
  checks.push_back(check_mean("E_total_everywhere by photon maps", mapped, by_map(e)));
  checks.push_back(
      check_mean("multiplier times E_direct by photon maps", mapped, by_map(c.number("multiplier") * direct)));
  const Moments seen = estimate_cavity_radiance(cavity, nullptr, effort.count(40'000, 2'000'000), seed + 3);
  checks.push_back(check_mean("outgoing_radiance by path tracing", seen, per_watt(c, "outgoing_radiance")));
  checks.push_back(
      check_mean("indirect_fluence over 4 pi by path tracing", seen, per_watt(c, "indirect_fluence") / (4.0 * kPiD)));
}

void check_off_center(std::vector<Check>& checks, const OracleCase& c, Cavity cavity, const Effort& effort) {
  const uint64_t seed = effort.seed_of(c.place());
  const double angle = c.number("polar_angle_deg") * kPiD / 180.0, offset = c.number("source_distance_from_centre");
  cavity.source = Vec3(0.0f, 0.0f, as_float(offset));
  const Vec3 outward(as_float(std::sin(angle)), 0.0f, as_float(std::cos(angle)));
  const double direct = per_watt(c, "E_direct"), total = per_watt(c, "E_total");
  const double near = std::abs(cavity.size - offset) / cavity.size;  // float errors grow near the wall
  const double found = direct_wall_irradiance(cavity, outward);
  checks.push_back(check_bound("E_direct", found, direct, 1e-5 / near * direct));
  const Moments reflected = estimate_wall_irradiance(cavity, true, effort.count(200'000, 8'000'000), seed);
  checks.push_back(check_mean("E_total less E_direct by photon maps", reflected, (1.0 - kMissed) * (total - direct)));
  const Moments seen = estimate_cavity_radiance(cavity, &outward, effort.count(40'000, 2'000'000), seed + 1);
  checks.push_back(check_mean("reflectance/pi E_total by path tracing", seen, cavity.reflectance / kPiD * total,
                              1e-5 / near * direct));
}

CaseResult run_cavity(const OracleCase& c, const Effort& effort) {
  CaseResult result;
  Cavity cavity;
  cavity.reflectance = c.number_in("rho", 0.01, 0.999);
  if (c.has("E_mean")) {
    cavity.box = true;
    const double area = c.number_in("area", 1e-6, 1e9);
    cavity.size = 0.5 * std::sqrt(area / 6.0);  // the mean is that of any shape
    cavity.source = as_float(cavity.size) * Vec3(0.3f, -0.5f, 0.2f);
    result.checks.push_back(check_hits(c, cavity, effort));
    const Moments hits = estimate_wall_hits(cavity, effort.count(100'000, 5'000'000), effort.seed_of(c.place()) + 1);
    result.checks.push_back(check_mean("E_mean times area", hits, per_watt(c, "E_mean") * area));
    return result;
  }
  cavity.size = c.number_in("R", 1e-3, 1e6);
  if (c.has("E_total_everywhere")) check_sphere(result.checks, c, cavity, effort);
  if (c.has("polar_angle_deg")) check_off_center(result.checks, c, cavity, effort);
  return result;
}

}  // namespace

std::vector<CaseResult> run_irradiances(const OracleList& list, const Effort& effort) {
  return run_each(list, [&](const OracleCase& c) { return run_irradiance(c, effort); });
}

std::vector<CaseResult> run_cavities(const OracleList& list, const Effort& effort) {
  return run_each(list, [&](const OracleCase& c) { return run_cavity(c, effort); });
}

}  // namespace vpm::tools
