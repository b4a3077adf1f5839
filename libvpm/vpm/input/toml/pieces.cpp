// Lines are added to a statement until it is TOML.
#include "vpm/input/toml/pieces.h"

#include <algorithm>
#include <utility>

#include "vpm/base/error.h"

namespace vpm {
namespace {

constexpr std::string_view kMarkOfUtf8 = "\xef\xbb\xbf";

/// "volume.radius" of `volume . "radius"`.
std::string plain_key(const std::string& written) {
  std::string key;
  for (size_t begin = 0; begin <= written.size();) {
    const size_t end = std::min(written.find('.', begin), written.size());
    std::string part = trimmed(written.substr(begin, end - begin));
    if (part.size() > 1 && (part.front() == '"' || part.front() == '\'')) part = part.substr(1, part.size() - 2);
    key += (key.empty() ? "" : ".") + part;
    begin = end + 1;
  }
  return key;
}

const Node* find_node(const Node& root, const std::string& path) {
  const Node* node = &root;
  for (size_t begin = 0; begin <= path.size() && node;) {
    const size_t end = std::min(path.find('.', begin), path.size());
    const Entry* const entry = node->table() ? find_entry(*node->table(), path.substr(begin, end - begin)) : nullptr;
    node = entry ? &entry->node : nullptr;
    begin = end + 1;
  }
  return node;
}

/// Adds lines to a statement until it is whole.
TomlPiece statement_of(const std::string& name, const std::vector<std::string>& lines, size_t& i) {
  TomlPiece piece{.kind = TomlPiece::Kind::statement, .text = lines[i]};
  piece.written_key = trimmed(lines[i].substr(0, lines[i].find('=')));
  piece.key = plain_key(piece.written_key);
  for (;;) try {
      const Document document = parse_toml(name, piece.text);
      if (const Node* const value = find_node(document.root, piece.key)) piece.value = *value;
      piece.value.place = {};
      return piece;
    } catch (const InputError&) {
      if (i + 1 == lines.size()) throw;
      piece.text += "\n" + lines[++i];
    }
}

/// Its comment becomes one of those above.
TomlPiece header_of(const std::string& line) {
  TomlPiece piece{.kind = TomlPiece::Kind::header, .text = line};
  const size_t begin = line.find_first_not_of("[ \t"), end = line.find(']');
  piece.table = plain_key(line.substr(begin, end - begin));
  return piece;
}

/// Is it a statement that a comment puts out of action: "#flights = 100"?
bool is_put_out(const std::string& comment) {
  const std::string text = trimmed(comment.substr(comment.find('#') + 1));
  const size_t end = text.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_.");
  return end != std::string::npos && end > 0 && trimmed(text.substr(end)).starts_with('=');
}

/// Comments that stand between two pieces: those that belong to the first go to it.
void part_comments(TomlPiece& before, const TomlPiece& behind, std::vector<std::string>& comments) {
  if (before.kind != TomlPiece::Kind::statement) return;
  const auto end = behind.kind == TomlPiece::Kind::empty
                       ? comments.end()
                       : std::find_if_not(comments.begin(), comments.end(), is_put_out);
  before.below.assign(comments.begin(), end);
  comments.erase(comments.begin(), end);
}

}  // namespace

Lines::Lines(std::string_view text) {
  if (text.starts_with(kMarkOfUtf8)) {
    mark = kMarkOfUtf8;
    text.remove_prefix(mark.size());
  }
  if (text.find("\r\n") != std::string_view::npos) end = "\r\n";
  while (!text.empty()) {
    const size_t at = text.find('\n');
    std::string_view line = text.substr(0, at);
    if (line.ends_with('\r')) line.remove_suffix(1);
    lines.emplace_back(line);
    text.remove_prefix(at == std::string_view::npos ? text.size() : at + 1);
  }
}

std::string Lines::as_written(const std::string& text) const {
  std::string written = mark;
  for (const char c : text)
    if (c == '\n')
      written += end;
    else
      written += c;
  return written;
}

std::string trimmed(const std::string& text) {
  const size_t begin = text.find_first_not_of(" \t"), end = text.find_last_not_of(" \t");
  return begin == std::string::npos ? "" : text.substr(begin, end - begin + 1);
}

std::string comment_behind(const std::string& text) {
  char quote = 0;
  for (size_t i = 0; i < text.size(); ++i) {
    if (quote == 0 && text[i] == '#') return text.substr(i);
    if (quote == 0 && (text[i] == '"' || text[i] == '\''))
      quote = text[i];
    else if (text[i] == quote)
      quote = 0;
  }
  return "";
}

std::vector<TomlPiece> pieces_of(const std::string& name, const std::vector<std::string>& lines) {
  std::vector<TomlPiece> pieces;
  std::vector<std::string> comments;
  std::string table;
  for (size_t i = 0; i < lines.size(); ++i) {
    const std::string line = trimmed(lines[i]);
    if (line.starts_with('#')) {
      comments.push_back(lines[i]);
      continue;
    }
    const bool apart = !pieces.empty() && pieces.back().kind == TomlPiece::Kind::empty;
    if (line.empty() && apart && !comments.empty()) {  // a headline, which goes with what follows
      comments.push_back(lines[i]);
      continue;
    }
    const bool header = line.starts_with('[');
    const auto number = static_cast<uint32_t>(i + 1);
    TomlPiece piece = header         ? header_of(lines[i])
                      : line.empty() ? TomlPiece{.kind = TomlPiece::Kind::empty, .text = lines[i]}
                                     : statement_of(name, lines, i);
    if (!pieces.empty()) part_comments(pieces.back(), piece, comments);
    if (header) table = piece.table;
    piece.line = number;
    piece.table = table;
    piece.comments = std::exchange(comments, {});
    pieces.push_back(std::move(piece));
  }
  pieces.push_back({.kind = TomlPiece::Kind::end, .comments = std::move(comments)});
  return pieces;
}

}  // namespace vpm
