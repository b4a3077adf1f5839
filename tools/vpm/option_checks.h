// Checks of options, which the command line library's own would let wrap around or be NaN: they return what is wrong
// with a text, or "".
#pragma once

#include <functional>
#include <string>

#include "vpm/film/pass.h"

namespace vpm::tools {

std::string check_seed(const std::string& text);        // of 64 bits
std::string check_seconds(const std::string& text);     // above 0
std::string check_stops(const std::string& text);       // of an exposure
std::string check_error(const std::string& text);       // a relative MSE above 0
std::string check_depth(const std::string& text);       // an optical depth above 0
std::string check_slice(const std::string& text);       // "y" or "y=0.25", of slice_wish()
std::string check_film_size(const std::string& text);   // "640x480", pixels
std::string check_crop(const std::string& text);        // "x0,y0,x1,y1", pixels
std::string check_pass_range(const std::string& text);  // "64:128", numbers of passes
std::string check_rate(const std::string& text);        // a probability between 0 and 1

/// The numbers of a text that check_pass_range() accepts.
PassRange pass_range(const std::string& text);

/// A check that a text is a whole number from `lo` to `hi`.
std::function<std::string(const std::string&)> whole_number(int lo, int hi);

}  // namespace vpm::tools
