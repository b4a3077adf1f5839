// The tables of settings of a scene file, and what is wrong with what they say.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "vpm/base/settings/setting.h"
#include "vpm/base/settings/setting_error.h"
#include "vpm/input/replaced_keys.h"
#include "vpm/input/table_reader.h"

namespace vpm {

/// The value of a key that the table has, checked against the setting's domain; nothing where it is kAuto.
std::optional<SettingValue> read_value(TableReader& table, const Setting& setting);

/// Tables by their paths, "integrator.volume", each read from the file when it is first asked for.
class SettingTables {
 public:
  explicit SettingTables(TableReader& root) : root_(root) {}

  /// Null where the file has none.
  TableReader* find(const std::string& path);
  /// Refuses keys that nobody asked for, but for those that options have replaced: these are left out. `integrator` is
  /// the one that is named.
  void finish(const std::string& integrator, ReplacedKeys& replaced);
  /// Points at the key, or at the table around it that there is.
  [[noreturn]] void fail(const SettingError& error);

 private:
  void finish(const std::string& path, const Entry& entry, const std::string& integrator, ReplacedKeys& replaced);

  TableReader& root_;
  std::map<std::string, std::optional<TableReader>> tables_;
};

}  // namespace vpm
