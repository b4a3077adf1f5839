// A walk over the document, value by value.
#include "vpm/input/fingerprint.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <filesystem>
#include <fstream>
#include <set>

#include "vpm/base/error.h"
#include "vpm/base/fnv.h"
#include "vpm/base/overloads.h"
#include "vpm/integrators/describe.h"

namespace vpm {
namespace {

using KeyValues = std::vector<std::pair<std::string, std::string>>;

std::string value_text(const Node& node) {
  const auto listed = [](const std::vector<std::string>& parts) { return fmt::format("{}", fmt::join(parts, ", ")); };
  return std::visit(Overloads{[](const std::string& text) { return text; },
                              [](const DateOrTime&) { return std::string("a date or time"); },
                              [&](const Node::Array& array) {
                                std::vector<std::string> parts;
                                for (const Node& element : array) parts.push_back(value_text(element));
                                return "[" + listed(parts) + "]";
                              },
                              [&](const Node::Table& table) {
                                std::vector<std::string> parts;
                                for (const Entry& entry : table)
                                  parts.push_back(entry.key + " = " + value_text(entry.node));
                                return "{" + listed(parts) + "}";
                              },
                              [](const auto& number) { return fmt::format("{}", number); }},
                    node.value);
}

/// "shapes.floor" of the element of that name, "shapes.0" of one without.
std::string element_path(const std::string& path, const Node& element, size_t number) {
  const Entry* name = find_entry(*element.table(), "name");
  const auto* text = name ? std::get_if<std::string>(&name->node.value) : nullptr;
  return path + "." + (text ? *text : std::to_string(number));
}

/// Appends the values under `path`; those of arrays of tables element by element.
void add_values(const Node& node, const std::string& path, KeyValues& all) {
  const Node::Array* array = node.array();
  if (const Node::Table* table = node.table()) {
    for (const Entry& entry : *table) add_values(entry.node, path.empty() ? entry.key : path + "." + entry.key, all);
  } else if (array && !array->empty() && array->front().table()) {
    for (size_t i = 0; i < array->size(); ++i) {
      const Node& element = (*array)[i];
      add_values(element, element.table() ? element_path(path, element, i) : fmt::format("{}.{}", path, i), all);
    }
  } else {
    all.emplace_back(path, value_text(node));
  }
}

std::string hash_of_bytes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  Fnv1a hash;
  hash.add(file);
  if (file.bad() || !file.eof()) throw InputError(path + ": cannot be read again for its hash");
  return hash.digits();
}

bool is_setting(const std::string& key) { return key.starts_with("render.") || key.starts_with("integrator."); }

/// The settings that say which passes are rendered.
std::set<std::string> keys_of_passes() {
  RenderSettings defaults;
  std::set<std::string> keys;
  for (const Setting& setting : describe(defaults))
    if (setting.of_passes) keys.insert(setting.key);
  return keys;
}

}  // namespace

Fingerprint fingerprint_of(const Document& document, const std::vector<std::string>& files,
                           const std::vector<std::pair<std::string, std::string>>& given, LeftOut left_out) {
  KeyValues values;
  add_values(document.root, "", values);
  for (size_t i = 0; i < files.size(); ++i)
    values.emplace_back(fmt::format("file {}, {}", i + 1, std::filesystem::path(files[i]).filename().string()),
                        "bytes of hash " + hash_of_bytes(files[i]));
  for (const auto& [name, hash] : given) values.emplace_back(name, "values of hash " + hash);
  if (left_out != LeftOut::defaults) values.emplace_back("what is left out", "is chosen");
  const std::set<std::string> of_passes = keys_of_passes();
  Fingerprint fingerprint;
  Fnv1a hash;
  for (auto& [key, value] : values) {
    if (of_passes.contains(key)) continue;
    for (const std::string& part : {key, value}) {
      hash.add(part);
      hash.add(std::string_view("\0", 1));  // keeps parts apart
    }
    if (!is_setting(key)) fingerprint.contents.emplace_back(std::move(key), std::move(value));
  }
  fingerprint.hash = hash.digits();
  return fingerprint;
}

}  // namespace vpm
