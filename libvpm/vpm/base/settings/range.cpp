// Ends of ranges in double and in single precision.
#include "vpm/base/settings/range.h"

#include <cstdio>

namespace vpm {
namespace {

bool inside(const Range& range, double value) {
  return (range.lo_open ? value > range.lo : value >= range.lo) &&
         (range.hi_open ? value < range.hi : value <= range.hi);
}

}  // namespace

bool contains(const Range& range, float value) {
  return inside({static_cast<float>(range.lo), static_cast<float>(range.hi), range.lo_open, range.hi_open}, value);
}

bool contains(const Range& range, double value) {
  return inside(range, value) && contains(range, static_cast<float>(value));
}

std::string text_of(const Range& range) {
  if (range.lo == -kNoLimit && range.hi == kNoLimit) return "finite";
  if (range.hi == kNoLimit) return (range.lo_open ? "> " : ">= ") + text_of(range.lo);
  return std::string("in ") + (range.lo_open ? "(" : "[") + text_of(range.lo) + ", " + text_of(range.hi) +
         (range.hi_open ? ")" : "]");
}

std::string text_of(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.9g", value);
  return buffer;
}

}  // namespace vpm
