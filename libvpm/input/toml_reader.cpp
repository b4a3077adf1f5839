// The one file that knows toml++: text in, nodes with their places out.
#include <algorithm>

#include "base/error.h"
#include "input/toml_node.h"

#include <toml++/toml.h>

namespace vpm {
namespace {

Place place_of(const Source* source, const toml::source_region& region) {
  return {source, std::max(1u, region.begin.line), std::max(1u, region.begin.column)};
}

Node convert(const toml::node& from, const Source* source) {
  Node node;
  node.place = place_of(source, from.source());
  if (const auto* string = from.as_string())
    node.value = string->get();
  else if (const auto* integer = from.as_integer())
    node.value = integer->get();
  else if (const auto* number = from.as_floating_point())
    node.value = number->get();
  else if (const auto* boolean = from.as_boolean())
    node.value = boolean->get();
  else if (const auto* array = from.as_array()) {
    Node::Array items;
    for (const toml::node& item : *array) items.push_back(convert(item, source));
    node.value = std::move(items);
  } else if (const auto* table = from.as_table()) {
    Node::Table entries;
    for (const auto& [key, value] : *table)
      entries.push_back({std::string(key.str()), place_of(source, key.source()), convert(value, source)});
    const auto in_file_order = [](const Entry& a, const Entry& b) {
      return a.place.line != b.place.line ? a.place.line < b.place.line : a.place.column < b.place.column;
    };
    std::stable_sort(entries.begin(), entries.end(), in_file_order);
    node.value = std::move(entries);
  } else {
    node.value = DateOrTime{};
  }
  return node;
}

std::vector<std::string> split_lines(const std::string& text) {
  std::vector<std::string> lines(1);
  for (const char c : text) {
    if (c == '\n')
      lines.emplace_back();
    else if (c != '\r')
      lines.back() += c;
  }
  return lines;
}

}  // namespace

Document read_toml(const std::string& path) {
  Document document;
  document.text = read_whole_file(path);
  document.sources.push_back(std::make_unique<Source>(Source{path, split_lines(document.text)}));
  const Source* source = document.sources.front().get();
  check_toml(document.text, source);
  try {
    document.root = convert(toml::parse(document.text), source);
  } catch (const toml::parse_error& error) {
    fail_at(place_of(source, error.source()), "not valid TOML: " + std::string(error.description()));
  }
  return document;
}

std::unique_ptr<Node> parse_toml_value(const std::string& text, const Source* source) {
  try {
    check_toml(text, source);
    const toml::table table = toml::parse("value = " + text);
    if (table.size() != 1) return nullptr;
    return std::make_unique<Node>(convert(*table.get("value"), source));
  } catch (const InputError&) {
    return nullptr;
  } catch (const toml::parse_error&) {
    return nullptr;
  }
}

}  // namespace vpm
