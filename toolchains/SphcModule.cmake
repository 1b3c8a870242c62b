# One way to declare a library of this project, so that every module gets the same warnings, language level and
# sanitizers.
set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_C_STANDARD 99)
set(CMAKE_C_EXTENSIONS OFF)
get_property(SPHC_HAS_SHARED_LIBRARIES GLOBAL PROPERTY TARGET_SUPPORTS_SHARED_LIBS) # a bare machine has none
set(CMAKE_POSITION_INDEPENDENT_CODE ${SPHC_HAS_SHARED_LIBRARIES})
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_C_VISIBILITY_PRESET hidden)
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)

find_program(SPHC_CCACHE ccache)
if(SPHC_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_C_COMPILER_LAUNCHER ${SPHC_CCACHE})
  set(CMAKE_CXX_COMPILER_LAUNCHER ${SPHC_CCACHE})
endif()

# Taste and instruction sets come before the user's CMAKE_<LANG>_FLAGS, which have the last word.
set(flags "-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wdouble-promotion")
if(SPHC_WERROR)
  string(APPEND flags " -Werror")
endif()
if(CMAKE_SYSTEM_PROCESSOR MATCHES "aarch64|arm64")
  # Highway's NEON has the attribute +crypto, which gcc must see on constructors that it writes itself too; nothing
  # here uses those instructions.
  string(APPEND flags " -march=armv8-a+crypto")
elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "^arm" AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  string(APPEND flags " -mfp16-format=ieee") # Highway names the type where the processor has it
elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "^i[3-6]86$")
  string(APPEND flags " -msse2 -mfpmath=sse") # x87 computes with more digits than the others
endif()
set(CMAKE_C_FLAGS "${flags} ${CMAKE_C_FLAGS}")
set(CMAKE_CXX_FLAGS "${flags} -Wnon-virtual-dtor -Woverloaded-virtual ${CMAKE_CXX_FLAGS}")

# What the results hang on comes after the user's flags.
add_library(sphc_flags INTERFACE)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
target_link_libraries(sphc_flags INTERFACE Eigen3::Eigen)
# The same bytes on every machine (docs/platforms.md): multiply-add only where the code says so, and none of Eigen's
# packets, whose order of summation is the machine's.  Types stay aligned as in libraries that were built with Eigen's
# defaults.
target_compile_options(sphc_flags INTERFACE -ffp-contract=off)
target_compile_definitions(sphc_flags INTERFACE EIGEN_DONT_VECTORIZE EIGEN_MAX_STATIC_ALIGN_BYTES=16)
include(SphcSimd)
if(SPHC_SANITIZE)
  target_compile_options(sphc_flags INTERFACE -fsanitize=${SPHC_SANITIZE} -fno-omit-frame-pointer
    -fno-sanitize-recover=all)
  target_link_options(sphc_flags INTERFACE -fsanitize=${SPHC_SANITIZE})
  target_compile_options(sphc_flags INTERFACE $<$<COMPILE_LANG_AND_ID:CXX,Clang>:-Wno-pass-failed>) # loops asked to be vectors
endif()

# The device side: no exceptions, no RTTI; Eigen may neither allocate nor print.  gcc's vectorizer of straight-line code
# makes fused vfmaddsub for processors that have it, -ffp-contract=off or not.
add_library(sphc_runtime_flags INTERFACE)
target_link_libraries(sphc_runtime_flags INTERFACE sphc_flags)
target_compile_options(sphc_runtime_flags INTERFACE
  $<$<COMPILE_LANGUAGE:CXX>:-fno-exceptions -fno-rtti -fno-threadsafe-statics -fno-math-errno>
  $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-fno-tree-slp-vectorize>)

