# How the programs of the tests are declared.
if(CMAKE_CROSSCOMPILING)
  include(${CMAKE_CURRENT_LIST_DIR}/SphcGoogleTest.cmake)
  set(SPHC_TEST_SHARES 4) # an emulator is slow: each process runs a share of a program's cases
  set(SPHC_TEST_TIMEOUT 3600)
else()
  find_package(GTest REQUIRED)
  set(SPHC_TEST_SHARES 1)
  set(SPHC_TEST_TIMEOUT 1800) # of a test that hangs: a slow machine that does other things beside takes 600 s for the longest
endif()

# GoogleTest and Eigen are read once for all test programs.  It is a program, as they are: a library's code is compiled
# with other flags.
add_executable(sphc_test_headers test_headers.cpp)
target_link_libraries(sphc_test_headers PRIVATE sphc_flags GTest::gtest GTest::gmock)
set(SPHC_TEST_OPTIONS
  $<$<CONFIG:Release>:-O1> # the tests' own code: what it calls is compiled as it ships
  $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-fpch-preprocess>
  "$<$<COMPILE_LANG_AND_ID:CXX,Clang>:SHELL:-Xclang -fno-pch-timestamp>")
target_compile_options(sphc_test_headers PRIVATE ${SPHC_TEST_OPTIONS})
target_precompile_headers(sphc_test_headers PRIVATE
  "$<$<COMPILE_LANGUAGE:CXX>:<gtest/gtest.h$<ANGLE-R>>" "$<$<COMPILE_LANGUAGE:CXX>:<gmock/gmock.h$<ANGLE-R>>"
  "$<$<COMPILE_LANGUAGE:CXX>:<Eigen/Core$<ANGLE-R>>" "$<$<COMPILE_LANGUAGE:CXX>:<Eigen/Geometry$<ANGLE-R>>")

# sphc_label(LABEL TARGETS...): what the tests of a label run.  `ninja tests_LABEL` builds it, ctest -L LABEL runs it.
function(sphc_label label)
  if(NOT TARGET tests_${label})
    add_custom_target(tests_${label})
  endif()
  add_dependencies(tests_${label} ${ARGN})
endfunction()

# ThreadSanitizer says nothing of a race whose first access is no longer in its history: a frame is long.
set(SPHC_TSAN_OPTIONS TSAN_OPTIONS=suppressions=${PROJECT_SOURCE_DIR}/tests/support/thread_sanitizer.txt:history_size=7)

# The entries of ctest that run a program's cases.
function(sphc_test_entries name labels cost)
  math(EXPR last "${SPHC_TEST_SHARES} - 1")
  foreach(share RANGE ${last})
    set(environment ${SPHC_TSAN_OPTIONS})
    get_property(recording GLOBAL PROPERTY SPHC_RECORDING_TESTS)
    if(name IN_LIST recording)
      list(APPEND environment SPHC_REFUSALS=${SPHC_REFUSALS})
    endif()
    set(entry ${name})
    if(last)
      string(APPEND entry .${share})
      list(APPEND environment GTEST_TOTAL_SHARDS=${SPHC_TEST_SHARES} GTEST_SHARD_INDEX=${share})
    endif()
    add_test(NAME ${entry} COMMAND ${name} --gtest_brief=1)
    set_tests_properties(${entry} PROPERTIES LABELS "${labels}" TIMEOUT ${SPHC_TEST_TIMEOUT}
      ENVIRONMENT "${environment}")
    if(cost)
      set_tests_properties(${entry} PROPERTIES COST ${cost})
    endif()
  endforeach()
endfunction()

# A program that writes down what its tests are refused, for docs/error_cases.md (tests/support/refusals).  The property
# SPHC_RECORDING_TESTS lists these programs.
set(SPHC_REFUSALS ${PROJECT_BINARY_DIR}/refusals)
file(MAKE_DIRECTORY ${SPHC_REFUSALS})
function(sphc_records_refusals name)
  if(NOT TARGET sphc_refusals OR SPHC_SANITIZE)
    return()
  endif()
  set_property(GLOBAL APPEND PROPERTY SPHC_RECORDING_TESTS ${name})
  set(recorders sphc_refusals)
  list(TRANSFORM ARGN REPLACE "^sphc_driver_" "sphc_refusals_" OUTPUT_VARIABLE of_drivers)
  foreach(recorder ${of_drivers})
    if(recorder MATCHES "^sphc_refusals_" AND TARGET ${recorder})
      list(APPEND recorders ${recorder})
    endif()
  endforeach()
  foreach(recorder ${recorders}) # linked, and no more: the tests are compiled as they would be without
    target_sources(${name} PRIVATE $<TARGET_OBJECTS:${recorder}>)
    target_link_options(${name} PRIVATE $<TARGET_PROPERTY:${recorder},INTERFACE_LINK_OPTIONS>)
  endforeach()
  target_link_libraries(${name} PRIVATE $<LINK_ONLY:spherecloud>)
endfunction()

# sphc_test(NAME [RECORDS_REFUSALS] SOURCES... LINKS... LABELS... [COST]): a GoogleTest program.  The longest have a COST, in seconds or so: they
# begin first, so that no core waits at the end.  A program is one entry of ctest, since a process for each
# test case takes longer than most cases do; tests/run.sh counts the cases that it reports.
function(sphc_test name)
  cmake_parse_arguments(arg "RECORDS_REFUSALS" "COST" "SOURCES;LINKS;LABELS" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE sphc_flags ${arg_LINKS} GTest::gtest GTest::gmock GTest::gtest_main)
  if(arg_RECORDS_REFUSALS)
    sphc_records_refusals(${name} ${arg_LINKS})
  endif()
  sphc_unity(${name})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/sdk)
  target_compile_options(${name} PRIVATE ${SPHC_TEST_OPTIONS})
  target_precompile_headers(${name} REUSE_FROM sphc_test_headers)
  sphc_test_entries(${name} "${arg_LABELS}" "${arg_COST}")
  foreach(label ${arg_LABELS})
    sphc_label(${label} ${name})
  endforeach()
endfunction()
