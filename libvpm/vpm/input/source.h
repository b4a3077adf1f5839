// Where a piece of a scene file stands, and how an error about it is written.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace vpm {

/// A scene file, or one --set option.
struct Source {
  std::string name;                // the file's path, or "--set key.path=value"
  std::vector<std::string> lines;  // empty for an option
};

/// A position in a source; line and column count from 1 (columns in characters).
struct Place {
  const Source* source = nullptr;
  uint32_t line = 1;
  uint32_t column = 1;
};

/// "file:line:column", or the name of an option.
std::string text_of(const Place& place);

/// Throws InputError: "file:line:column: <wrong>", the offending line with a caret under the column, then `right`: what
/// would be right. For an option: "--set key.path=value: <wrong>" and `right`.
[[noreturn]] void fail_at(const Place& place, const std::string& wrong, const std::string& right = "");

/// "did you mean 'radius'? <title>: centre, radius, ..."; the question only where a candidate is near to `name`.
std::string suggest(const std::string& name, std::span<const std::string> candidates, const std::string& title);

/// The candidate that `name` probably means (few edits away), or "".
std::string nearest_name(const std::string& name, std::span<const std::string> candidates);

/// The end of a file's name, by which its kind is known, in small letters: ".ply".
std::string lower_extension(const std::string& path);

/// Reads a whole file. Throws InputError where it cannot: no such file, a folder, no permission.
std::string read_whole_file(const std::string& path);

}  // namespace vpm
