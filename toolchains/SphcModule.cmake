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
elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "^(i[3-6]86|x86_64|AMD64)$" AND CMAKE_SIZEOF_VOID_P EQUAL 4) # also by -m32
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
target_compile_definitions(sphc_flags INTERFACE EIGEN_DONT_VECTORIZE EIGEN_MAX_STATIC_ALIGN_BYTES=16
  SPHC_UNSTABLE)
# Under a name of its own (docs/decisions/0090): a program that uses Eigen too has the same templates by other flags, and a
# linker takes either for both.
target_compile_definitions(sphc_flags INTERFACE Eigen=sphc_eigen)
include(SphcSimd)
if(SPHC_SANITIZE)
  target_compile_options(sphc_flags INTERFACE -fsanitize=${SPHC_SANITIZE} -fno-omit-frame-pointer
    -fno-sanitize-recover=all)
  if(SPHC_SANITIZE MATCHES "address" AND SPHC_SANITIZE MATCHES "undefined")
    # With both, clang optimises next to nothing of Eigen, and the tests take many times as long.  The option's old name
    # is the one that ccache 4.7 knows to name a file.
    target_compile_options(sphc_flags INTERFACE
      "$<$<COMPILE_LANG_AND_ID:CXX,Clang>:-fsanitize-blacklist=${CMAKE_CURRENT_LIST_DIR}/sanitizer_ignorelist.txt>")
  endif()
  target_link_options(sphc_flags INTERFACE -fsanitize=${SPHC_SANITIZE})
  target_compile_options(sphc_flags INTERFACE $<$<COMPILE_LANG_AND_ID:CXX,Clang>:-Wno-pass-failed>) # loops asked to be vectors
endif()

# Programs and libraries of an operating system, and what they are linked with; docs/hardening.md.  What devices link has
# no stack protector: it would ask firmware for two symbols, and the runtime writes into memory of its caller alone.
add_library(sphc_host_flags INTERFACE)
target_link_libraries(sphc_host_flags INTERFACE sphc_flags)
set(SPHC_HARDENED_LINK)
if(CMAKE_EXECUTABLE_FORMAT STREQUAL "ELF" AND NOT CMAKE_SYSTEM_NAME STREQUAL "Generic")
  set(SPHC_HARDENED_LINK -Wl,-z,relro,-z,now,-z,noexecstack)
  target_compile_options(sphc_host_flags INTERFACE -fstack-protector-strong)
  if(NOT SPHC_SANITIZE) # which checks the same functions, and more
    target_compile_options(sphc_host_flags INTERFACE "$<$<CONFIG:Release,RelWithDebInfo,MinSizeRel>:-U_FORTIFY_SOURCE;-D_FORTIFY_SOURCE=2>")
  endif()
endif()

# The device side: no exceptions, no RTTI; Eigen may neither allocate nor print.  gcc's vectorizer of straight-line code
# makes fused vfmaddsub for processors that have it, -ffp-contract=off or not.
add_library(sphc_runtime_flags INTERFACE)
target_link_libraries(sphc_runtime_flags INTERFACE sphc_flags)
target_compile_options(sphc_runtime_flags INTERFACE
  $<$<COMPILE_LANGUAGE:CXX>:-fno-exceptions -fno-rtti -fno-threadsafe-statics -fno-math-errno>
  $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-fno-tree-slp-vectorize>)
# Of the runtime's own files.  Eigen unrolls sums of up to 8 products, whose order its loops would change, but no products
# of matrices, which take room.
add_library(sphc_runtime_code INTERFACE)
target_link_libraries(sphc_runtime_code INTERFACE sphc_runtime_flags)
target_compile_definitions(sphc_runtime_code INTERFACE SPHC_BUILDING EIGEN_NO_MALLOC EIGEN_NO_IO EIGEN_UNROLLING_LIMIT=40)
if(SPHC_SANITIZE MATCHES "undefined" AND CMAKE_CXX_COMPILER_ID MATCHES "Clang") # integers that do not fit where they go
  set(SPHC_INTEGERS ,implicit-integer-truncation)
  target_compile_options(sphc_runtime_code INTERFACE -fsanitize=implicit-integer-truncation)
  target_link_options(sphc_flags INTERFACE -fsanitize=implicit-integer-truncation)
endif()

# Of decisions and checks, a few times a frame: firmware has all of them in flash, but for what it never calls.
set(SPHC_SMALL $<$<CONFIG:Release>:-Os> -ffunction-sections)

# Reading other people's headers takes longer than most of our files.  Modules that are compiled alike share one library of
# precompiled headers.  ccache needs the options, and CCACHE_SLOPPINESS as in tests/run.sh.
set(SPHC_HEADERS_OPTIONS
  $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-fpch-preprocess>
  "$<$<COMPILE_LANG_AND_ID:CXX,Clang>:SHELL:-Xclang -fno-pch-timestamp>")
set(SPHC_HEADERS_SOURCE ${CMAKE_CURRENT_LIST_DIR}/headers.cpp)

