// What the readers of the two mesh formats share.
#pragma once

#include <string>
#include <string_view>

#include "vpm/surface/geometry.h"

namespace vpm {

/// The meshes as they stand in the text; indices are only checked to be >= 0 and to fit. `name` is for messages.
TriangleMesh parse_ply(const std::string& name, std::string_view text);
TriangleMesh parse_obj(const std::string& name, std::string_view text);

/// Throws InputError "name:line: wrong"; "name: wrong" for line 0.
[[noreturn]] void fail_in_mesh(const std::string& name, size_t line, const std::string& wrong);

/// Appends a polygon as triangles that share its first corner.
void add_fan(const std::vector<uint32_t>& corners, TriangleMesh& mesh);

}  // namespace vpm
