// What media emit along a ray: through boundaries, up to the first surface.
#pragma once

#include "vpm/base/counters.h"
#include "vpm/path/segments.h"

namespace vpm {

/// Calls found(medium, radiance) for each part of the ray in a medium that emits: what arrives at the ray's origin,
/// W/(m^2 sr). `medium` is that at the origin.
template <class Found>
void each_emission(const Scene& scene, Ray ray, MediumId medium, WalkCounters& counters, Found&& found) {
  struct Visitor {
    const Scene& scene;
    const Ray& ray;
    const MediumId& medium;
    WalkCounters& counters;
    Found& found;
    Rgb kept{1.0f};

    bool pass(float length, const Encounter&) {
      if (medium == kVacuum) return true;
      const Medium& around = scene.media[medium];
      double integral = 0.0;
      if (around.emits()) {
        const EmittedLight light = emitted_along(around, ray, {0.0f, length}, counters.lookups);
        integral = light.integral;
        found(medium, kept * light.radiance);
      } else {
        const DensityIntegral crossed = density_integral(around, ray, {0.0f, length});
        count(counters.lookups, crossed.lookups);
        integral = crossed.value;
      }
      kept *= transmittance(around, integral);
      return !is_black(kept);
    }
  };
  each_segment(scene, ray, medium, kInfinity, counters, Visitor{scene, ray, medium, counters, found});
}

/// What one medium emits along the ray, which starts in `at`: what arrives at its origin, W/(m^2 sr).
inline Rgb emission_of(MediumId emitting, const Scene& scene, const Ray& ray, MediumId at, WalkCounters& counters) {
  Rgb sum(0.0f);
  each_emission(scene, ray, at, counters, [&](MediumId medium, const Rgb& radiance) {
    if (medium == emitting) sum += radiance;
  });
  return sum;
}

}  // namespace vpm
