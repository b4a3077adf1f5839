// Reading of JSON files and CSV tables.
#include "oracles/read_folder.h"

#include <fmt/format.h>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

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

}  // namespace vpm::tools
