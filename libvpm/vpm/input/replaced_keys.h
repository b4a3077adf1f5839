// Keys that options leave out of a scene file. An option that names another component, or changes in another way which
// settings there are, leaves out what was said before it and is no setting any more.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "vpm/input/node.h"

namespace vpm {

class ReplacedKeys {
 public:
  /// The document must live as long.
  explicit ReplacedKeys(const Document& document);

  /// Was a table of that path one of settings before the options?
  bool has_table(const std::string& path) const;
  /// Leaves out a key that was a setting before an option that stands behind it; false where it was none.
  bool leave_out(const std::string& key, const Node& node);
  /// Which options left out what; "" where none did.
  std::string note() const;

 private:
  const Document& document_;
  std::set<std::string> before_;              // keys of settings
  std::vector<const Replacement*> replaced_;  // by options that change which settings there are
  std::vector<std::string> left_out_;
};

}  // namespace vpm
