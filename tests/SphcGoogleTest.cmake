# GoogleTest for another machine: Debian has its library for this one, and its sources for all.
set(SPHC_GOOGLETEST /usr/src/googletest CACHE PATH "Sources of GoogleTest, where another machine is compiled for")
if(NOT EXISTS ${SPHC_GOOGLETEST}/CMakeLists.txt)
  message(FATAL_ERROR "the tests need GoogleTest's sources, which are not in ${SPHC_GOOGLETEST}; install googletest, "
    "name their folder by -DSPHC_GOOGLETEST=, or configure with -DSPHC_TESTS=OFF")
endif()

function(sphc_add_googletest) # whose scope keeps our warnings from its sources
  string(APPEND CMAKE_CXX_FLAGS " -w")
  set(INSTALL_GTEST OFF)
  add_subdirectory(${SPHC_GOOGLETEST} ${PROJECT_BINARY_DIR}/googletest EXCLUDE_FROM_ALL SYSTEM)
endfunction()
sphc_add_googletest()
