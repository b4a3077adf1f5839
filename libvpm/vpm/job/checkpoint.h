// A render between two passes as a file, so that one that was killed goes on where it stood, and pieces of a render
// that several processes made become one.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "vpm/job/identity.h"
#include "vpm/job/origin.h"
#include "vpm/render/render.h"

namespace vpm {

/// The number of what is written, to be counted up with each change of the fields or of what they mean. A file of
/// another number is refused. (1: files without a number.)
inline constexpr int kCheckpointFormat = 10;

/// About how many bytes a checkpoint of the job takes.
uint64_t checkpoint_bytes(const RenderJob& job);

struct Checkpoint {
  Identity identity;  // of what is rendered
  Origin origin;      // where that is read from
  RenderResult result;
};

/// Writes what is rendered so far: whole or not at all. Throws InputError where the file cannot be written.
void write_checkpoint(const std::filesystem::path& path, const Identity& identity, const Origin& origin,
                      const RenderResult& result);

/// Reads a checkpoint back to the last bit. Throws InputError where the file is missing, damaged, or of another format.
Checkpoint read_checkpoint(const std::filesystem::path& path);
/// What is rendered so far of the render of that identity. Throws InputError, too, where the checkpoint is of another,
/// and says in what that differs.
RenderResult read_checkpoint(const std::filesystem::path& path, const Identity& identity);

/// What is rendered, as bytes for another process of the same program.
std::string bytes_of(const RenderResult& result);
/// Back to the last bit. Throws FieldError where the bytes are something else.
RenderResult result_of(std::string_view bytes);

/// The identity that a checkpoint was written with. Throws InputError where the file is missing, no checkpoint or of
/// another format.
Identity checkpoint_identity(const std::filesystem::path& path);

}  // namespace vpm
