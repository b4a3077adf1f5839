// Numbers as programs print them into meshes.
#pragma once

#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "vpm/base/letters.h"

namespace vpm {

/// How C libraries print what is no finite number, as nan, -inf, -nan(ind), 1.#QNAN0 or -1.#IND.
inline bool is_not_finite(std::string_view word) {
  const std::string small = small_letters(std::string(word));
  const size_t start = small.find_first_not_of("+-1.#");
  if (start == std::string::npos) return false;
  for (const char* name : {"nan", "inf", "qnan", "snan", "ind"})
    if (small.compare(start, std::string_view(name).size(), name) == 0) return true;
  return false;
}

/// The number that a word is: 0 for what is too small for T, NaN for all that is not finite. Nothing where it is no
/// number, or too large.
template <class T>
std::optional<T> number_in(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  const char* const end = word.data() + word.size();
  T value{};
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  if (error == std::errc() && stop == end) return std::isfinite(value) ? value : std::numeric_limits<T>::quiet_NaN();
  if (error == std::errc::result_out_of_range && stop == end) {
    long double wide = 1.0L;  // stays where the number is out of its range, too
    std::from_chars(word.data(), end, wide);
    return std::abs(wide) < 1.0L ? std::optional(T{}) : std::nullopt;
  }
  return is_not_finite(word) ? std::optional(std::numeric_limits<T>::quiet_NaN()) : std::nullopt;
}

}  // namespace vpm
