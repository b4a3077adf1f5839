// What guides photons: where to emit them, which way to scatter them, and where to follow more or fewer of them.
#pragma once

#include "vpm/photon/emission_guide.h"
#include "vpm/photon/importons.h"

namespace vpm {

/// Learned anew for each pass, from the scene alone.
struct PhotonGuide {
  ImportanceMap importance;
  std::optional<DirectionGuide> directions;
  EmissionGuide emission;
  /// Power times importance that a photon should carry, W: the mean over photons at their first events.
  double value = 0.0;

  /// What a photon of that power (sum over channels, W) is worth at a place, next to what it should be.
  double worth(double power, const Vec3& p) const { return value > 0.0 ? power * importance.at(p) / value : 1.0; }
  /// How far along the ray a photon of that power is worth more than `worth`, m; infinite where it never is.
  float rise(double power, const Ray& ray, double worth) const {
    return value > 0.0 ? importance.first_above(ray, static_cast<float>(worth * value / power)) : kInfinity;
  }
  size_t memory_bytes() const {
    return importance.memory_bytes() + (directions ? directions->memory_bytes() : 0) + emission.memory_bytes();
  }
};

/// Traces importons, and as many first flights of photons as scouts. `settings.importons` >= 1.
PhotonGuide learn_guide(const Scene& scene, const DistanceStrategy& strategy, const GuideSettings& settings,
                        uint64_t seed, uint64_t pass, int max_events);

}  // namespace vpm
