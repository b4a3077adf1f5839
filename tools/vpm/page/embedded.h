// The pages before anything is in them, which cmake/page.cmake writes: a page.html with the files that it names. And
// data in pages: JSON in the places that a template has for it, pictures as text.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "json.h"
#include "vpm/image/image.h"

namespace vpm::tools {

/// HTML, with @results@, @about@ and @pictures@, in this order, where JSON belongs.
std::string_view compare_template();

/// HTML, with @measurement@ where JSON belongs.
std::string_view measure_template();

/// HTML, with @report@ and @pictures@, in this order, where JSON belongs.
std::string_view report_template();

/// Bytes as text.
std::string base64(const std::vector<uint8_t>& bytes);

/// A picture as half floats, 8 bytes of text to a pixel: what to_half() makes of it, its halves with the lower byte
/// first and as base64.
Json picture_json(const Image& image);

/// The page up to a place, which must be there, and JSON instead of that; what is returned, and the place, are taken
/// off `rest`.
std::string up_to(std::string_view& rest, std::string_view place, const std::string& json);

}  // namespace vpm::tools
