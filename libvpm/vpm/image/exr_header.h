// A look at an OpenEXR file's headers before OpenEXR gets it: do the sizes they claim agree with the file?
#pragma once

#include <filesystem>

namespace vpm {

/// Throws InputError where the file is no OpenEXR file, or where an attribute's size does not fit its type or the file
/// [OpenEXR2021, component three]. OpenEXR itself believes such sizes, and allocates before it reads.
void check_exr_header(const std::filesystem::path& path);

}  // namespace vpm
