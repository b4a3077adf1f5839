// The pages before anything is in them: a page.html with the files that it names. What is here is written by
// cmake/page.cmake.
#pragma once

#include <string_view>

namespace vpm::tools {

/// HTML, with @results@, @about@ and @pictures@, in this order, where JSON belongs.
std::string_view compare_template();

/// HTML, with @report@ and @pictures@, in this order, where JSON belongs.
std::string_view report_template();

}  // namespace vpm::tools
