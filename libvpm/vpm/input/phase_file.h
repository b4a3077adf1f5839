// Tables of phase functions in text files.
#pragma once

#include <memory>
#include <string>

#include "vpm/medium/phase/phase_table.h"

namespace vpm {

/// Reads lines of an angle (degrees, rising from 0 to 180) and a value, parted by a comma, semicolon or white space.
/// Empty lines, those that begin with #, and a first line of words are passed over. Throws InputError with file and
/// line.
std::shared_ptr<const PhaseTable> load_phase_table(const std::string& path);

}  // namespace vpm
