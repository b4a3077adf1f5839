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

  /// Was a table of that path one of settings before one of the options?
  bool has_table(const std::string& path) const;
  /// Leaves out a key that was a setting before an option that stands behind it, and is none since; false where it was
  /// none.
  bool leave_out(const std::string& key, const Node& node);
  /// The same of a setting whose value another integrator does not know.
  bool leave_out_value(const std::string& key, const Node& node);
  /// Which options left out what; "" where none did.
  std::string note() const;

 private:
  /// An option after which some keys are no settings any more.
  struct Change {
    const Replacement* by;
    std::string before;                // the value of its key
    std::set<std::string> keys, gone;  // of settings before it; of these, those that are none after it
    bool left_out_any = false;
  };
  bool stands_before(const Node& node, const Change& change) const;

  const Document& document_;
  std::vector<Change> changes_;
  std::vector<std::string> left_out_;
};

}  // namespace vpm
