// Tables that repeat cases of JSON files.
#pragma once

#include "oracles/read_folder.h"

namespace vpm::tools {

/// Compares a table's rows with the cases of the same id in the files of the same problem (s1_, s2_, ...), number by
/// number. Rows without such a case go to `alone`, to be checked as cases themselves.
CaseResult compare_table(const OracleList& table, const std::vector<OracleList>& lists, OracleList& alone);

}  // namespace vpm::tools
