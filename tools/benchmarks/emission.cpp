// Emitting photons, by kind of light.
#include "benchmarks/bench.h"
#include "vpm/light/light.h"

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

}  // namespace vpm::bench
