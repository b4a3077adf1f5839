# Writes version.cpp with the git commit, at build time: cmake -D SOURCE_DIR= -D OUTPUT= -D VERSION= -P version.cmake
# Outside a git checkout of its own (a tarball) the version stands alone.
set(version "${VERSION}")
if(EXISTS "${SOURCE_DIR}/.git")
  execute_process(COMMAND git -C "${SOURCE_DIR}" describe --always --dirty=-modified --abbrev=12 --exclude=*
    OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE RESULT_VARIABLE failed ERROR_QUIET)
  if(NOT failed AND commit)
    set(version "${VERSION} (${commit})")
  endif()
endif()
# configure_file leaves the file, and so everything built from it, alone where nothing changed.
configure_file("${SOURCE_DIR}/cmake/version.cpp.in" "${OUTPUT}" @ONLY)
