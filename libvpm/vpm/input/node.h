// A TOML document as plain values, each with its place in the file: what the rest of input/ sees of TOML.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "vpm/input/source.h"

namespace vpm {

struct Entry;
/// A TOML date or time: nothing in a scene is one.
struct DateOrTime {};

struct Node {
  using Array = std::vector<Node>;
  using Table = std::vector<Entry>;

  Place place;
  std::variant<std::string, int64_t, double, bool, DateOrTime, Array, Table> value;

  const Array* array() const { return std::get_if<Array>(&value); }
  const Table* table() const { return std::get_if<Table>(&value); }
};

/// A key of a table with its value; they stand in the file's order.
struct Entry {
  std::string key;
  Place place;  // of the key
  Node node;
};

/// The entry of that key; null where there is none.
const Entry* find_entry(const Node::Table& table, const std::string& key);

/// "an integer", "a table", ...: for messages.
std::string kind_of(const Node& node);

/// The value of a node that is no table, as an option writes it; a list's joined by "+".
std::string text_of(const Node& node);

/// An option that gives a setting of the integrator a value.
struct Replacement {
  std::string key;                    // "integrator.volume.type"
  std::optional<std::string> before;  // text_of() what was said before, if anything was
  std::string after;                  // likewise of the option
  const Source* option;
};

/// A scene file with the --set options applied. Nodes point into `sources`.
struct Document {
  std::vector<std::unique_ptr<Source>> sources;  // the file first
  std::string text;                              // of the file
  Node root;
  std::vector<Replacement> replaced{};
};

/// Throws InputError for text that toml++ should not get: a key of more than 32 parts, letters that only strings may
/// hold.
void check_toml(const std::string& text, const Source* source);

/// Parses a TOML file. Throws InputError with file:line:column where it is not TOML.
Document read_toml(const std::string& path);
/// The same of a text; `name` is what errors call it.
Document parse_toml(const std::string& name, std::string text);

/// A TOML value as written after "key ="; null if the text is not one.
std::unique_ptr<Node> parse_toml_value(const std::string& text, const Source* source);

/// Applies `key.path=value`: the value is read as a TOML value, or taken as a string where it is none. An element of an
/// array of tables is addressed by its number (from 0) or its name. Only the last key and sections of the file (the
/// path's first key, all of the integrator, and in experiments all from "set" on) may be new. Errors start with "--set
/// key.path=value:".
void apply_override(Document& document, const std::string& option);

}  // namespace vpm
