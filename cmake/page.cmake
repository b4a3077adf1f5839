# Writes a function that returns a page: an HTML file with the files in it that it names as @name.css@, @name.js@ and
# @name.html@. These are FILES.
# cmake -D PAGE=page.html -D "FILES=a.js;..." -D FUNCTION= -D OUTPUT=page.cpp -P page.cmake
file(READ "${PAGE}" page)
foreach(path IN LISTS FILES)
  get_filename_component(name "${path}" NAME)
  file(READ "${path}" text)
  string(FIND "${page}" "@${name}@" place)
  if(place EQUAL -1)
    message(FATAL_ERROR "${PAGE} has no place for ${name}")
  endif()
  string(REPLACE "@${name}@" "${text}" page "${page}")
endforeach()
if(page MATCHES "@[a-z_.]+[.](css|html|js)@")
  message(FATAL_ERROR "${PAGE} names ${CMAKE_MATCH_0}, which is not listed")
endif()
set(delimiter "vpm_page")
if(page MATCHES "[)]${delimiter}\"")
  message(FATAL_ERROR "the page has the end of the string in it that it becomes")
endif()
file(WRITE "${OUTPUT}" "// ${PAGE} and what it names. Written by cmake/page.cmake.
#include \"page/embedded.h\"

namespace vpm::tools {

std::string_view ${FUNCTION}() {
  return R\"${delimiter}(${page})${delimiter}\";
}

}  // namespace vpm::tools
")
