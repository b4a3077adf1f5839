// Density fields given by formulas: a smoke plume, a cumulus cloud, and simple shapes whose answers are known.
#pragma once

#include <span>
#include <string_view>

#include "vpm/base/vec.h"

namespace vpm {

struct ProceduralField {
  std::string_view name;
  std::string_view summary;
  Vec3 world_size;                   // m, of the box that the unit cube stands for
  float (*value)(const Vec3& unit);  // density at a point of [0, 1]^3: finite, >= 0, at most 1; y points up
};

/// All fields. Their values are pure functions of the position.
std::span<const ProceduralField> procedural_fields();

/// The field of that name, or null.
const ProceduralField* find_procedural_field(std::string_view name);

}  // namespace vpm
