# The libraries vpm stands on, all packages of Debian; tools/setup installs them.

# Those that the library is linked with. Their list is written for find_package(vpm), and read here in its name.
set(CMAKE_FIND_PACKAGE_NAME vpm)
set(vpm_FIND_REQUIRED ON)
include(${CMAKE_CURRENT_LIST_DIR}/vpmDependencies.cmake)
unset(CMAKE_FIND_PACKAGE_NAME)
unset(vpm_FIND_REQUIRED)

if(POLICY CMP0167)
  cmake_policy(SET CMP0167 NEW)  # by its own package, as in vpmDependencies.cmake
endif()
find_package(Boost 1.74 REQUIRED)  # only headers, those of Boost.Math
find_package(nlohmann_json 3.11 CONFIG REQUIRED)  # only its headers
find_package(tomlplusplus CONFIG REQUIRED)  # only its headers: input/toml/toml_reader.cpp says why
if(NOT PROJECT_IS_TOP_LEVEL)
  return()
endif()

find_package(CLI11 CONFIG REQUIRED)
if(VPM_MPI)
  find_package(MPI REQUIRED COMPONENTS CXX)
endif()
find_package(Eigen3 CONFIG REQUIRED)  # 3.4 or 5: who asks for 3.4 is refused 5
if(Eigen3_VERSION VERSION_LESS 3.4)
  message(FATAL_ERROR "Eigen ${Eigen3_VERSION} is older than 3.4")
endif()

# Chart.js draws the plots of the page that `vpm compare` writes, which has the library in it.
find_file(VPM_CHART_JS chart.min.js PATHS /usr/share/javascript/chart.js DOC "Chart.js 3, minified" NO_DEFAULT_PATH)
if(NOT EXISTS "${VPM_CHART_JS}")
  message(FATAL_ERROR "Chart.js is missing. tools/setup installs it (libjs-chart.js); elsewhere -D VPM_CHART_JS=.../chart.min.js names it.")
endif()
file(READ "${VPM_CHART_JS}" chart_head LIMIT 200)
if(NOT chart_head MATCHES "Chart[.]js v3[.]")
  message(FATAL_ERROR "${VPM_CHART_JS} is not Chart.js 3, or has lost its notice")
endif()
