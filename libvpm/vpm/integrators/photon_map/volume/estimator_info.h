// The estimators of the light of media: what each is, which settings it has, and how it is made. Each file of this
// folder has some, and estimators.cpp the list.
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "vpm/integrators/photon_map/volume/volume_settings.h"

namespace vpm {

class Description;
struct RenderSettings;
struct SceneFacts;
struct VolumePlan;
class VolumeEstimator;

struct VolumeEstimatorInfo {
  std::string_view name;
  std::string_view summary;              // Markdown
  GatherMode mode = GatherMode::radius;  // of its maps of photons
  bool along_rays = false;               // gathers along whole segments of rays, not around points of a march
  bool collisions = true;                // has a map of these
  bool flights = false;                  // has a map of these
  bool planes = false;                   // makes planes of some, which cost shadow rays
  /// What it has besides radius, kernel, form, boundary and density_floor.
  void (*describe)(VolumeSettings&, Description&) = nullptr;
  /// Throws SettingError where it does not go with other settings or the scene; null: it goes with all.
  void (*check)(const RenderSettings&, const SceneFacts&) = nullptr;
  /// Null: photons are gathered around the points of MarchedLight.
  std::unique_ptr<VolumeEstimator> (*make)(const VolumePlan&) = nullptr;
};

std::span<const VolumeEstimatorInfo> volume_estimators();

}  // namespace vpm
