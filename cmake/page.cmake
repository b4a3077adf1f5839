# Writes page_template.cpp: page.html of a folder, with the files of that folder that it names, and Chart.js, in it.
# cmake -D FOLDER= -D CHART= -D OUTPUT= -P page.cmake
file(READ "${FOLDER}/page.html" page)
string(REGEX MATCHALL "@[a-z_]+[.](css|js)@" places "${page}")
foreach(place IN LISTS places)
  string(REPLACE "@" "" name "${place}")
  if(name STREQUAL "chart.js")
    file(READ "${CHART}" text)
  else()
    file(READ "${FOLDER}/${name}" text)
  endif()
  string(REPLACE "${place}" "${text}" page "${page}")
endforeach()
set(delimiter "vpm_page")
if(page MATCHES "[)]${delimiter}\"")
  message(FATAL_ERROR "the page has the end of the string in it that it becomes")
endif()
file(WRITE "${OUTPUT}" "// ${FOLDER} and Chart.js. Written by cmake/page.cmake.
#include \"compare/page_template.h\"

namespace vpm::tools {

std::string_view page_template() {
  return R\"${delimiter}(${page})${delimiter}\";
}

}  // namespace vpm::tools
")
