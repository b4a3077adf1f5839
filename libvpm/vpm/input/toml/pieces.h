// A TOML file taken apart, so that some of it can be written anew and the rest stays as it is.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "vpm/input/node.h"

namespace vpm {

/// The lines of a file, which may end as those of Windows do, and begin with a byte order mark.
struct Lines {
  std::vector<std::string> lines{};
  std::string mark{}, end = "\n";

  explicit Lines(std::string_view text);
  /// A text of lines that end in "\n", as the file has them.
  std::string as_written(const std::string& text) const;
};

/// A piece of a file: a header, a statement, an empty line or the end, with its comments: those above it; and right
/// below a statement those that end at an empty line, or are statements put out of action.
struct TomlPiece {
  enum class Kind { header, statement, empty, end } kind = Kind::empty;
  uint32_t line = 0;  // of its text, from 1
  std::vector<std::string> comments{}, below{};
  std::string text{};         // all lines, without the last line feed
  std::string table{};        // the header's, or the one that a statement stands in
  std::string written_key{};  // of a statement
  std::string key{};          // the same without quotes and blanks
  Node value{};

  bool says(const std::string& word) const {
    const auto* const said = std::get_if<std::string>(&value.value);
    return said && *said == word;
  }
};

/// The pieces of a file that is TOML; `name` is what errors call it.
std::vector<TomlPiece> pieces_of(const std::string& name, const std::vector<std::string>& lines);

/// Without blanks around it.
std::string trimmed(const std::string& text);
/// The comment behind a header or a text; "" where there is none.
std::string comment_behind(const std::string& text);

}  // namespace vpm
