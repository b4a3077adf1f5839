// What guides photons: importons, particles from the camera that estimate what light is worth to the picture, and
// scouts, which say where to emit, which way to scatter, and where to follow more or fewer of them.
#pragma once

#include <optional>
#include <vector>

#include "vpm/medium/distance/strategy.h"
#include "vpm/photon/guide/cube_grid.h"
#include "vpm/photon/guide/emission_guide.h"
#include "vpm/photon/guide/guided_scatter.h"
#include "vpm/photon/photon_settings.h"
#include "vpm/scene/scene.h"

namespace vpm {

/// Importance fluence in cubes over a box. It is the adjoint of radiant fluence, up to one factor for all cubes: where
/// the importance is twice as large, a photon contributes twice as much to the picture, on average over directions. A
/// place outside the box has the importance of the nearest cube.
class ImportanceMap {
 public:
  /// An empty map of `resolution` >= 1 cubes along the box's longest edge. The box has a volume.
  ImportanceMap(const Box& box, int resolution);

  /// Adds the importance `weight` (dimensionless, >= 0), which flows along the first `length` metres of the ray, > 0.
  void add_track(const Ray& ray, float length, float weight);
  /// Adds the tracks of a map of the same box and resolution.
  void merge(const ImportanceMap& other);
  /// Ends the collection: averages over neighbouring cubes, so that a few importons also count for the cubes around
  /// theirs, and raises every cube to at least a small fraction of the mean.
  void finish();

  /// The importance at a place, > 0 after finish().
  float at(const Vec3& p) const { return values_[grid_.number_at(p)]; }
  /// The distance along the ray at which the importance first exceeds `level`, m: just inside the first such cube. The
  /// cube of the ray's origin does not count. Infinite if there is none.
  float first_above(const Ray& ray, float level) const;
  size_t memory_bytes() const { return values_.size() * sizeof(float); }

 private:
  CubeGrid grid_;
  std::vector<float> values_;
};

struct Importance {
  ImportanceMap map;
  std::optional<DirectionGuide> directions;  // where GuideSettings::scatter asks for them
};

/// Importons from the camera [Peter1998, sec. 3]: eye paths, one from a random pixel each, that fly, scatter and are
/// absorbed as light would be, with radiance's factors. Each adds its tracks. `settings.importons` >= 1; a pure
/// function of settings, seed and pass.
Importance trace_importons(const Scene& scene, const DistanceStrategy& strategy, const GuideSettings& settings,
                           uint64_t seed, uint64_t pass, int max_events);

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
