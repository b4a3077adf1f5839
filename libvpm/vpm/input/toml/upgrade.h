// Scene files and experiments of older versions, with the keys of today.
#pragma once

#include <string>
#include <vector>

namespace vpm {

struct Upgraded {
  std::string text;                  // as it was, but for old keys; comments stay with what they stand at
  std::vector<std::string> notes{};  // what is left out, as the components that the file names do not have it
};

/// Rewrites the text of a TOML file; `name` is what errors call it. A file without old keys comes back as it was.
/// Throws InputError where it is not TOML, or has old keys that cannot be rewritten line by line.
Upgraded upgrade(const std::string& name, const std::string& text);

}  // namespace vpm
