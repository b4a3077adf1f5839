// Reading of JSON files and CSV tables; rows against cases.
#include "oracles/read_folder.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "vpm/base/error.h"

namespace vpm::tools {
namespace {

OracleValue value_of(const nlohmann::json& json) {
  if (json.is_number()) return {json.get<double>()};
  if (json.is_string()) return {json.get<std::string>()};
  if (json.is_boolean()) return {std::string(json.get<bool>() ? "true" : "false")};
  if (json.is_array()) {
    OracleValue::List list;
    for (const nlohmann::json& item : json) list.push_back(value_of(item));
    return {std::move(list)};
  }
  if (json.is_object()) {
    OracleValue::Object object;
    for (const auto& [name, item] : json.items()) object[name] = value_of(item);
    return {std::move(object)};
  }
  return {};
}

/// What a case calls itself, or its place in its list.
std::string name_of(const OracleValue::Object& fields, size_t index) {
  const auto id = fields.find("id");
  return id != fields.end() && id->second.text() ? *id->second.text() : fmt::format("number {}", index);
}

OracleList read_list(const std::string& file, const std::string& name, const OracleValue::List& items) {
  OracleList list{file, name, {}};
  for (const OracleValue& item : items) {
    const size_t index = list.cases.size();
    if (!item.object()) throw InputError(fmt::format("{}: {}, number {}: it is no object", file, name, index));
    list.cases.emplace_back(*item.object(), fmt::format("{}: {}", file, name_of(*item.object(), index)));
  }
  return list;
}

void read_json(const std::filesystem::path& path, OracleFolder& folder) {
  const std::string file = path.filename().string();
  std::ifstream stream(path);
  const auto document = nlohmann::json::parse(stream, nullptr, false);
  if (!document.is_object()) throw InputError(file + ": it is no JSON object");
  folder.documents.push_back(value_of(document));
  bool any = false;
  for (const auto& [name, value] : *folder.documents.back().object()) {
    if (!value.list()) continue;
    any = true;
    folder.lists.push_back(read_list(file, name, *value.list()));
  }
  if (!any) throw InputError(file + ": it holds no list of cases");
}

/// The cells of a line; commas inside quotes belong to the text.
std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      cells.emplace_back();
    else if (c != '\r')
      cells.back() += c;
  }
  return cells;
}

void read_csv(const std::filesystem::path& path, OracleFolder& folder) {
  const std::string file = path.filename().string();
  std::ifstream stream(path);
  std::string line;
  if (!std::getline(stream, line)) throw InputError(file + ": it is empty");
  const std::vector<std::string> columns = split(line);
  OracleValue::List rows;
  while (std::getline(stream, line)) {
    const std::vector<std::string> cells = split(line);
    if (cells.size() != columns.size())
      throw InputError(fmt::format("{}: row {} has {} cells, its header has {}", file, rows.size() + 1, cells.size(),
                                   columns.size()));
    OracleValue::Object row;
    for (size_t i = 0; i < columns.size(); ++i)
      row[columns[i]] = cells[i].empty() ? OracleValue{} : OracleValue{cells[i]};
    rows.push_back({std::move(row)});
  }
  folder.documents.push_back({std::move(rows)});
  folder.tables.push_back(read_list(file, "rows", *folder.documents.back().list()));
}

}  // namespace

OracleFolder read_oracle_folder(const std::string& path) {
  std::error_code failure;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(path, failure)) files.push_back(entry.path());
  if (failure) throw InputError(fmt::format("{}: {}, it must be a folder", path, failure.message()));
  std::sort(files.begin(), files.end());
  OracleFolder folder;
  for (const std::filesystem::path& file : files) {
    if (file.extension() == ".json") read_json(file, folder);
    if (file.extension() == ".csv") read_csv(file, folder);
  }
  if (folder.lists.empty() && folder.tables.empty())
    throw InputError(fmt::format("{}: it holds no .json and no .csv file", path));
  return folder;
}

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
