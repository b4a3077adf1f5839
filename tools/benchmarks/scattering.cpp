// Scattering photons from surfaces, by material.
#include "benchmarks/bench.h"
#include "vpm/base/rng.h"
#include "vpm/base/warp.h"
#include "vpm/surface/material.h"

namespace vpm::bench {
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
