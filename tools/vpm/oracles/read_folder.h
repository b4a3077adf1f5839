// The files of a folder of reference numbers, and tables that repeat cases of JSON files.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "oracles/cases.h"

namespace vpm::tools {

/// What a folder holds: files *.json with lists of cases, and tables *.csv that repeat cases, a column for each field.
struct OracleFolder {
  std::deque<OracleValue> documents;  // that the cases point into
  std::vector<OracleList> lists;      // in the order of the files' names
  std::vector<OracleList> tables;     // rows of numbers and text by column
};

/// Throws InputError where a file cannot be read, is not JSON, or holds no list of cases.
OracleFolder read_oracle_folder(const std::string& path);

/// Compares a table's rows with the cases of the same id in the files of the same problem (s1_, s2_, ...), number by
/// number. Rows without such a case go to `alone`, to be checked as cases themselves.
CaseResult compare_table(const OracleList& table, const std::vector<OracleList>& lists, OracleList& alone);

}  // namespace vpm::tools
