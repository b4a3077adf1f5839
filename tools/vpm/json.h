// JSON whose keys keep the order in which they were written.
#pragma once

#include <fmt/format.h>
#include <cmath>
#include <nlohmann/json.hpp>

namespace vpm::tools {

using Json = nlohmann::ordered_json;

/// A number, or the text "inf", "-inf" or "nan", which JSON has no numbers for.
inline Json number(double x) { return std::isfinite(x) ? Json(x) : Json(fmt::format("{}", x)); }

}  // namespace vpm::tools
