// Texts line by line.
#pragma once

#include <string_view>

namespace vpm {

/// The next line, taken off the front without its line feed; false where it has no end.
inline bool take_line(std::string_view& text, std::string_view& line) {
  const size_t end = text.find('\n');
  if (end == std::string_view::npos) return false;
  line = text.substr(0, end);
  text.remove_prefix(end + 1);
  return true;
}

}  // namespace vpm
