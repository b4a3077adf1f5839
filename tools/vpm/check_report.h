// Checks as lines of text and as JSON.
#pragma once

#include <string>
#include <vector>

#include "vpm/study/check.h"

namespace vpm::tools {

/// "pass", "FAIL" or "not determined".
const char* verdict_word(Verdict verdict);

/// The titles of a table's columns after the name, and a check's: value, exact, error, deviation, p, verdict, note.
std::string check_columns();
std::string check_row(const Check& check);

/// The fields of a check as the text of a JSON object. An infinity or a NaN becomes text.
std::string check_json(const Check& check);

size_t count_verdicts(const std::vector<Check>& checks, Verdict verdict);

}  // namespace vpm::tools
