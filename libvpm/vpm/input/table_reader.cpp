// The checks behind every value of a scene file.
#include "vpm/input/table_reader.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "vpm/base/settings/setting.h"

namespace vpm {
namespace {

/// A number of the file, checked as it is and in the single precision it is going to be kept in.
double checked_number(const Node& node, const std::string& what, const Range& range) {
  double value = 0.0;
  if (const auto* integer = std::get_if<int64_t>(&node.value))
    value = static_cast<double>(*integer);
  else if (const auto* number = std::get_if<double>(&node.value))
    value = *number;
  else
    fail_at(node.place, what + " must be a number, not " + kind_of(node), "it must be " + text_of(range));
  if (!std::isfinite(value)) fail_at(node.place, what + " must be finite, not " + text_of(value));
  if (!std::isfinite(static_cast<float>(value)))
    fail_at(node.place, what + " is too large for single precision: " + text_of(value));
  if (!contains(range, value)) fail_at(node.place, what + " must be " + text_of(range) + ", not " + text_of(value));
  return value;
}

std::string quoted(const std::string& key, const std::string& title) { return "'" + key + "' of " + title; }

std::vector<double> checked_numbers(const Node& node, const std::string& key, const std::string& title, size_t count,
                                    const Range& range) {
  const std::string what = quoted(key, title);
  const std::string wanted = std::to_string(count) + " numbers";
  const Node::Array* array = node.array();
  if (!array) fail_at(node.place, what + " must be an array of " + wanted + ", not " + kind_of(node));
  if (array->size() != count)
    fail_at(node.place, what + " must have " + wanted + ", not " + std::to_string(array->size()));
  std::vector<double> values;
  for (size_t i = 0; i < count; ++i)
    values.push_back(checked_number((*array)[i], quoted(key + "[" + std::to_string(i) + "]", title), range));
  return values;
}

}  // namespace

TableReader::TableReader(const Node& node, std::string title, std::vector<std::string>& files)
    : node_(&node), title_(std::move(title)), files_(&files) {
  if (!node.table()) fail_at(node.place, title_ + " must be a table, not " + kind_of(node));
}

const Node* TableReader::find(const std::string& key) {
  if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.push_back(key);
  const Entry* entry = find_entry(*node_->table(), key);
  return entry ? &entry->node : nullptr;
}

bool TableReader::has(const std::string& key) { return find(key) != nullptr; }

const Node& TableReader::require(const std::string& key) {
  if (const Node* node = find(key)) return *node;
  const std::vector<std::string> missing{key};
  for (const Entry& entry : *node_->table()) {
    const bool asked = std::find(known_.begin(), known_.end(), entry.key) != known_.end();
    if (!asked && !nearest_name(entry.key, missing).empty()) refuse_unknown(entry);
  }
  fail_here(title_ + " lacks the key '" + key + "'", "add: " + key + " = ...");
}

float TableReader::number(const std::string& key, const Range& range, std::optional<float> fallback) {
  if (!find(key) && fallback) return *fallback;
  return static_cast<float>(checked_number(require(key), quoted(key, title_), range));
}

bool TableReader::says_auto(const std::string& key) {
  const Node* node = find(key);
  const std::string* word = node ? std::get_if<std::string>(&node->value) : nullptr;
  if (word && *word != kAuto) refuse_word(key, *node, {"a number", kAuto});
  return word != nullptr;
}

bool TableReader::says(const std::string& key, const std::string& text) {
  const Node* node = find(key);
  const std::string* word = node ? std::get_if<std::string>(&node->value) : nullptr;
  return word && *word == text;
}

namespace {

/// A whole number, also one that is written as 1e6 is.
std::optional<int64_t> whole_number(const Node& node) {
  if (const auto* integer = std::get_if<int64_t>(&node.value)) return *integer;
  constexpr double kExact = 9007199254740992.0;  // 2^53, up to which doubles hold all whole numbers
  const auto* number = std::get_if<double>(&node.value);
  if (!number || !(std::abs(*number) <= kExact) || *number != std::floor(*number)) return std::nullopt;
  return static_cast<int64_t>(*number);
}

}  // namespace

uint64_t TableReader::integer(const std::string& key, uint64_t lo, uint64_t hi, std::optional<uint64_t> fallback) {
  if (!find(key) && fallback) return *fallback;
  const Node& node = require(key);
  const std::string allowed = "from " + std::to_string(lo) + " to " + std::to_string(hi);
  std::optional<int64_t> value = whole_number(node);
  if (!value) {
    const auto* text = std::get_if<std::string>(&node.value);  // that of an option may be an integer, but too large
    fail_at(node.place, quoted(key, title_) + " must be an integer, not " + (text ? "'" + *text + "'" : kind_of(node)),
            "it must be " + allowed);
  }
  if (*value < 0 || static_cast<uint64_t>(*value) < lo || static_cast<uint64_t>(*value) > hi)
    fail_at(node.place, quoted(key, title_) + " must be " + allowed + ", not " + std::to_string(*value));
  return static_cast<uint64_t>(*value);
}

bool TableReader::flag(const std::string& key, bool fallback) {
  const Node* node = find(key);
  if (!node) return fallback;
  const bool* value = std::get_if<bool>(&node->value);
  if (!value) fail_at(node->place, quoted(key, title_) + " must be true or false, not " + kind_of(*node));
  return *value;
}

std::string TableReader::string(const std::string& key, std::optional<std::string> fallback) {
  if (!find(key) && fallback) return *fallback;
  const Node& node = require(key);
  const auto* value = std::get_if<std::string>(&node.value);
  if (!value)
    fail_at(node.place, quoted(key, title_) + " must be a string, not " + kind_of(node), "write it in quotes");
  if (value->empty()) fail_at(node.place, quoted(key, title_) + " is empty");
  return *value;
}

std::string TableReader::path(const std::string& key) {
  const std::filesystem::path named = string(key);
  const Source& source = *place_of(key).source;
  const bool from_option = source.lines.empty();
  const std::filesystem::path folder = from_option ? "" : std::filesystem::path(source.name).parent_path();
  std::string found = (folder / named).string();
  std::error_code ignored;
  if (!std::filesystem::exists(found, ignored)) fail(key, "there is no file '" + found + "'");
  if (std::find(files_->begin(), files_->end(), found) == files_->end()) files_->push_back(found);
  return found;
}

std::vector<double> TableReader::numbers(const std::string& key, size_t count, const Range& range) {
  return checked_numbers(require(key), key, title_, count, range);
}

Vec3 TableReader::vector(const std::string& key, std::optional<Vec3> fallback) {
  if (!find(key) && fallback) return *fallback;
  const std::vector<double> v = numbers(key, 3);
  return Vec3(v[0], v[1], v[2]);
}

Vec3 TableReader::direction(const std::string& key, std::optional<Vec3> fallback) {
  if (!find(key) && fallback) return *fallback;
  const std::vector<double> v = numbers(key, 3);
  const Vec3d d(v[0], v[1], v[2]);
  if (glm::length(d) == 0.0) fail(key, quoted(key, title_) + " must not be the zero vector");
  return Vec3(glm::normalize(d));
}

Rgb TableReader::rgb(const std::string& key, const Range& range, std::optional<Rgb> fallback) {
  if (!find(key) && fallback) return *fallback;
  const Node& node = require(key);
  if (!node.array()) {
    if (std::holds_alternative<int64_t>(node.value) || std::holds_alternative<double>(node.value))
      return Rgb(number(key, range));
    fail_at(node.place, quoted(key, title_) + " must be a number or [red, green, blue], not " + kind_of(node));
  }
  const std::vector<double> v = checked_numbers(node, key, title_, 3, range);
  return Rgb(v[0], v[1], v[2]);
}

std::vector<std::string> TableReader::words(const std::string& key, const std::vector<std::string>& allowed) {
  const Node& node = require(key);
  std::vector<Node> elements;
  if (const auto* joined = std::get_if<std::string>(&node.value))
    for (std::string& word : words_in(*joined)) elements.push_back({node.place, std::move(word)});
  else if (node.array())
    elements = *node.array();
  if (elements.empty())
    fail(key, quoted(key, title_) + " must be an array of words, not " + (node.array() ? "empty" : kind_of(node)),
         suggest("", allowed, "it can hold"));
  std::vector<std::string> found;
  for (const Node& element : elements) {
    const auto* word = std::get_if<std::string>(&element.value);
    if (!word || std::find(allowed.begin(), allowed.end(), *word) == allowed.end())
      fail_at(element.place, quoted(key, title_) + " cannot hold " + (word ? "'" + *word + "'" : kind_of(element)),
              suggest(word ? *word : "", allowed, "it can hold"));
    if (std::find(found.begin(), found.end(), *word) != found.end())
      fail_at(element.place, quoted(key, title_) + " holds '" + *word + "' twice");
    found.push_back(*word);
  }
  return found;
}

std::optional<TableReader> TableReader::table(const std::string& key, const std::string& title) {
  const Node* node = find(key);
  return node ? std::optional<TableReader>(TableReader(*node, title, *files_)) : std::nullopt;
}

std::vector<std::pair<std::string, TableReader>> TableReader::named_tables(const std::string& title) {
  std::vector<std::pair<std::string, TableReader>> all;
  for (const Entry& entry : *node_->table())
    all.emplace_back(entry.key, TableReader(entry.node, "[" + title + "." + entry.key + "]", *files_));
  return all;
}

std::vector<TableReader> TableReader::tables(const std::string& key, const std::string& title) {
  std::vector<TableReader> all;
  const Node* node = find(key);
  if (!node) return all;
  if (!node->array())
    fail_at(node->place, "'" + key + "' must be an array of tables, not " + kind_of(*node), "write [[" + key + "]]");
  for (const Node& element : *node->array()) {
    const Entry* name = element.table() ? find_entry(*element.table(), "name") : nullptr;
    const auto* text = name ? std::get_if<std::string>(&name->node.value) : nullptr;
    all.emplace_back(element, title + (text ? " '" + *text + "'" : " number " + std::to_string(all.size())), *files_);
  }
  return all;
}

void TableReader::finish(const std::function<std::string(const std::string&)>& hint) const {
  for (const Entry* entry : unknown()) refuse_unknown(*entry, hint ? hint(entry->key) : "");
}

std::vector<const Entry*> TableReader::unknown() const {
  std::vector<const Entry*> entries;
  for (const Entry& entry : *node_->table())
    if (std::find(known_.begin(), known_.end(), entry.key) == known_.end()) entries.push_back(&entry);
  return entries;
}

void TableReader::refuse_unknown(const Entry& entry, const std::string& hint) const {
  // An option may have given the key of a file another value.
  const Place& place = entry.node.place.source == entry.place.source ? entry.place : entry.node.place;
  fail_at(place, "unknown key '" + entry.key + "' in " + title_, hint + suggest(entry.key, known_, "known keys"));
}

void TableReader::refuse_word(const std::string& key, const Node& node, const std::vector<std::string>& words) const {
  const auto* word = std::get_if<std::string>(&node.value);
  fail(key, quoted(key, title_) + " cannot be " + (word ? "'" + *word + "'" : kind_of(node)),
       suggest(word ? *word : "", words, "it can be"));
}

std::vector<std::string> TableReader::keys() const {
  std::vector<std::string> keys;
  for (const Entry& entry : *node_->table()) keys.push_back(entry.key);
  return keys;
}

const Place& TableReader::place_of(const std::string& key) const {
  const Entry* entry = find_entry(*node_->table(), key);
  return entry ? entry->node.place : node_->place;
}

void TableReader::fail(const std::string& key, const std::string& wrong, const std::string& right) const {
  fail_at(place_of(key), wrong, right);
}

void TableReader::fail_here(const std::string& wrong, const std::string& right) const {
  fail_at(node_->place, wrong, right);
}

}  // namespace vpm
