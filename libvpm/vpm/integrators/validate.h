// Settings that contradict themselves or their scene are refused, whoever asks: a scene file or code.
#pragma once

#include "vpm/base/error.h"
#include "vpm/integrators/settings.h"
#include "vpm/scene/scene.h"

namespace vpm {

/// What a scene has that settings must suit.
struct SceneFacts {
  bool grids = false;             // media of grids
  bool scattering_media = false;  // media that scatter
  bool rough_surfaces = false;    // surfaces that store photons; mirrors and glass do not
  bool endless = false;           // the medium of the world, which scatters ...
  bool endless_flights = false;   // ... and does not attenuate one of the channels

  /// What the medium of the world adds.
  void add_world(const Medium& medium);
};
SceneFacts facts_of(const Scene& scene);

/// A setting that cannot be as it is.
class SettingError : public InputError {
 public:
  SettingError(std::string key, std::string wrong, std::string right);
  const std::string& key() const { return key_; }      // of scene files: "integrator.volume.radius"
  const std::string& wrong() const { return wrong_; }  // what is wrong
  const std::string& right() const { return right_; }  // what would be right; may be empty

 private:
  std::string key_, wrong_, right_;
};

/// Throws a SettingError where a setting of the chosen components is out of its range, or contradicts another or the
/// scene. Members that these components do not have are not looked at, here as in a render.
void validate(const RenderSettings& settings, const SceneFacts& facts);
/// The same for a light map, which is of photon maps, has no radii of pixels' own, and is not baked until an error is
/// reached.
void validate_light_map(const RenderSettings& settings, const SceneFacts& facts);

}  // namespace vpm
