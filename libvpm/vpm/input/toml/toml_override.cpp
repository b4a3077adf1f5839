// Changing a parsed scene file by `key.path=value` options.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <charconv>

#include "vpm/input/node.h"

namespace vpm {
namespace {

/// The keys between points, without the spaces around them: names may have some inside.
std::vector<std::string> split_path(const std::string& path, const Place& place) {
  std::vector<std::string> keys(1);
  for (const char c : path) {
    if (c == '.')
      keys.emplace_back();
    else if (c != ' ' || !keys.back().empty())
      keys.back() += c;
  }
  for (std::string& key : keys) key.erase(key.find_last_not_of(' ') + 1);
  for (const std::string& key : keys)
    if (key.empty())
      fail_at(place, "the path '" + path + "' has an empty key", "write it like render.passes=4 or shapes.0.radius=2");
  return keys;
}

std::string name_of(const Node& element) {
  const Node::Table* table = element.table();
  const Entry* name = table ? find_entry(*table, "name") : nullptr;
  const std::string* text = name ? std::get_if<std::string>(&name->node.value) : nullptr;
  return text ? *text : "";
}

/// The key of an element that is not there yet.
constexpr const char* kNew = "new";

bool is_number(const std::string& key) { return key.find_first_not_of("0123456789") == std::string::npos; }

/// The element of an array that `key` names, by name or by number; "new", and the number after the last one, make an
/// element.
Node& element_of(Node::Array& array, const std::string& key, const std::string& owner, const Place& place) {
  std::vector<std::string> names;
  for (Node& element : array) {
    const std::string name = name_of(element);
    if (name == key) return element;
    if (!name.empty()) names.push_back(name);
  }
  size_t index = key == kNew ? array.size() : array.size() + 1;
  if (is_number(key)) std::from_chars(key.data(), key.data() + key.size(), index);  // leaves it where it is too large
  if (index == array.size()) array.push_back(Node{place, Node::Table{}});
  if (index < array.size()) return array[index];
  const std::string next = std::string("'") + kNew + "' would be a new one";
  const std::string range = array.empty() ? "it is empty, " + next
                                          : "its elements are 0 to " + std::to_string(array.size() - 1) + ", " + next;
  fail_at(place, "'" + owner + "' has no element '" + key + "'", range + "; " + suggest(key, names, "named"));
}

/// The value under `key`; where it is missing and `made` is not null, that is put there.
Node& value_of(Node::Table& table, const std::string& key, const std::string& owner, const Node* made,
               const Place& place) {
  std::vector<std::string> keys;
  for (Entry& entry : table) {
    if (entry.key == key) return entry.node;
    keys.push_back(entry.key);
  }
  const std::string where = owner.empty() ? "the scene file" : "'" + owner + "'";
  if (!made) fail_at(place, where + " has no '" + key + "'", suggest(key, keys, "there are"));
  table.push_back({key, place, *made});
  return table.back().node;
}

/// What a path leads to; null where there is nothing.
const Node* find_node(const Node& root, const std::vector<std::string>& keys) {
  const Node* node = &root;
  for (const std::string& key : keys) {
    const Entry* const entry = node->table() ? find_entry(*node->table(), key) : nullptr;
    if (!entry) return nullptr;
    node = &entry->node;
  }
  return node;
}

/// Notes that a setting of the integrator is to have a value.
void note_replacement(Document& document, const std::vector<std::string>& keys, const Node& value,
                      const Source* option) {
  if (keys.front() != "integrator" || value.table()) return;
  const Node* const said = find_node(document.root, keys);
  if (said && said->table()) return;
  const auto before = said ? std::optional(text_of(*said)) : std::nullopt;
  document.replaced.push_back({fmt::format("{}", fmt::join(keys, ".")), before, text_of(value), option});
}

/// A table, a list, or a number without a digit before the point; other texts may do without quotes.
bool is_meant_as_value(const std::string& text) {
  const std::string_view unsigned_part = std::string_view(text).substr(text.find_first_not_of("+-") == 1 ? 1 : 0);
  return text.starts_with('{') || text.starts_with('[') ||
         (unsigned_part.size() > 1 && unsigned_part[0] == '.' && is_number(std::string(1, unsigned_part[1])));
}

}  // namespace

const Entry* find_entry(const Node::Table& table, const std::string& key) {
  for (const Entry& entry : table)
    if (entry.key == key) return &entry;
  return nullptr;
}

std::string text_of(const Node& node) {
  if (const auto* text = std::get_if<std::string>(&node.value)) return *text;
  if (const auto* integer = std::get_if<int64_t>(&node.value)) return fmt::format("{}", *integer);
  if (const auto* number = std::get_if<double>(&node.value)) return fmt::format("{}", *number);
  if (const auto* flag = std::get_if<bool>(&node.value)) return *flag ? "true" : "false";
  std::vector<std::string> words;
  if (const Node::Array* array = node.array())
    for (const Node& element : *array) words.push_back(text_of(element));
  return fmt::format("{}", fmt::join(words, "+"));
}

std::string kind_of(const Node& node) {
  constexpr const char* kNames[] = {"a string",       "an integer", "a number", "a boolean",
                                    "a date or time", "an array",   "a table"};
  return kNames[node.value.index()];
}

void apply_override(Document& document, const std::string& option) {
  document.sources.push_back(std::make_unique<Source>(Source{"--set " + option, {}}));
  const Source* source = document.sources.back().get();
  const Place place{source};
  const size_t equals = option.find('=');
  if (equals == std::string::npos) fail_at(place, "there is no '='", "write it like render.passes=4");
  const std::string text = option.substr(equals + 1);

  const std::vector<std::string> keys = split_path(option.substr(0, equals), place);
  const std::unique_ptr<Node> parsed = parse_toml_value(text, source);
  if (!parsed && is_meant_as_value(text))
    fail_at(place, "'" + text + "' is no TOML value",
            "numbers have a digit before the point, as 0.5; texts in lists and tables stand in quotes; keys and values "
            "are parted by '='");
  const Node value = parsed ? *parsed : Node{place, text};
  note_replacement(document, keys, value, source);
  Node* node = &document.root;
  std::string owner;
  const auto set = static_cast<size_t>(std::find(keys.begin(), keys.end(), "set") - keys.begin());
  const size_t tables_end = keys[0] == "integrator" ? 0 : set;  // from where on tables may be new
  for (size_t i = 0; i < keys.size(); ++i) {
    const bool is_last = i + 1 == keys.size(), of_list = !is_last && (is_number(keys[i + 1]) || keys[i + 1] == kNew);
    const Node made = of_list ? Node{place, Node::Array{}} : Node{place, Node::Table{}};
    if (auto* table = std::get_if<Node::Table>(&node->value))
      node = &value_of(*table, keys[i], owner, i == 0 || is_last || i >= tables_end ? &made : nullptr, place);
    else if (auto* array = std::get_if<Node::Array>(&node->value))
      node = &element_of(*array, keys[i], owner, place);
    else
      fail_at(place, "'" + owner + "' is " + kind_of(*node) + " and has no '" + keys[i] + "'");
    owner += (i > 0 ? "." : "") + keys[i];
  }
  *node = value;
}

}  // namespace vpm
