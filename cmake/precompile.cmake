# Headers that most files include, compiled once for a target: vpm_precompile(TARGET [HEADER...]). Half the time that a
# small file takes to compile is that of these. The dev preset does without, so that files which forget an include are
# found.
function(vpm_precompile target)
  if(NOT PROJECT_IS_TOP_LEVEL)
    return()
  endif()
  target_precompile_headers(${target} PRIVATE
    <algorithm> <array> <atomic> <cmath> <filesystem> <functional> <map> <memory> <numeric> <optional> <span> <sstream>
    <string> <variant> <vector> <fmt/format.h> <vpm/base/vec.h> ${ARGN})
  if(CMAKE_CXX_COMPILER_LAUNCHER)
    target_compile_options(${target} PRIVATE -fpch-preprocess)  # ccache wants it
  endif()
endfunction()
