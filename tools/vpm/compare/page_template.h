// The report's page before anything is reported: page/page.html with the style, scripts and plotting library it names.
// What is here is written by cmake/page.cmake.
#pragma once

#include <string_view>

namespace vpm::tools {

/// HTML, with @results@, @about@ and @pictures@, in this order, where JSON belongs.
std::string_view page_template();

}  // namespace vpm::tools
