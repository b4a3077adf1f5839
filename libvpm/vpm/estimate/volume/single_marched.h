// Single scattering at points of a march: one light each, by a shadow ray.
#pragma once

#include "vpm/estimate/volume/marched.h"
#include "vpm/estimate/volume/scattered_light.h"

namespace vpm {

class SingleMarched final : public MarchedSource {
 public:
  SingleMarched(const Scene& scene, std::shared_ptr<const TransmittanceEstimator> transmittance)
      : light_(scene, std::move(transmittance)) {}

  ScatteredLight finds() const override { return {.once = true}; }
  /// Everywhere, in steps of optical thickness alone.
  Reach reach(const EyeSegment& segment) const override { return {segment.interval, kInfinity, std::nullopt}; }
  KernelEstimate at(const EyeSegment& segment, const Reach&, const Vec3& point, EyeWork& work) const override {
    const Medium& medium = *segment.medium();
    return medium.sigma_s * medium.max_density() * light_.towards_eye(light_.pick(work.rng), segment, point, work);
  }

 private:
  ScatteredOnce light_;
};

}  // namespace vpm
