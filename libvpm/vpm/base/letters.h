// Words without regard to capitals.
#pragma once

#include <algorithm>
#include <cctype>
#include <string>

namespace vpm {

/// The text in small letters; only those of ASCII change.
inline std::string small_letters(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(c < 0x80 ? std::tolower(c) : c); });
  return text;
}

}  // namespace vpm
