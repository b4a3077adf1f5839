// S9: media that emit.
#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "oracles/cases.h"
#include "vpm/light/emitting_volume.h"
#include "vpm/medium/blackbody.h"
#include "vpm/medium/emission.h"
#include "vpm/medium/grid/make_grid.h"
#include "vpm/study/estimates/glowing.h"

namespace vpm::tools {
namespace {

using Checks = std::vector<Check>;

Rgb read_rgb(const OracleCase& c, const char* field) { return Rgb(c.vector(field)); }

/// Of a source radiance that is the same everywhere, or a grid's.
Medium read_medium(const Rgb& sigma_a, const Rgb& sigma_s, double g, const Rgb& source) {
  Medium medium;
  medium.name = "glowing";
  medium.sigma_s = sigma_s;
  medium.sigma_t = sigma_a + sigma_s;
  medium.phase = Isotropic{};
  if (g != 0.0) medium.phase = HenyeyGreenstein{as_float(g)};
  medium.emission = MediumEmission{.colour = source};
  return medium;
}

/// In direction `mu` from a slab's face z = 0 upwards, or from its other face downwards.
Ray ray_through_slab(double mu, double thickness, bool up) {
  const auto sine = as_float(std::sqrt(1.0 - mu * mu)), cosine = as_float(mu);
  return up ? Ray{Vec3(0.0f), Vec3(sine, 0.0f, cosine)}
            : Ray{Vec3(0.0f, 0.0f, as_float(thickness)), Vec3(sine, 0.0f, -cosine)};
}

Rgb emitted(const Medium& medium, const Ray& ray, double length) {
  uint64_t lookups = 0;
  return emitted_along(medium, ray, {0.0f, as_float(length)}, lookups).radiance;
}

Check check_exact(const std::string& name, double found, double exact, double tolerance = 3e-5) {
  return check_bound(name, found, exact, tolerance * std::abs(exact));
}

/// Seen from outside of the slab.
std::vector<Ray> rays_onto_slab(const std::vector<double>& cosines, double thickness) {
  std::vector<Ray> rays;
  for (const double mu : cosines) {
    Ray ray = ray_through_slab(mu, thickness, true);
    ray.origin = ray.at(as_float(-thickness));
    rays.push_back(ray);
  }
  return rays;
}

void check_absorbing_slab(Checks& checks, const OracleCase& c, const Effort& effort) {
  const double thickness = c.number_in("thickness_m", 1e-6, 1e6);
  const Medium medium = read_medium(read_rgb(c, "sigma_a"), Rgb(0.0f), 0.0, read_rgb(c, "source_radiance_B"));
  const std::vector<double> mu = c.numbers("mu");
  const OracleValue::List &alone = *c.value("radiance_emitted_only").list(), &all = *c.value("radiance").list();
  const Scene scene = glowing_slab(medium, thickness, read_rgb(c, "background_radiance"));
  const std::vector<Moments> seen = seen_by_paths(scene, kVacuum, rays_onto_slab(mu, thickness),
                                                  effort.count(2000, 100'000), effort.seed_of(c.place()));
  for (size_t i = 0; i < mu.size(); ++i) {
    const Rgb found = emitted(medium, ray_through_slab(mu[i], thickness, true), thickness / mu[i]);
    for (size_t channel = 0; channel < 3; ++channel) {
      const std::string where = fmt::format("[{}][{}]", i, channel);
      checks.push_back(check_exact("radiance_emitted_only" + where, found[static_cast<int>(channel)],
                                   *alone.at(i).list()->at(channel).number()));
      checks.push_back(
          check_mean("radiance" + where, seen[3 * i + channel], *all.at(i).list()->at(channel).number(), 1e-5));
    }
  }
}

void check_scattering_slab(Checks& checks, const OracleCase& c, const Effort& effort) {
  const double tau = c.number_in("tau", 1e-6, 1e3), albedo = c.share("albedo");
  const Medium medium = read_medium(Rgb(as_float(tau * (1.0 - albedo))), Rgb(as_float(tau * albedo)),
                                    c.number_in("g", -0.999, 0.999), Rgb(1.0f));
  const std::vector<double> mu = c.numbers("mu"), all = c.numbers("radiance_over_B", mu.size()),
                            alone = c.numbers("radiance_over_B_unscattered", mu.size());
  const std::vector<Moments> seen = seen_by_paths(glowing_slab(medium, 1.0), kVacuum, rays_onto_slab(mu, 1.0),
                                                  effort.count(2000, 200'000), effort.seed_of(c.place()));
  for (size_t i = 0; i < mu.size(); ++i) {
    checks.push_back(check_exact(fmt::format("radiance_over_B_unscattered[{}]", i),
                                 emitted(medium, ray_through_slab(mu[i], 1.0, true), 1.0 / mu[i]).g, alone[i]));
    checks.push_back(check_mean(fmt::format("radiance_over_B[{}]", i), seen[3 * i], all[i], 1e-5 * all[i]));
  }
}

void check_furnace(Checks& checks, const OracleCase& c, const Effort& effort) {
  const Rgb extinction(0.9f), albedo = read_rgb(c, "albedo");
  const Medium medium = read_medium(extinction * (Rgb(1.0f) - albedo), extinction * albedo,
                                    c.number_in("g", -0.999, 0.999), read_rgb(c, "B"));
  const Scene scene = furnace(medium, as_float(c.share("wall_reflectance")), read_rgb(c, "wall_emitted_radiance"));
  const std::vector<Ray> rays{{Vec3(0.3f, 0.1f, 0.7f), glm::normalize(Vec3(-0.4f, 0.2f, -1.0f))},
                              {Vec3(-0.9f, -0.9f, 0.9f), glm::normalize(Vec3(0.1f, 0.9f, -0.2f))}};
  const std::vector<Moments> seen =
      seen_by_paths(scene, 0, rays, effort.count(20'000, 1'000'000), effort.seed_of(c.place()));
  const Vec3d exact = c.vector("radiance_everywhere");
  for (size_t i = 0; i < seen.size(); ++i)
    checks.push_back(
        check_mean(fmt::format("radiance_everywhere[{}]", i % 3), seen[i], exact[static_cast<int>(i % 3)], 1e-6));
}

Ray ray_past_middle(double impact) { return {Vec3(as_float(impact), 0.0f, 3.0f), Vec3(0.0f, 0.0f, -1.0f)}; }

void check_absorbing_ball(Checks& checks, const OracleCase& c) {
  const double radius = c.number_in("radius_m", 1e-3, 1e3);
  const Medium medium = read_medium(read_rgb(c, "sigma_a"), Rgb(0.0f), 0.0, read_rgb(c, "source_radiance_B"));
  const std::vector<double> impacts = c.numbers("impact_parameter_over_radius");
  const OracleValue::List& exact = *c.value("radiance").list();
  for (size_t i = 0; i < impacts.size(); ++i) {
    const double chord = 2.0 * radius * std::sqrt(1.0 - impacts[i] * impacts[i]);
    const Rgb found = emitted(medium, ray_past_middle(impacts[i]), chord);
    for (int channel = 0; channel < 3; ++channel)
      checks.push_back(check_exact(fmt::format("radiance[{}][{}]", i, channel), found[channel],
                                   *exact.at(i).list()->at(static_cast<size_t>(channel)).number()));
  }
  const Scene scene = glowing_ball(medium, {Vec3(0.0f), as_float(radius)});
  const Vec3d power = c.vector("emitted_power_W");
  const auto& volume = std::get<VolumeLight>(scene.lights[0]);
  for (int channel = 0; channel < 3; ++channel)  // its box is larger: the power is by drawn places
    checks.push_back(check_bound(fmt::format("emitted_power_W[{}]", channel), volume.power[channel], power[channel],
                                 0.05 * power[channel]));
}

void check_scattering_ball(Checks& checks, const OracleCase& c, const Effort& effort) {
  const double optical = c.number_in("R_optical", 1e-3, 1e3), albedo = c.share("albedo");
  const Medium medium = read_medium(Rgb(as_float(optical * (1.0 - albedo))), Rgb(as_float(optical * albedo)),
                                    c.number_in("g", -0.999, 0.999), Rgb(1.0f));
  const Scene scene = glowing_ball(medium, {Vec3(0.0f), 1.0f});
  const uint64_t samples = effort.count(10'000, 500'000), seed = effort.seed_of(c.place());
  // The power goes as the mean over the ball's disc: impact parameters whose squares are even.
  constexpr int kRings = 64;
  std::vector<Ray> rays;
  for (int i = 0; i < kRings; ++i) rays.push_back(ray_past_middle(std::sqrt((i + 0.5) / kRings)));
  const std::vector<Moments> rings = seen_by_paths(scene, kVacuum, rays, samples / kRings, seed);
  double mean = 0.0, variance = 0.0;
  for (size_t i = 0; i < rays.size(); ++i) {
    mean += rings[3 * i].mean() / kRings;
    variance += rings[3 * i].variance_of_mean() / (double{kRings} * kRings);
  }
  constexpr double kOfRings = 1e-3;  // the error of so many rings
  const double exact = c.number("power_out_over_4pi2a2B");
  checks.push_back(check_value("power_out_over_4pi2a2B", mean, std::sqrt(variance) + kOfRings * exact, exact));
  if (!c.has("radiance_over_B")) return;
  const std::vector<double> impacts = c.numbers("impact_parameter_over_radius"),
                            radiance = c.numbers("radiance_over_B", impacts.size());
  rays.clear();
  for (const double impact : impacts) rays.push_back(ray_past_middle(impact));
  const std::vector<Moments> seen = seen_by_paths(scene, kVacuum, rays, samples, seed + 1);
  for (size_t i = 0; i < impacts.size(); ++i)
    checks.push_back(check_mean(fmt::format("radiance_over_B[{}]", i), seen[3 * i], radiance[i], 1e-5));
}

/// Values from z = 0 to `thickness`, linear between, and the same 60 m far to the sides.
std::shared_ptr<const DensityGrid> linear_grid(double thickness, double at_zero, double at_end) {
  GridFrame frame;
  frame.index_to_world = glm::scale(Mat4d(1.0), Vec3d(2.0, 2.0, thickness));
  frame.lo = Vec3i(-30, -30, 0);
  frame.hi = Vec3i(30, 30, 1);
  return make_grid(frame, [&](int, int, int z) { return z == 0 ? at_zero : at_end; });
}

void check_linear_slab(Checks& checks, const OracleCase& c) {
  const double thickness = c.number_in("thickness_m", 1e-3, 1e3);
  const bool grid = c.has("sigma_a_at_z0"), planck = c.has("temperature_K_at_z0");
  Medium medium = read_medium(Rgb(grid ? 1.0f : as_float(c.number("sigma_a"))), Rgb(0.0f), 0.0, Rgb(1.0f));
  if (grid) medium.grid = linear_grid(thickness, c.number("sigma_a_at_z0"), c.number("sigma_a_at_zD"));
  const char *first = planck ? "temperature_K_at_z0" : "B_at_z0", *last = planck ? "temperature_K_at_zD" : "B_at_zD";
  medium.emission_grid = linear_grid(thickness, c.number(first), c.number(last));
  medium.emission->blackbody = planck;
  const std::vector<double> mu = c.numbers("mu");
  for (const bool up : {true, false}) {
    const char* field =
        planck ? (up ? "XYZ_leaving_z0" : "XYZ_leaving_zD") : (up ? "radiance_leaving_z0" : "radiance_leaving_zD");
    const OracleValue::List& exact = *c.value(field).list();
    for (size_t i = 0; i < mu.size(); ++i) {
      const Rgb found = emitted(medium, ray_through_slab(mu[i], thickness, up), thickness / mu[i]);
      const std::string name = fmt::format("{}[{}]", field, i);
      if (!planck) {
        checks.push_back(check_exact(name, found.g, *exact.at(i).number()));
        continue;
      }
      const OracleValue::List& xyz = *exact.at(i).list();
      const Rgbd rgb = linear_srgb_of_xyz({*xyz.at(0).number(), *xyz.at(1).number(), *xyz.at(2).number()});
      for (const int channel : {0, 1})  // blue is clamped where it would be negative
        checks.push_back(check_exact(fmt::format("{}, channel {}", name, channel), found[channel], rgb[channel], 1e-4));
    }
  }
}

/// The grids of the case, whose formulas it states in words.
Medium eight_voxels(double sigma_a, double sigma_s) {
  GridFrame frame;
  frame.index_to_world = glm::translate(Mat4d(1.0), Vec3d(-0.75, 0.5, 1.25)) * glm::scale(Mat4d(1.0), Vec3d(0.25));
  frame.hi = Vec3i(7);
  Medium medium = read_medium(Rgb(as_float(sigma_a)), Rgb(as_float(sigma_s)), 0.0, Rgb(1.0f));
  medium.grid = make_grid(frame, [](int i, int j, int k) { return (3 * i + 5 * j + 7 * k + i * j) % 11 / 8.0; });
  medium.emission_grid =
      make_grid(frame, [](int i, int j, int k) { return (2 * i + 3 * j + 5 * k + j * k) % 7 / 4.0; });
  return medium;
}

void check_grids(Checks& checks, const OracleCase& c) {
  constexpr std::pair<const char*, MediumEmission::Meaning> kMeanings[] = {
      {"sigma_a*density*Le", MediumEmission::Meaning::thermal},
      {"power_per_volume_grid", MediumEmission::Meaning::volume}};
  for (const char* setting : {"absorption_only", "with_scattering"}) {
    const OracleCase coefficients = c.object("settings").object(setting);
    Medium medium = eight_voxels(coefficients.number("sigma_a"), coefficients.number("sigma_s"));
    for (const auto& [mode, meaning] : kMeanings) {
      medium.emission->meaning = meaning;
      for (const OracleCase& r : c.objects("rays")) {
        const Ray ray{Vec3(r.vector("origin")), Vec3(glm::normalize(r.vector("direction_unnormalised")))};
        const double exact = r.object(setting).object("radiance_emitted").number(mode);
        checks.push_back(check_bound(fmt::format("{}, {}, {}", r.text("name"), setting, mode),
                                     emitted(medium, ray, r.number("t1")).g, exact, 5e-5 * std::max(0.1, exact)));
      }
    }
  }
  Medium medium = eight_voxels(0.9, 0.0);
  for (const auto& [mode, meaning] : kMeanings) {
    medium.emission->meaning = meaning;
    checks.push_back(check_exact(fmt::format("emitted power, {}", mode), EmittingVolume(medium, {}).power().g,
                                 c.object("emitted_power_W_of_setting_absorption_only").number(mode)));
  }
}

Scene scene_over_floor(const OracleCase& c) {
  Medium medium =
      read_medium(Rgb(as_float(c.number("sigma_a"))), Rgb(0.0f), 0.0, Rgb(as_float(c.number("source_radiance_B"))));
  const auto reflectance = as_float(c.share("reflectance"));
  if (c.has("ball_centre"))
    return glowing_ball(medium, {Vec3(c.vector("ball_centre")), as_float(c.number("ball_radius_m"))}, reflectance);
  GridFrame frame;
  frame.index_to_world = glm::translate(Mat4d(1.0), c.vector("voxel_centre")) *
                         glm::scale(Mat4d(1.0), Vec3d(c.number_in("voxel_size_m", 1e-3, 1e3)));
  const double value = c.number_in("voxel_value", 0.0, 1e6);
  medium.grid = make_grid(frame, [&](int, int, int) { return value; });
  return glowing_grid(medium, reflectance);
}

void check_floor(Checks& checks, const OracleCase& c, const Effort& effort) {
  const OracleValue::List& points = *c.value("points").list();
  std::vector<Ray> rays;
  for (const OracleValue& point : points) {
    const OracleValue::List& p = *point.list();
    rays.push_back({Vec3(as_float(*p.at(0).number()), 0.2f, as_float(*p.at(2).number())), Vec3(0.0f, -1.0f, 0.0f)});
  }
  const std::vector<double> exact = c.numbers("floor_radiance", rays.size());
  const std::vector<Moments> seen =
      seen_by_paths(scene_over_floor(c), kVacuum, rays, effort.count(10'000, 500'000), effort.seed_of(c.place()));
  for (size_t i = 0; i < exact.size(); ++i)
    checks.push_back(check_mean(fmt::format("floor_radiance[{}]", i), seen[3 * i], exact[i], 1e-5 * exact[i]));
}

void check_blackbody(Checks& checks, const OracleCase& c) {
  for (const OracleCase& row : c.objects("table")) {
    const double kelvin = row.number_in("T_K", 1.0, 1e6);
    const Vec3d xyz = row.vector("XYZ_W_m2_sr"), rgb = row.vector("rgb_clamped");
    const Vec3d sum = blackbody_xyz(kelvin);
    const Rgbd found = blackbody(kelvin);
    for (int i = 0; i < 3; ++i) {
      checks.push_back(check_exact(fmt::format("XYZ_W_m2_sr[{}], {} K", i, kelvin), sum[i], xyz[i], 1e-9));
      checks.push_back(check_bound(fmt::format("rgb_clamped[{}], {} K", i, kelvin), found[i], rgb[i], 1e-5 * rgb.x));
    }
  }
}

}  // namespace

std::vector<CaseResult> run_emission(const OracleList& list, const Effort& effort) {
  return run_each(list, [&](const OracleCase& c) {
    CaseResult result;
    const std::string part = c.text("part");
    if (part == "a") check_absorbing_slab(result.checks, c, effort);
    if (part == "b") check_scattering_slab(result.checks, c, effort);
    if (part == "b-furnace") check_furnace(result.checks, c, effort);
    if (part == "c")
      c.has("radius_m") ? check_absorbing_ball(result.checks, c) : check_scattering_ball(result.checks, c, effort);
    if (part == "d") check_linear_slab(result.checks, c);
    if (part == "e") check_grids(result.checks, c);
    if (part == "f") check_floor(result.checks, c, effort);
    if (part == "g") check_blackbody(result.checks, c);
    return result;
  });
}

}  // namespace vpm::tools
