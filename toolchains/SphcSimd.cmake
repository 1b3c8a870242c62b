# Which instruction sets the SIMD kernels are compiled for; all give the same bytes (docs/platforms.md).
#   dispatch  all that Highway has for this architecture; the best is picked at run time.  Links libhwy.
#   static    what the compiler's flags allow.  Headers of Highway alone.
#   scalar    single lanes.  Headers of Highway alone.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64" AND CMAKE_SIZEOF_VOID_P EQUAL 8)
  set(is_x86_64 ON)
else()
  set(is_x86_64 OFF)
endif()
if(is_x86_64 AND NOT WIN32) # for which no package has libhwy
  set(default dispatch)
elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "^arm" AND NOT CMAKE_SYSTEM_PROCESSOR MATCHES "arm64")
  set(default scalar)
else()
  set(default static)
endif()
set(SPHC_SIMD ${default} CACHE STRING "SIMD kernels: dispatch, static or scalar")
set_property(CACHE SPHC_SIMD PROPERTY STRINGS dispatch static scalar)
if(NOT SPHC_SIMD MATCHES "^(dispatch|static|scalar)$")
  message(FATAL_ERROR "SPHC_SIMD is \"${SPHC_SIMD}\"; it may be dispatch, static or scalar")
endif()
if(default STREQUAL "scalar" AND NOT SPHC_SIMD STREQUAL "scalar")
  message(FATAL_ERROR "SPHC_SIMD must be scalar on 32-bit ARM: its NEON neither divides nor takes roots exactly")
endif()

# Vectors of SVE cannot be members of structs.
set(disabled "HWY_SVE|HWY_SVE2|HWY_SVE_256|HWY_SVE2_128")
if(SPHC_SANITIZE)
  # Kernels with sanitizers take clang minutes to compile: of x86's targets the narrowest and AVX2 are enough.
  string(APPEND disabled "|HWY_SSSE3|HWY_SSE4|HWY_AVX3|HWY_AVX3_DL")
endif()
target_compile_definitions(sphc_flags INTERFACE "HWY_DISABLED_TARGETS=(${disabled})")

add_library(sphc_simd INTERFACE) # of whoever includes Highway
if(SPHC_SIMD STREQUAL "dispatch")
  find_package(PkgConfig REQUIRED)
  pkg_check_modules(SPHC_HWY REQUIRED IMPORTED_TARGET libhwy>=1.0)
  target_link_libraries(sphc_simd INTERFACE PkgConfig::SPHC_HWY)
else()
  string(TOUPPER ${SPHC_SIMD} policy)
  target_compile_definitions(sphc_flags INTERFACE HWY_COMPILE_ONLY_${policy})
  if(is_x86_64)
    # No kernel encrypts; without this, AVX2 is used where -maes and -mpclmul are given too, which x86-64-v3 has not.
    target_compile_definitions(sphc_flags INTERFACE HWY_DISABLE_PCLMUL_AES)
  endif()
  find_path(SPHC_HIGHWAY_INCLUDE hwy/highway.h PATHS /usr/include REQUIRED)
  mark_as_advanced(SPHC_HIGHWAY_INCLUDE)
  set(include ${SPHC_HIGHWAY_INCLUDE})
  if(CMAKE_CROSSCOMPILING AND include STREQUAL "/usr/include")
    # Highway's headers are of every machine; those beside them are not.
    set(include ${PROJECT_BINARY_DIR}/headers)
    file(MAKE_DIRECTORY ${include})
    file(CREATE_LINK /usr/include/hwy ${include}/hwy SYMBOLIC)
  endif()
  target_include_directories(sphc_simd SYSTEM INTERFACE ${include})
endif()
