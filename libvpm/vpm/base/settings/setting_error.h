// Settings that cannot be as they are.
#pragma once

#include <string>
#include <vector>

#include "vpm/base/error.h"

namespace vpm {

/// A setting that contradicts another or the scene, or lies out of its range.
class SettingError : public InputError {
 public:
  SettingError(std::string key, std::string wrong, std::string right);
  const std::string& key() const { return key_; }      // of scene files: "integrator.volume.radius"
  const std::string& wrong() const { return wrong_; }  // what is wrong
  const std::string& right() const { return right_; }  // what would be right; may be empty

 private:
  std::string key_, wrong_, right_;
};

/// Throws one where there is such a contradiction.
void refuse_if(bool contradiction, const char* key, const std::string& wrong, const std::string& right);

/// "for grids: regular, delta-local": for what would be right. "did you mean ..." would mislead where a name
/// exists, but belongs to something else.
std::string listed(const char* title, const std::vector<std::string>& names);

}  // namespace vpm
