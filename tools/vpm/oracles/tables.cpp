// Rows against cases.
#include "oracles/tables.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

namespace vpm::tools {
namespace {

/// Do a cell and a field say the same? Numbers to the digits that a table keeps; "inf" and null stand for themselves.
bool agree(const OracleCase& row, const OracleCase& other, const std::string& column) {
  if (!row.has(column) || !other.has(column)) return row.has(column) == other.has(column);
  const OracleValue& field = other.value(column);
  if (!field.number()) return field.text() && *field.text() == row.text(column);
  const double a = row.number_or_infinity(column), b = other.number(column);
  return std::abs(a - b) <= 1e-12 * std::abs(b);
}

/// Does the row repeat the case, or the case's own fields and those of one object in a list of it (a quantile)?
bool repeats(const OracleCase& row, const OracleCase& other) {
  std::vector<std::string> rest;
  for (const auto& [column, cell] : row.fields()) {
    if (!other.fields().contains(column))
      rest.push_back(column);
    else if (!agree(row, other, column))
      return false;
  }
  if (rest.empty()) return true;
  for (const auto& [name, value] : other.fields()) {
    if (!value.list() || value.list()->empty() || !value.list()->front().object()) continue;
    for (const OracleCase& part : other.objects(name)) {
      const bool same = std::all_of(rest.begin(), rest.end(), [&](const std::string& column) {
        return part.fields().contains(column) && agree(row, part, column);
      });
      if (same) return true;
    }
  }
  return false;
}

/// "s1" of "s1_quantiles.csv".
std::string problem_of(const std::string& file) { return file.substr(0, file.find('_')); }

}  // namespace

CaseResult compare_table(const OracleList& table, const std::vector<OracleList>& lists, OracleList& alone) {
  CaseResult result;
  result.id = "rows of the table";
  double same = 0.0, compared = 0.0;
  std::string differs;
  for (const OracleCase& row : table.cases) {
    const std::string id = row.text("id");
    bool known = false, equal = false;
    for (const OracleList& list : lists) {
      if (problem_of(list.file) != problem_of(table.file)) continue;
      for (const OracleCase& c : list.cases) {
        if (!c.has("id") || c.text("id") != id) continue;
        known = true;
        equal = equal || repeats(row, c);
      }
    }
    if (!known) {
      alone.cases.push_back(row);
      continue;
    }
    compared += 1.0;
    same += equal;
    if (!equal && differs.empty()) differs = id;
  }
  if (compared == 0.0) return result;
  result.checks.push_back(check_bound("rows that repeat the JSON case of their id", same, compared, 0.0));
  if (!differs.empty()) result.checks.back().note = "the first that does not: " + differs;
  return result;
}

}  // namespace vpm::tools
