// What guides photons: where to emit them, and where on their way to follow more or fewer of them.
#pragma once

#include "photon/emission_guide.h"
#include "photon/importance_map.h"

namespace vpm {

/// How photons are guided. Whatever is chosen, results stay unbiased: importance decides how many photons go somewhere,
/// and their powers make up for it.
struct GuideSettings {
  uint64_t importons = 0;  // per pass; 0: photons are not guided
  bool aim = true;         // emit more where photons are worth more
  bool split = true;       // follow photons by several where they are worth more, by fewer where less
};

/// Learned anew for each pass, from the scene alone.
struct PhotonGuide {
  ImportanceMap importance;
  EmissionGuide emission;
  /// Power times importance that a photon should carry, W: the mean over photons at their first events.
  double value = 0.0;

  /// What a photon of that power (sum over channels, W) is worth at a place, next to what it should be.
  double worth(double power, const Vec3& p) const { return value > 0.0 ? power * importance.at(p) / value : 1.0; }
  /// How far along the ray a photon of that power is worth more than `worth`, m; infinite where it never is.
  float rise(double power, const Ray& ray, double worth) const {
    return value > 0.0 ? importance.first_above(ray, static_cast<float>(worth * value / power)) : kInfinity;
  }
  size_t memory_bytes() const { return importance.memory_bytes() + emission.memory_bytes(); }
};

/// Traces importons, and as many first flights of photons as scouts. `settings.importons` >= 1.
PhotonGuide learn_guide(const Scene& scene, const DistanceStrategy& strategy, const GuideSettings& settings,
                        uint64_t seed, uint64_t pass, int max_events);

}  // namespace vpm
