// Directions after a surface: by the cosine law, the mirror's and Snell's, and in the lobes of rough materials; and
// what refraction does to radiance.
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <complex>

#include "vpm/base/warp.h"
#include "vpm/study/sample_moments.h"
#include "vpm/study/validate/groups.h"
#include "vpm/study/validate/scenes/directions.h"
#include "vpm/study/validate/scenes/lobes.h"
#include "vpm/surface/material/facet_loss.h"

namespace vpm {

namespace {

const Vec3 kUpright = glm::normalize(Vec3(0.3f, 0.8f, -0.4f));

/// A direction of travel towards the surface's outside (or, turned round, its inside) at that angle of incidence.
Vec3 arriving(double angle, bool from_outside) {
  const Vec3 side = from_outside ? kUpright : -kUpright;
  return -direction_about(side, static_cast<float>(2.0 * std::pow(std::sin(0.5 * angle), 2.0)), 1.0f);
}

/// Reflection under the cosine law: cells of equal flux, and the value that shadow rays use, integrated.
std::vector<Check> check_diffuse(bool from_outside, const Effort& effort) {
  constexpr size_t kBands = 6, kPatches = kBands * kSectors;
  const Material material = Lambertian{Rgb(0.7f)};
  const Vec3 travel = arriving(1.0, from_outside), near = from_outside ? kUpright : -kUpright;
  const std::string name = fmt::format("diffuse, from {}", from_outside ? "outside" : "inside");
  const auto samples =
      sample_moments(kPatches + 2, effort.count(100'000, 10'000'000), effort.seed_of(name), [&](Rng& rng, double* out) {
        const Scatter scatter = sample_scatter(material, kUpright, travel, rng.uniform(), rng.uniform2());
        const double cosine = 1.0 - away_from(near, scatter.direction);
        out[cell_of(cosine * cosine, kBands) * kSectors + sector_about(near, scatter.direction)] = cosine > 0.0;
        const ScatterValue value = scatter_value(material, kUpright, travel, uniform_sphere(rng.uniform2()));
        out[kPatches] = 4.0 * kPiD * value.value.g;
        out[kPatches + 1] = 4.0 * kPiD * value.pdf;
      });
  const std::vector<double> equal(kPatches, 1.0 / static_cast<double>(kPatches));
  return {check_weights(name + ", directions", {samples.begin(), samples.end() - 2}, equal),
          check_mean(name + ", integral of values", samples[kPatches], 0.7),
          check_mean(name + ", integral of its pdf", samples[kPatches + 1], 1.0)};
}

/// Glass, from either side: the mirror's law or Snell's for each drawn direction, weight 1 for photons, and radiance
/// scaled by 1/eta^2 where it passes.
std::vector<Check> check_glass(float ior, bool from_outside, double angle, const Effort& effort) {
  const Vec3 travel = arriving(angle, from_outside), near = from_outside ? kUpright : -kUpright;
  const double eta = from_outside ? ior : 1.0 / ior, sine = std::min(1.0, std::sin(angle) / eta);  // of refraction
  const std::string name = fmt::format("glass, {:.1f} rad from {}", angle, from_outside ? "outside" : "inside");
  const auto samples =
      sample_moments(2, effort.count(2'000, 100'000), effort.seed_of(name), [&](Rng& rng, double* out) {
        const Scatter scatter = sample_scatter(Dielectric{ior}, kUpright, travel, rng.uniform(), rng.uniform2());
        const double ratio = scatter.transmitted ? eta : 1.0;
        const double along = scatter.transmitted ? -std::sqrt(1.0 - sine * sine) : std::cos(angle);
        const Vec3d direction(scatter.direction), n(near);
        const Vec3d across = ratio * glm::cross(direction, n) - glm::cross(Vec3d(travel), n);
        out[0] = std::fabs(glm::dot(direction, n) - along) + glm::length(across);
        out[1] = std::fabs(scatter.radiance_scale * ratio * ratio - 1.0) + std::fabs(scatter.weight.g - 1.0);
      });
  return {check_bound(name + ", off its directions", samples[0].mean(), 0.0, 2e-6),
          check_bound(name + ", off its weights", samples[1].mean(), 0.0, 1e-6)};
}

/// A pane of glass: of the light that meets it each face reflects R, and 2 R / (1 + R) comes back.
Check check_pane(const Effort& effort) {
  constexpr double kAngle = 1.2, kIor = 1.5;
  const Vec3 travel = arriving(kAngle, true);
  const double c = std::cos(kAngle), t = std::sqrt(1.0 - std::pow(std::sin(kAngle) / kIor, 2.0));
  const double perpendicular = (c - kIor * t) / (c + kIor * t), parallel = (kIor * c - t) / (kIor * c + t);
  const double reflected = 0.5 * (perpendicular * perpendicular + parallel * parallel);
  const auto samples =
      sample_moments(1, effort.count(20'000, 1'000'000), effort.seed_of("pane"), [&](Rng& rng, double* out) {
        const float choice = rng.uniform();
        out[0] = !sample_scatter(ThinDielectric{kIor}, kUpright, travel, choice, rng.uniform2()).transmitted;
      });
  return check_probability("pane of glass, 1.2 rad, reflected", samples[0], 2.0 * reflected / (1.0 + reflected));
}

Check check_mirror() {
  const Vec3 travel = arriving(0.8, true);
  const Scatter scatter = sample_scatter(Mirror{}, kUpright, travel, 0.5f, Vec2(0.5f));
  return check_bound("mirror, off its direction", glm::distance(scatter.direction, glm::reflect(travel, kUpright)), 0.0,
                     1e-6);
}

/// What closed forms know of rough surfaces, to the error of the quadrature. Metal that absorbs nothing, of roughness
/// 1, seen along its normal: the integral of density and shadowing over its facets is that of 2 tan x cos 2x over [0,
/// pi/4], 1 - ln 2. Phong's lobe is whole along the normal.
std::vector<Check> check_rough_albedos() {
  const auto albedo = [](const Material& material) {
    return LobeCells({material, kUpright, -kUpright}).integrate().near;
  };
  const RoughConductor perfect{Rgb(1.0f), Rgb(1e6f), 1.0f};
  return {check_bound("perfect metal, roughness 1, seen along its normal", albedo(perfect), 1.0 - std::log(2.0), 1e-3),
          check_bound("Phong, seen along its normal", albedo(Phong{Rgb(0.3f), Rgb(0.6f), 5.0f}), 0.9, 1e-3)};
}

/// Phong's lobes lose what they would send under the horizon: even light against the mean of the albedo over cos^2.
Check check_furnace_of_phong(const Effort& effort) {
  const Phong phong{Rgb(0.3f), Rgb(0.7f), 10.0f};
  constexpr int kAngles = 32;
  double exact = 0.0;
  for (int i = 0; i < kAngles; ++i) {
    const double angle = std::acos(std::sqrt((i + 0.5) / kAngles));
    exact += LobeCells({phong, kUpright, arriving(angle, true)}).integrate().near / kAngles;
  }
  const auto samples =
      sample_moments(1, effort.count(20'000, 2'000'000), effort.seed_of("phong"), [&](Rng& rng, double* out) {
        const Vec3 travel = -cosine_hemisphere(kUpright, rng.uniform2());
        const float choice = rng.uniform();
        out[0] = sample_scatter(phong, kUpright, travel, choice, rng.uniform2()).weight.g;
      });
  return check_mean("furnace outside of Phong", samples[0], exact, 2.0 * LobeCells::kError);
}

/// A furnace about a surface: of even light from one side all leaves, whatever the material does to it, except what it
/// absorbs, which here is nothing. Perfect metal reflects all; materials of microfacets give back what their main lobes
/// lose.
std::vector<Check> check_furnaces(const Effort& effort) {
  std::vector<std::pair<std::string, Material>> materials{{"diffuse", Lambertian{Rgb(1.0f)}},
                                                          {"mirror", Mirror{}},
                                                          {"perfect metal, smooth", Conductor{Rgb(1.0f), Rgb(1e6f)}},
                                                          {"glass", Dielectric{1.5f}},
                                                          {"pane of glass", ThinDielectric{1.5f}}};
  for (const float roughness : {0.05f, 0.3f, 0.6f, 1.0f}) {
    const auto of_roughness = [&](const char* what) { return fmt::format("{}, roughness {:.2g}", what, roughness); };
    materials.emplace_back(of_roughness("perfect metal"), RoughConductor{Rgb(1.0f), Rgb(1e6f), roughness});
    materials.emplace_back(of_roughness("rough glass"), RoughDielectric{1.5f, roughness});
  }
  std::vector<Check> checks;
  for (auto& [what, material] : materials) {
    const std::shared_ptr<const FacetLoss> loss = facet_loss_of(material);
    set_facet_loss(material, loss.get());
    for (const bool from_outside : {true, false}) {
      const std::string name = fmt::format("furnace {} of {}", from_outside ? "outside" : "inside", what);
      const auto samples = sample_moments(
          1, effort.count(20'000, 2'000'000), effort.seed_of(name), [&, &material = material](Rng& rng, double* out) {
            const Vec3 travel = -cosine_hemisphere(from_outside ? kUpright : -kUpright, rng.uniform2());
            const float choice = rng.uniform();
            out[0] = sample_scatter(material, kUpright, travel, choice, rng.uniform2()).weight.g;
          });
      // The losses are integrals by a rule, and lie on straight lines between cosines.
      if (samples[0].variance() == 0.0)
        checks.push_back(check_bound(name, samples[0].mean(), 1.0, 1e-6));
      else
        checks.push_back(check_mean(name, samples[0], 1.0, LobeCells::kError));
    }
  }
  checks.push_back(check_furnace_of_phong(effort));
  return checks;
}

/// A smooth metal's reflectance in complex numbers.
Check check_metal() {
  const double cosine = std::cos(1.1);
  const Vec3 travel = arriving(1.1, true);
  const std::complex<double> index(0.3, 2.7), across = std::sqrt(index * index - (1.0 - cosine * cosine));
  const double perpendicular = std::norm((cosine - across) / (cosine + across));
  const double parallel = std::norm((index * index * cosine - across) / (index * index * cosine + across));
  const Scatter scatter = sample_scatter(Conductor{Rgb(0.3f), Rgb(2.7f)}, kUpright, travel, 0.5f, Vec2(0.5f));
  return check_bound("smooth metal, reflectance", scatter.weight.g, 0.5 * (perpendicular + parallel), 1e-6);
}

std::vector<Check> check_rough_materials(const Effort& effort) {
  const Rgb eta(0.4f), k(2.5f);
  const std::vector<double> common{0.3, 1.2}, extreme{0.0, 1.45};  // angles of incidence
  const std::tuple<const char*, Material, std::vector<double>> materials[] = {
      {"Phong, broad", Phong{Rgb(0.3f), Rgb(0.6f), 5.0f}, common},
      {"Phong, narrow", Phong{Rgb(0.2f), Rgb(0.5f), 2000.0f}, common},
      {"metal, roughness 0.05", RoughConductor{eta, k, 0.05f}, common},
      {"metal, roughness 0.6", RoughConductor{eta, k, 0.6f}, common},
      {"rough glass, roughness 0.05", RoughDielectric{1.5f, 0.05f}, common},
      {"rough glass, roughness 0.6", RoughDielectric{1.5f, 0.6f}, common},
      // Along the normal the horizon, where this lobe ends at its height, would lie between the quadrature's places.
      {"Phong, exponent 0", Phong{Rgb(0.0f), Rgb(0.6f), 0.0f}, common},
      {"Phong, exponent 1e6", Phong{Rgb(0.0f), Rgb(0.9f), 1e6f}, extreme},
      {"metal, roughness 0.001", RoughConductor{eta, k, 0.001f}, extreme},
      {"metal, roughness 1", RoughConductor{eta, k, 1.0f}, extreme},
      {"rough glass, roughness 0.01", RoughDielectric{1.5f, 0.01f}, extreme},
      {"rough glass, roughness 1, ior 1.2", RoughDielectric{1.2f, 1.0f}, extreme},
      {"rough glass, roughness 0.1, ior 1.01", RoughDielectric{1.01f, 0.1f}, extreme},
      {"rough glass, roughness 0.5, ior 0.6", RoughDielectric{0.6f, 0.5f}, extreme},
  };
  std::vector<Check> checks = check_rough_albedos();
  checks.push_back(check_metal());
  for (const auto& [what, main_lobes, angles] : materials) {
    Material material = main_lobes;
    const std::shared_ptr<const FacetLoss> loss = facet_loss_of(material);
    set_facet_loss(material, loss.get());
    for (const bool from_outside : {true, false})
      for (const double angle : angles) {
        const std::string name = fmt::format("{}, {} rad from {}", what, angle, from_outside ? "outside" : "inside");
        const RoughIncidence in{material, kUpright, arriving(angle, from_outside)};
        append(checks, check_lobes(name, in, effort.count(50'000, 500'000), effort));
      }
  }
  return checks;
}

}  // namespace

std::vector<Experiment> material_experiments() {
  return {{0, "directions after a surface",
           [](const Effort& effort) {
             std::vector<Check> checks{check_mirror(), check_pane(effort)};
             for (const bool from_outside : {true, false}) {
               append(checks, check_diffuse(from_outside, effort));
               for (const double angle : {0.2, 0.7, 1.2})
                 append(checks, check_glass(1.5f, from_outside, angle, effort));
             }
             return checks;
           }},
          {0, "lobes of rough surfaces", check_rough_materials},
          {0, "furnaces about surfaces", check_furnaces}};
}

}  // namespace vpm
