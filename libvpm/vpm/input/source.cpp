// Error messages with the offending line and a caret, and guesses at what was meant.
#include "vpm/input/source.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numeric>

#include "vpm/base/error.h"
#include "vpm/base/letters.h"

namespace vpm {
namespace {

/// Number of inserted, removed, replaced or swapped characters between two words.
size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<size_t> before, row(b.size() + 1), next(b.size() + 1);
  std::iota(row.begin(), row.end(), size_t{0});
  for (size_t i = 1; i <= a.size(); ++i) {
    next[0] = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      next[j] = std::min({row[j] + 1, next[j - 1] + 1, row[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) next[j] = std::min(next[j], before[j - 2] + 1);
    }
    before = row;
    row = next;
  }
  return row.back();
}

/// What puts a caret under a character of `line`: tabs stay tabs, and the bytes that continue a UTF-8 character take no
/// room.
std::string indent_to(const std::string& line, uint32_t column) {
  std::string indent;
  uint32_t at = 1;
  for (size_t i = 0; i < line.size() && at < column; ++i) {
    const bool continues = i + 1 < line.size() && (static_cast<unsigned char>(line[i + 1]) & 0xc0u) == 0x80u;
    if (continues) continue;
    indent += line[i] == '\t' ? '\t' : ' ';
    ++at;
  }
  return indent + std::string(column - at, ' ');
}

}  // namespace

std::string text_of(const Place& place) {
  const Source& source = *place.source;
  return source.lines.empty() ? source.name : fmt::format("{}:{}:{}", source.name, place.line, place.column);
}

void fail_at(const Place& place, const std::string& wrong, const std::string& right) {
  const Source& source = *place.source;
  std::string message = text_of(place) + ": " + wrong;
  if (!source.lines.empty()) {
    const std::string line_number = std::to_string(place.line);
    std::string line = place.line <= source.lines.size() ? source.lines[place.line - 1] : "";
    const auto is_control = [](unsigned char c) { return (c < 0x20u && c != '\t') || c == 0x7fu; };
    std::replace_if(line.begin(), line.end(), is_control, '?');  // of files that are no text
    message += "\n  " + line_number + " | " + line + "\n  " + std::string(line_number.size(), ' ') + " | " +
               indent_to(line, place.column) + "^";
  }
  if (!right.empty()) message += "\n" + right;
  throw InputError(message);
}

std::string nearest_name(const std::string& name, std::span<const std::string> candidates) {
  constexpr size_t kLongest = 100;  // the distance takes time by the square of the length
  if (name.size() > kLongest) return "";
  const size_t tolerated = name.size() <= 3 ? 1 : name.size() <= 6 ? 2 : 3;
  std::string best;
  size_t least = tolerated + 1;
  for (const std::string& candidate : candidates) {
    if (candidate.size() > name.size() + tolerated) continue;
    const size_t distance = edit_distance(name, candidate);
    if (distance >= least || distance >= candidate.size()) continue;
    least = distance;
    best = candidate;
  }
  return best;
}

std::string suggest(const std::string& name, std::span<const std::string> candidates, const std::string& title) {
  const std::string guess = nearest_name(name, candidates);
  std::string text = guess.empty() ? "" : "did you mean '" + guess + "'? ";
  text += title + ": ";
  for (size_t i = 0; i < candidates.size(); ++i) text += (i > 0 ? ", " : "") + candidates[i];
  return candidates.empty() ? text + "none" : text;
}

std::string lower_extension(const std::string& path) {
  return small_letters(std::filesystem::path(path).extension().string());
}

std::string read_whole_file(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) throw InputError(path + ": is a folder, not a file");
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(path + ": cannot open: " + std::strerror(errno));
  std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (file.bad()) throw InputError(path + ": cannot read: " + std::strerror(errno));
  return text;
}

}  // namespace vpm
