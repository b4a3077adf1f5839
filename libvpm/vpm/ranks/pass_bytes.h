// A pass as bytes, to be sent to another process of the same program.
#pragma once

#include <string>
#include <string_view>

#include "vpm/render/pass.h"

namespace vpm {

std::string bytes_of(const Pass& pass);

/// Back to the last bit. Throws FieldError where the bytes are no pass.
Pass pass_of(std::string_view bytes);

}  // namespace vpm
