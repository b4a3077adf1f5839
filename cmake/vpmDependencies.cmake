# What whoever links the library needs: glm for its headers, the others for the linker. Read by the build of vpm itself
# and by find_package(vpm).
include(CMakeFindDependencyMacro)

# vpm_find_silently(NAME ARGUMENT...): find_dependency() of a package whose own files print what looks like a fault and
# is none: Debian's Imath misses a library for Python that nobody asks for, and the module for OpenVDB prints notes of
# its own. Warnings and errors still show.
macro(vpm_find_silently name)
  set(vpm_log_level "${CMAKE_MESSAGE_LOG_LEVEL}")
  set(CMAKE_MESSAGE_LOG_LEVEL WARNING)
  find_package(${name} ${ARGN} QUIET)
  set(CMAKE_MESSAGE_LOG_LEVEL ${vpm_log_level})
  if(NOT ${name}_FOUND)
    find_dependency(${name} ${ARGN})
  endif()
endmacro()

find_dependency(glm CONFIG)
find_dependency(TBB CONFIG)
# Embree 4 or 3; for find_package(vpm) the one that it was built with, as their calls differ under the same names.
if(vpm_embree_major)
  find_dependency(embree ${vpm_embree_major} CONFIG)
else()
  find_package(embree 4 CONFIG QUIET)
  if(NOT embree_FOUND)
    find_dependency(embree 3.13 CONFIG)
  endif()
endif()
vpm_find_silently(OpenEXR 3.1 CONFIG)
find_dependency(PNG)
find_dependency(fmt 9 CONFIG)

# OpenVDB ships a find module only, in a folder that also shadows the good FindTBB: it is on the path for this one call,
# and after TBB, whose targets it would otherwise make by halves.
list(APPEND CMAKE_MODULE_PATH "/usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/OpenVDB")
# It looks for Boost, by Boost's own package: CMake's module for it is going, and warns of that since 3.30.
set(CMAKE_POLICY_DEFAULT_CMP0167 NEW)
vpm_find_silently(OpenVDB 10 MODULE COMPONENTS openvdb)
unset(CMAKE_POLICY_DEFAULT_CMP0167)
list(POP_BACK CMAKE_MODULE_PATH)
