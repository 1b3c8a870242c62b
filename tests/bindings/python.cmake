# The Python package: the golden session, misuse and lifetimes; and the wheel, installed without a network.
sphc_generated(python)
execute_process(COMMAND ${SPHC_TEST_PYTHON} -c "import numpy" RESULT_VARIABLE python_lacks_numpy OUTPUT_QUIET ERROR_QUIET)
if(python_lacks_numpy)
  message(STATUS "bindings: no tests of the Python package; toolchains/install_python_packages.sh build/python installs numpy")
  return()
endif()
set(python_package ${PROJECT_SOURCE_DIR}/bindings/python)
set(python_tests ${SPHC_TEST_PYTHON} -B -m unittest discover -s ${python_package}/tests)
sphc_binding_test(python ${CMAKE_COMMAND} -E env PYTHONPATH=${python_package} ${python_tests} -p "[!w]*_test.py")
sphc_binding_test(python_wheel ${CMAKE_COMMAND} -E env PYTHONPATH=${python_package} ${python_tests} -p "wheel_test.py")
if(TARGET spherecloud_cli) # the notebook calls it
  sphc_binding_test(python_walk ${CMAKE_COMMAND} -E env --modify PATH=path_list_prepend:$<TARGET_FILE_DIR:spherecloud_cli>
    PYTHONPATH=${python_package} ${python_tests} -p "walk_test.py")
endif()

set(python_wheel ${CMAKE_CURRENT_BINARY_DIR}/python_wheel)
add_custom_target(python_overhead VERBATIM
  COMMAND ${CMAKE_COMMAND} -E env --unset=SPHERECLOUD_LIBRARY ${SPHC_TEST_PYTHON} -B ${python_package}/build_wheel.py --out ${python_wheel})
sphc_overhead(python PACKAGES ${python_wheel}/spherecloud-${PROJECT_VERSION}${SPHC_CANDIDATE}-py3-none-any.whl $<TARGET_FILE:spherecloud_shared>
  COMMAND ${CMAKE_COMMAND} -E env PYTHONPATH=${python_package} ${SPHC_TEST_PYTHON} ${PROJECT_SOURCE_DIR}/bindings/overhead/overhead.py
  DEPENDS python_overhead)
