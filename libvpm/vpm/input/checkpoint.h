// A render between two passes as a file, so that one that was killed goes on where it stood.
#pragma once

#include <filesystem>
#include <string>

#include "vpm/render/render.h"

namespace vpm {

/// The number of what is written, to be counted up with each change of the fields or of what they mean. A file of
/// another number is refused. (1: files that do not tell theirs.)
inline constexpr int kCheckpointFormat = 2;

/// Writes what is rendered so far: whole or not at all. `identity` is one line that tells what is rendered: program,
/// scene, settings, seed. Throws InputError where the file cannot be written.
void write_checkpoint(const std::filesystem::path& path, const std::string& identity, const RenderResult& result);

/// Reads it back to the last bit. Throws InputError where the file is missing, damaged, of another format, or of
/// another identity: passes of different renders do not add up.
RenderResult read_checkpoint(const std::filesystem::path& path, const std::string& identity);

/// The identity that a checkpoint was written with. Throws InputError where the file is missing, no checkpoint or of
/// another format.
std::string checkpoint_identity(const std::filesystem::path& path);

}  // namespace vpm
