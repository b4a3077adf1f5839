# What `cmake --install` installs: the binary, the library with its public headers, and the package that
# find_package(vpm) reads.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/vpm)

install(TARGETS vpm RUNTIME)
install(TARGETS vpm_lib EXPORT vpmTargets ARCHIVE FILE_SET HEADERS)
install(EXPORT vpmTargets NAMESPACE vpm:: DESTINATION ${package_folder})

set(version_file ${PROJECT_BINARY_DIR}/vpmConfigVersion.cmake)
write_basic_package_version_file(${version_file} COMPATIBILITY SameMinorVersion)
set(config_file ${PROJECT_BINARY_DIR}/vpmConfig.cmake)
configure_file(cmake/vpmConfig.cmake.in ${config_file} @ONLY)
install(FILES ${version_file} ${config_file} cmake/vpmDependencies.cmake DESTINATION ${package_folder})
