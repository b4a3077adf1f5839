// The list of integrators.
#include "vpm/integrators/integrator.h"

#include <array>

namespace vpm {

extern const IntegratorInfo kPhotonMaps, kPathTracer, kCombined;

const IntegratorInfo& info_of(Integrator integrator) {
  static const std::array<const IntegratorInfo*, 3> all{&kPhotonMaps, &kPathTracer, &kCombined};
  return *all.at(static_cast<size_t>(integrator));
}

RaysOfPass rays_of_pass(const Scene& scene, const RenderSettings& settings, int pass) {
  return info_of(settings.integrator).rays(scene, settings, pass);
}

}  // namespace vpm
