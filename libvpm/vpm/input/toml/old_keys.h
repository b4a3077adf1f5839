// What keys of scene files were called before components had tables of their own (format 1, up to 2026-11).
#pragma once

#include <span>
#include <string_view>

#include "vpm/input/table_reader.h"

namespace vpm {

struct OldKey {
  std::string_view old_key, key;  // "volume.gather", "integrator.volume.type"
};
/// All, table by table. `surface.method` stood for two: its new keys are those of direct and of indirect light.
std::span<const OldKey> old_keys();

/// Throws an InputError at the first key that has another name now, with that.
void refuse_old_keys(TableReader& root);

}  // namespace vpm
