// Tables of phase functions in text files.
#pragma once

#include <memory>
#include <string>

#include "vpm/medium/phase/phase_table.h"

namespace vpm {

/// Reads lines of an angle (degrees, from 0 to 180) or of its cosine (from -1 to 1), rising or falling, and a value,
/// parted by a comma, semicolon or white space. Three values are those of red, green and blue: as phase functions have
/// no colour here, each column is normalised, and their mean is taken. Empty lines, those that begin with #, and a
/// first line of words are passed over. Throws InputError with file and line.
std::shared_ptr<const PhaseTable> load_phase_table(const std::string& path);

}  // namespace vpm
