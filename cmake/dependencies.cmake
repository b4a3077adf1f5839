# The libraries vpm stands on, all packages of Debian 12; tools/setup installs them.

find_package(TBB CONFIG REQUIRED)
find_package(embree 3.13 CONFIG REQUIRED)
find_package(OpenEXR 3.1 CONFIG REQUIRED)
find_package(PNG REQUIRED)
find_package(fmt 9 CONFIG REQUIRED)
find_package(nlohmann_json 3.11 CONFIG REQUIRED)
find_package(glm CONFIG REQUIRED)
find_package(tomlplusplus CONFIG REQUIRED)  # only its headers: input/toml_reader.cpp says why
find_package(CLI11 CONFIG REQUIRED)
find_package(Eigen3 3.4 CONFIG REQUIRED)

# OpenVDB ships a find module only, in a folder that also shadows the good FindTBB: it is on the path for this one call, and after
# TBB, whose targets it would otherwise make by halves.
list(APPEND CMAKE_MODULE_PATH "/usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/OpenVDB")
find_package(OpenVDB 10 MODULE REQUIRED COMPONENTS openvdb)
list(POP_BACK CMAKE_MODULE_PATH)

# Chart.js draws the plots of the page that `vpm compare` writes, which has the library in it.
find_file(VPM_CHART_JS chart.min.js PATHS /usr/share/javascript/chart.js DOC "Chart.js 3, minified" NO_DEFAULT_PATH)
if(NOT EXISTS "${VPM_CHART_JS}")
  message(FATAL_ERROR "Chart.js is missing. tools/setup installs it (libjs-chart.js); elsewhere -D VPM_CHART_JS=.../chart.min.js names it.")
endif()
file(READ "${VPM_CHART_JS}" chart_head LIMIT 200)
if(NOT chart_head MATCHES "Chart[.]js v3[.]")
  message(FATAL_ERROR "${VPM_CHART_JS} is not Chart.js 3, or has lost its notice")
endif()
