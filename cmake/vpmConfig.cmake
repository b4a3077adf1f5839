# find_package(vpm CONFIG): the target vpm::vpm, with all that it is linked with.
cmake_minimum_required(VERSION 3.23)  # knows file sets, which tell where the headers are
include(${CMAKE_CURRENT_LIST_DIR}/vpmDependencies.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/vpmTargets.cmake)