# sphc_headers(NAME FLAGS... OPTIONS... HEADERS...): FLAGS and OPTIONS are those of the modules.
function(sphc_headers name)
  cmake_parse_arguments(arg "" "" "FLAGS;OPTIONS;HEADERS" ${ARGN})
  add_library(${name} OBJECT EXCLUDE_FROM_ALL ${SPHC_HEADERS_SOURCE})
  target_link_libraries(${name} PRIVATE ${arg_FLAGS})
  target_compile_options(${name} PRIVATE ${arg_OPTIONS} ${SPHC_HEADERS_OPTIONS})
  list(TRANSFORM arg_HEADERS REPLACE "(.+)" "$<$<COMPILE_LANGUAGE:CXX>:<\\1$<ANGLE-R>>" OUTPUT_VARIABLE headers)
  target_precompile_headers(${name} PRIVATE ${headers})
endfunction()

sphc_headers(sphc_host_headers FLAGS sphc_host_flags HEADERS Eigen/Core Eigen/Geometry)
if(SPHC_SANITIZE)
  set(SPHC_PRECOMPILE_RUNTIME ON)
else()
  # Off where it ships: firmware's files show that they include what they need.  The code is the same.
  option(SPHC_PRECOMPILE_RUNTIME "The runtime reads Eigen precompiled" OFF)
endif()
if(SPHC_PRECOMPILE_RUNTIME)
  sphc_headers(sphc_runtime_headers FLAGS sphc_runtime_code HEADERS Eigen/Core Eigen/Geometry)
  sphc_headers(sphc_small_runtime_headers FLAGS sphc_runtime_code OPTIONS ${SPHC_SMALL} HEADERS Eigen/Core Eigen/Geometry)
endif()

# sphc_unity(TARGET): where much is compiled and nothing edited, up to eight files of a folder are read as one.  Those of
# the runtime only by an option of their own: they are tested as they ship.
option(SPHC_UNITY_RUNTIME "Compile up to eight files of the runtime as one" OFF)
set(SPHC_UNITY_FILES 8) # more take a core's share of the memory
function(sphc_unity target)
  if(NOT SPHC_UNITY)
    return()
  endif()
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources INCLUDE REGEX "\\.cpp$")
  list(FILTER sources EXCLUDE REGEX "_(simd|scalar)\\.cpp$")  # they include themselves, or are compiled otherwise
  foreach(source ${sources})
    get_filename_component(folder ${source} DIRECTORY)
    string(MAKE_C_IDENTIFIER "in_${folder}" folder)
    math(EXPR batch "0${${folder}} / ${SPHC_UNITY_FILES}")
    math(EXPR ${folder} "0${${folder}} + 1")
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${folder}_${batch})
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()

# sphc_module(NAME SOURCES... [RUNTIME] [DEVICE] [SMALL] [LINKS...] [HEADERS...]): a folder is a target.
# RUNTIME modules are objects gathered into the one library `spherecloud`; others are static libraries, those of DEVICE in C.
# SMALL: small rather than fast.
# HEADERS: a library of precompiled headers, where it is not that of all.
function(sphc_module name)
  cmake_parse_arguments(arg "RUNTIME;DEVICE;SMALL" "HEADERS" "SOURCES;LINKS" ${ARGN})
  if(arg_RUNTIME)
    add_library(${name} OBJECT ${arg_SOURCES})
    target_link_libraries(${name} PUBLIC sphc_runtime_flags PRIVATE sphc_runtime_code ${arg_LINKS})
    set_property(GLOBAL APPEND PROPERTY SPHC_RUNTIME_OBJECTS ${name})
  else()
    set(module_flags sphc_host_flags)
    if(arg_DEVICE)
      set(module_flags sphc_flags)
    endif()
    add_library(${name} STATIC ${arg_SOURCES})
    target_link_libraries(${name} PRIVATE $<BUILD_INTERFACE:${module_flags}> PUBLIC ${arg_LINKS})
  endif()
  if(arg_RUNTIME)
    set(SPHC_UNITY ${SPHC_UNITY_RUNTIME})
  endif()
  sphc_unity(${name})
  target_include_directories(${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/sdk>
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/sdk/include>)
  string(FIND "${arg_SOURCES}" ".cpp" has_cpp)
  list(FILTER arg_SOURCES INCLUDE REGEX "_simd.cpp$")
  if(SPHC_SANITIZE MATCHES "address" AND arg_SOURCES) # with both sanitizers they take three times as long
    set_source_files_properties(${arg_SOURCES} PROPERTIES COMPILE_OPTIONS -fno-sanitize=undefined${SPHC_INTEGERS}
      SKIP_PRECOMPILE_HEADERS ON)
  endif()
  if(NOT arg_HEADERS AND NOT arg_RUNTIME)
    set(arg_HEADERS sphc_host_headers)
  elseif(arg_RUNTIME AND SPHC_PRECOMPILE_RUNTIME)
    set(arg_HEADERS sphc_runtime_headers)
    if(arg_SMALL)
      set(arg_HEADERS sphc_small_runtime_headers)
    endif()
  endif()
  if(arg_SMALL)
    target_compile_options(${name} PRIVATE ${SPHC_SMALL})
  endif()
  if(arg_HEADERS AND has_cpp GREATER -1)
    target_precompile_headers(${name} REUSE_FROM ${arg_HEADERS})
    target_compile_options(${name} PRIVATE ${SPHC_HEADERS_OPTIONS})
  endif()
endfunction()
