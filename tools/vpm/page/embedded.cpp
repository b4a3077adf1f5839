// Half floats as base64, and '<' as an escape.
#include "page/embedded.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <vector>

#include "vpm/image/half_pixels.h"

namespace vpm::tools {
namespace {

/// JSON that ends no element of HTML: it has '<' in texts only, where an escape stands for it as well.
std::string inside_html(const std::string& json) {
  std::string safe;
  safe.reserve(json.size());
  for (const char c : json) c == '<' ? safe += "\\u003c" : safe += c;
  return safe;
}

}  // namespace

// [Josefsson2006, sec. 4]
std::string base64(const std::vector<uint8_t>& bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (size_t i = 0; i < bytes.size(); i += 3) {
    const size_t count = std::min<size_t>(3, bytes.size() - i);
    uint32_t group = 0;
    for (size_t k = 0; k < 3; ++k) group = group << 8 | (k < count ? bytes[i + k] : 0u);
    for (size_t k = 0; k < 4; ++k) text += k <= count ? kDigits[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

Json picture_json(const Image& image) {
  const HalfPixels pixels = to_half(image);
  std::vector<uint8_t> bytes;
  bytes.reserve(2 * pixels.bits.size());
  for (const uint16_t half : pixels.bits) {
    bytes.push_back(static_cast<uint8_t>(half & 255));
    bytes.push_back(static_cast<uint8_t>(half >> 8));
  }
  return {{"exponent", pixels.exponent}, {"halves", base64(bytes)}};
}

std::string up_to(std::string_view& rest, std::string_view place, const std::string& json) {
  const size_t at = rest.find(place);
  assert(at != std::string_view::npos);
  const std::string_view before = rest.substr(0, at);
  rest.remove_prefix(at + place.size());
  return std::string(before) + inside_html(json);
}

}  // namespace vpm::tools
