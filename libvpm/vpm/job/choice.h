// Settings that a render is to choose, and those that it chose.
#pragma once

#include <set>
#include <string>
#include <string_view>

namespace vpm {

/// Which settings are to be chosen, by their keys; those that may be are declared Setting::automatic. What is not to be
/// chosen is never changed.
struct AutomaticSettings {
  std::set<std::string, std::less<>> keys;

  bool any() const { return !keys.empty(); }
  bool has(std::string_view key) const { return keys.find(key) != keys.end(); }
};

/// A setting that was chosen.
struct Choice {
  std::string key;    // of scene files: "volume.radius"
  std::string value;  // as --set takes it, to the last bit
  std::string reason;
};

}  // namespace vpm
