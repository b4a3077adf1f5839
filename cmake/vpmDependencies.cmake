# What whoever links the library needs: glm for its headers, the others for the linker. Read by the build of vpm itself
# and by find_package(vpm).
include(CMakeFindDependencyMacro)
find_dependency(glm CONFIG)
find_dependency(TBB CONFIG)
find_dependency(embree 3.13 CONFIG)
find_dependency(OpenEXR 3.1 CONFIG)
find_dependency(PNG)
find_dependency(fmt 9 CONFIG)

# OpenVDB ships a find module only, in a folder that also shadows the good FindTBB: it is on the path for this one call,
# and after TBB, whose targets it would otherwise make by halves.
list(APPEND CMAKE_MODULE_PATH "/usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/OpenVDB")
find_dependency(OpenVDB 10 MODULE COMPONENTS openvdb)
list(POP_BACK CMAKE_MODULE_PATH)
