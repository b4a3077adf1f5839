// Settings that a render is to choose, and those that it chose.
#pragma once

#include <set>
#include <string>
#include <string_view>

#include "vpm/integrators/settings.h"

namespace vpm {

/// Which settings are to be chosen, by their keys; those that may be are Setting::automatic. What is not to be
/// chosen is never changed.
struct AutomaticSettings {
  using Keys = std::set<std::string, std::less<>>;
  Keys keys{};           // those that are "auto"
  Keys default_radii{};  // those that nothing is said of: they go by where photons lie

  bool any() const { return !keys.empty() || !default_radii.empty(); }
  bool has(std::string_view key) const { return keys.contains(key) || default_radii.contains(key); }
  /// Those that a file could give values: where the integrator is "auto", it alone.
  Keys to_be_named() const { return keys.contains("integrator.type") ? Keys{"integrator.type"} : keys; }
};

/// What a setting that may be "auto" is where a scene file and its options leave it out: its default, or "auto". Where
/// these do not name the integrator, but ask for a time, `automatic` also drops all that they say of it, so that ways
/// to render are compared; `all_automatic` does so in any case.
enum class LeftOut { defaults, automatic, all_automatic };

/// A setting that was chosen.
struct Choice {
  std::string key;    // of scene files: "integrator.volume.radius"
  std::string value;  // as --set takes it, to the last bit
  std::string reason;
};

/// Puts a choice made earlier into the settings. Throws InputError where it is none: a setting that is not
/// Setting::automatic, or a value that is not of its domain, or 0.
void set_chosen(RenderSettings& settings, const std::string& key, const std::string& value);

}  // namespace vpm