# Reading these takes longer than most of our files.  ccache needs the options, and CCACHE_SLOPPINESS as in tests/run.sh.
set(SPHC_PRECOMPILE_FROM 4) # sources; fewer are not worth it
function(sphc_precompile target)
  get_target_property(sources ${target} SOURCES)
  list(LENGTH sources count)
  if(count LESS SPHC_PRECOMPILE_FROM)
    return()
  endif()
  list(TRANSFORM ARGN REPLACE "(.+)" "$<$<COMPILE_LANGUAGE:CXX>:<\\1$<ANGLE-R>>" OUTPUT_VARIABLE headers)
  target_precompile_headers(${target} PRIVATE ${headers})
  target_compile_options(${target} PRIVATE
    $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-fpch-preprocess>
    "$<$<COMPILE_LANG_AND_ID:CXX,Clang>:SHELL:-Xclang -fno-pch-timestamp>")
endfunction()

# sphc_module(NAME SOURCES... [RUNTIME] [LINKS...] [PRECOMPILE...]): a folder is a target.
# RUNTIME modules are objects gathered into the one library `spherecloud`; others are static libraries.
# PRECOMPILE: headers of other people that most of the sources include.
function(sphc_module name)
  cmake_parse_arguments(arg "RUNTIME" "" "SOURCES;LINKS;PRECOMPILE" ${ARGN})
  if(arg_RUNTIME)
    add_library(${name} OBJECT ${arg_SOURCES})
    target_link_libraries(${name} PUBLIC sphc_runtime_flags PRIVATE ${arg_LINKS})
    target_compile_definitions(${name} PRIVATE SPHC_BUILDING EIGEN_NO_MALLOC EIGEN_NO_IO)
    set_property(GLOBAL APPEND PROPERTY SPHC_RUNTIME_OBJECTS ${name})
  else()
    add_library(${name} STATIC ${arg_SOURCES})
    target_link_libraries(${name} PRIVATE sphc_flags PUBLIC ${arg_LINKS})
  endif()
  target_include_directories(${name} PUBLIC ${PROJECT_SOURCE_DIR}/sdk ${PROJECT_SOURCE_DIR}/sdk/include)
  list(FILTER arg_SOURCES INCLUDE REGEX "_simd.cpp$")
  if(SPHC_SANITIZE MATCHES "address" AND arg_SOURCES) # with both sanitizers they take three times as long
    set_source_files_properties(${arg_SOURCES} PROPERTIES COMPILE_OPTIONS -fno-sanitize=undefined
      SKIP_PRECOMPILE_HEADERS ON)
  endif()
  if(SPHC_SANITIZE OR NOT arg_RUNTIME) # firmware's files show that they include what they need
    sphc_precompile(${name} Eigen/Core Eigen/Geometry ${arg_PRECOMPILE})
  endif()
endfunction()

# sphc_test(NAME SOURCES... LINKS... LABELS...): a GoogleTest program, one ctest entry a test case (with AddressSanitizer one a program).
function(sphc_test name)
  cmake_parse_arguments(arg "" "" "SOURCES;LINKS;LABELS" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE sphc_flags ${arg_LINKS} GTest::gtest GTest::gmock GTest::gtest_main)
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/sdk)
  sphc_precompile(${name} gtest/gtest.h Eigen/Core Eigen/Geometry)
  set(environment TSAN_OPTIONS=suppressions=${PROJECT_SOURCE_DIR}/tests/support/thread_sanitizer.txt)
  if(SPHC_SANITIZE MATCHES "address") # a process a test case would take longer than most cases
    add_test(NAME ${name} COMMAND ${name} --gtest_brief=1)
    # OpenNI2 asks threads that have ended whether they live, which wants their stacks to be kept.
    set_tests_properties(${name} PROPERTIES LABELS "${arg_LABELS}" TIMEOUT 600
      ENVIRONMENT GLIBC_TUNABLES=glibc.pthread.stack_cache_size=1073741824)
  else()
    gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60
      PROPERTIES LABELS "${arg_LABELS}" TIMEOUT 300 ENVIRONMENT "${environment}")
  endif()
endfunction()
