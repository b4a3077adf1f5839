// Whole texts as numbers, and their ranges.
#include "option_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <sstream>
#include <vector>

#include "slice_picture.h"

namespace vpm::tools {
namespace {

constexpr float kMostStops = 100.0f;  // of an exposure: its gain and what it multiplies stay finite

/// The whole of the text as a number, or `otherwise`.
template <class Number>
Number parse(const std::string& text, Number otherwise) {
  Number value{};
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && stop == end ? value : otherwise;
}

/// The whole numbers that such a separator parts, or -1 for one that is none.
std::vector<int> numbers_in(const std::string& text, char separator) {
  std::vector<int> numbers;
  std::istringstream parts(text + separator);  // also of what is missing behind a last separator
  for (std::string part; std::getline(parts, part, separator);) numbers.push_back(parse(part, -1));
  return numbers;
}

}  // namespace

std::string check_seed(const std::string& text) {
  if (parse<uint64_t>(text, 0) == parse<uint64_t>(text, 1)) return "";
  return fmt::format("{} is not a whole number from 0 to {}", text, std::numeric_limits<uint64_t>::max());
}

std::string check_seconds(const std::string& text) {
  const double seconds = parse(text, 0.0);
  return seconds > 0.0 && std::isfinite(seconds) ? "" : fmt::format("{} is not a number of seconds above 0", text);
}

std::string check_stops(const std::string& text) {
  const float stops = parse(text, std::numeric_limits<float>::infinity());
  return std::abs(stops) <= kMostStops ? ""
                                       : fmt::format("{} is no number from -{} to {}", text, kMostStops, kMostStops);
}

std::string check_error(const std::string& text) {
  const double error = parse(text, 0.0);
  return error > 0.0 && std::isfinite(error) ? "" : fmt::format("{} is not a relative MSE above 0", text);
}

std::string check_depth(const std::string& text) {
  const double depth = parse(text, 0.0);
  return depth > 0.0 && std::isfinite(depth) ? "" : fmt::format("{} is not an optical depth above 0", text);
}

std::string check_slice(const std::string& text) {
  try {
    slice_wish(text);
    return "";
  } catch (const std::exception&) {
    return fmt::format("{} is no slice: an axis, x, y or z, or one with a place in m, such as y=0.25", text);
  }
}

std::string check_film_size(const std::string& text) {
  const std::vector<int> sides = numbers_in(text, 'x');
  const bool right = sides.size() == 2 && std::min(sides[0], sides[1]) >= 1;
  return right ? "" : fmt::format("{} is no size in pixels such as 640x480", text);
}

std::string check_crop(const std::string& text) {
  const std::vector<int> ends = numbers_in(text, ',');
  const bool right = ends.size() == 4 && *std::min_element(ends.begin(), ends.end()) >= 0;
  return right ? "" : fmt::format("{} is no part of a picture such as 0,0,64,48", text);
}

PassRange pass_range(const std::string& text) {
  const std::vector<int> ends = numbers_in(text, ':');
  return ends.size() == 2 ? PassRange{ends[0], ends[1]} : PassRange{};
}

std::string check_pass_range(const std::string& text) {
  const PassRange range = pass_range(text);
  return 0 <= range.first && range.first < range.end
             ? ""
             : fmt::format("{} is no range of passes such as 0:64, which ends with pass 63", text);
}

std::string check_rate(const std::string& text) {
  const double rate = parse(text, 0.0);
  return rate > 0.0 && rate < 1.0 ? "" : fmt::format("{} is not a probability between 0 and 1", text);
}

std::function<std::string(const std::string&)> whole_number(int lo, int hi) {
  return [lo, hi](const std::string& text) {
    const int number = parse(text, std::numeric_limits<int>::min());
    return number >= lo && number <= hi ? "" : fmt::format("{} is not a whole number from {} to {}", text, lo, hi);
  };
}

}  // namespace vpm::tools
