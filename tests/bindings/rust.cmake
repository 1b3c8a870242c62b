# Rust: cargo of Debian (1.63) or newer; nothing is downloaded.
find_program(SPHC_CARGO cargo)
if(NOT SPHC_CARGO)
  message(STATUS "Tests of the binding for Rust are left out: no cargo; apt-get install cargo")
  return()
endif()
sphc_generated(rust)

set(rust_folder ${PROJECT_SOURCE_DIR}/bindings/rust)
set(rust_environment CARGO_TARGET_DIR=${CMAKE_CURRENT_BINARY_DIR}/rust
  SPHERECLOUD_LIB_DIR=$<TARGET_FILE_DIR:spherecloud_shared>
  LD_LIBRARY_PATH=$<TARGET_FILE_DIR:spherecloud_shared> MALLOC_PERTURB_=165) # what is freed is overwritten
set(rust_cargo ${CMAKE_COMMAND} -E env ${rust_environment} ${SPHC_CARGO} test --offline --locked --quiet --workspace
  --manifest-path ${rust_folder}/Cargo.toml)

# Compiled with the tests of other languages, so that running them takes seconds.
file(GLOB_RECURSE rust_sources CONFIGURE_DEPENDS ${rust_folder}/*.rs ${rust_folder}/Cargo.*)
add_custom_command(OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/rust_tests.stamp
  COMMAND ${rust_cargo} --no-run
  COMMAND ${CMAKE_COMMAND} -E touch ${CMAKE_CURRENT_BINARY_DIR}/rust_tests.stamp
  DEPENDS spherecloud_shared ${rust_sources} VERBATIM)
add_custom_target(rust_tests ALL DEPENDS ${CMAKE_CURRENT_BINARY_DIR}/rust_tests.stamp)
sphc_label(bindings rust_tests)

sphc_binding_test(rust ${rust_cargo} --tests)
sphc_binding_test(rust_documentation ${rust_cargo} --doc)
sphc_binding_test(rust_example ${CMAKE_COMMAND} -E env ${rust_environment} ${SPHC_SAYS_POSES} "[[].*[]], [0-9.]+ sure" "[[].*[]], [0-9.]+ sure" "FewKeypoints, .*"
  ${CMAKE_CURRENT_BINARY_DIR}/rust/debug/examples/first_pose ${SPHC_GOLDEN})
add_test(NAME bindings.rust_links COMMAND ${Python3_EXECUTABLE} -B ${CMAKE_CURRENT_LIST_DIR}/rust_links_test.py ${SPHC_CARGO}
  ${rust_folder}/Cargo.toml)
set_tests_properties(bindings.rust_links PROPERTIES LABELS bindings)
# One program at a time writes the target folder.
set_tests_properties(bindings.rust bindings.rust_documentation PROPERTIES RESOURCE_LOCK cargo)

# The crate does without the standard library, and without a heap.
foreach(heap no_heap alloc)
  if(heap STREQUAL alloc)
    set(features --features alloc)
  else()
    set(features)
  endif()
  add_test(NAME bindings.rust_no_std_${heap} COMMAND ${CMAKE_COMMAND} -E env ${rust_environment} ${SPHC_CARGO} check
    --offline --locked --quiet --lib --no-default-features ${features} --manifest-path ${rust_folder}/spherecloud/Cargo.toml)
  set_tests_properties(bindings.rust_no_std_${heap} PROPERTIES LABELS bindings RESOURCE_LOCK cargo)
endforeach()

set(rust_release ${CMAKE_COMMAND} -E env ${rust_environment} ${SPHC_CARGO} build --release --offline --locked --quiet --examples
  --manifest-path ${rust_folder}/Cargo.toml)
add_custom_target(rust_overhead COMMAND ${rust_release} DEPENDS spherecloud_shared VERBATIM)
set(rust_examples ${CMAKE_CURRENT_BINARY_DIR}/rust/release/examples)
sphc_overhead(rust PACKAGES ${rust_examples}/first_pose $<TARGET_FILE:spherecloud_shared> COMMAND ${rust_examples}/overhead DEPENDS rust_overhead)
