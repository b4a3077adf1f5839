// What a photon does first and between flights: emission, by kind of light, and scattering from surfaces, by material.
#include "benchmarks/bench.h"
#include "vpm/base/rng.h"
#include "vpm/base/warp.h"
#include "vpm/light/light.h"
#include "vpm/surface/material/material.h"

namespace vpm::bench {
namespace {

constexpr size_t kEmissions = 1'000'000;

double emit_from(const Light& light) {
  const Box scene{Vec3(-1.0f), Vec3(1.0f)};
  Rng rng(1, rng_stream(RngUse::photon, 0), 0);
  double sum = 0.0;
  for (size_t i = 0; i < kEmissions; ++i) sum += emit(light, scene, rng).ray.direction.y;
  return sum;
}

std::shared_ptr<const ImageEnvironment> sky() {
  const int width = 512, height = 256;
  std::vector<Rgb> texels(static_cast<size_t>(width) * height);
  for (size_t i = 0; i < texels.size(); ++i) texels[i] = Rgb(1.0f + static_cast<float>(i % 97));
  return std::make_shared<const ImageEnvironment>(width, height, std::move(texels));
}

}  // namespace

void measure_emission(Bench& bench, const Sizes&) {
  const Light lights[] = {PointLight{},  SpotLight{},        BeamLight{},           QuadLight{},          DiscLight{},
                          SphereLight{}, DirectionalLight{}, ConstantEnvironment{}, EnvironmentMap{sky()}};
  for (const Light& light : lights)
    bench.compare({"Emitting from: " + std::string(light_kind(light)),
                   "photon",
                   static_cast<double>(kEmissions),
                   0.0,
                   Clock::processor,
                   {{"vpm, emit", [&] { return emit_from(light); }}}});
}

namespace {

constexpr size_t kPhotons = 1'000'000;

struct Named {
  const char* name;
  Material material;
};

double scatter_from(const Material& material) {
  const Vec3 normal(0.0f, 1.0f, 0.0f);
  Rng rng(1, rng_stream(RngUse::photon, 0), 0);
  double sum = 0.0;
  for (size_t i = 0; i < kPhotons; ++i) {
    const Vec3 travel = -cosine_hemisphere(normal, rng.uniform2());
    const float choice = rng.uniform();
    sum += sample_scatter(material, normal, travel, choice, rng.uniform2()).weight.r;
  }
  return sum;
}

}  // namespace

void measure_scattering(Bench& bench, const Sizes&) {
  const Named materials[] = {{"Lambertian", Lambertian{}},
                             {"Phong", Phong{}},
                             {"mirror", Mirror{}},
                             {"conductor", Conductor{Rgb(0.2f), Rgb(3.0f)}},
                             {"rough conductor", RoughConductor{Rgb(0.2f), Rgb(3.0f), 0.2f}},
                             {"dielectric", Dielectric{}},
                             {"thin dielectric", ThinDielectric{}},
                             {"rough dielectric", RoughDielectric{1.5f, 0.2f}}};
  for (const auto& [name, material] : materials)
    bench.compare({"Scattering, with a direction of arrival: " + std::string(name),
                   "photon",
                   static_cast<double>(kPhotons),
                   0.0,
                   Clock::processor,
                   {{"vpm, sample_scatter", [&m = material] { return scatter_from(m); }}}});
}

}  // namespace vpm::bench
