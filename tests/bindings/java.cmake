# Java: its jar and its JNI library, in JUnit's hands.
sphc_generated(java)
find_package(Java 11 COMPONENTS Development Runtime)
find_file(SPHC_JUNIT_JAR junit4.jar PATHS /usr/share/java)
find_file(SPHC_HAMCREST_JAR hamcrest.jar PATHS /usr/share/java)
if(NOT Java_Development_FOUND OR NOT Java_Runtime_FOUND OR NOT SPHC_JUNIT_JAR OR NOT SPHC_HAMCREST_JAR)
  message(STATUS "Java's tests are left out; install openjdk-17-jdk-headless and junit4 for them")
  return()
endif()
set(SPHC_JAVA_FOLDER ${PROJECT_SOURCE_DIR}/bindings/java)
add_subdirectory(${SPHC_JAVA_FOLDER} ${PROJECT_BINARY_DIR}/bindings/java)
get_target_property(jar spherecloud_jar JAR)

# sphc_java_classes(NAME CLASS_PATH SOURCES...): compiled into a folder of that name.
function(sphc_java_classes name class_path)
  set(stamp ${CMAKE_CURRENT_BINARY_DIR}/${name}.stamp)
  add_custom_command(OUTPUT ${stamp} DEPENDS ${ARGN} ${jar} VERBATIM
    COMMAND ${CMAKE_COMMAND} -E rm -rf ${CMAKE_CURRENT_BINARY_DIR}/${name}
    COMMAND ${Java_JAVAC_EXECUTABLE} --release 11 -Xlint:all,-try -Werror -cp ${class_path}
      -d ${CMAKE_CURRENT_BINARY_DIR}/${name} ${ARGN}
    COMMAND ${CMAKE_COMMAND} -E touch ${stamp})
  add_custom_target(${name} DEPENDS ${stamp})
  add_dependencies(${name} spherecloud_jar)
endfunction()

set(junit ${SPHC_JUNIT_JAR}:${SPHC_HAMCREST_JAR})
file(GLOB sources CONFIGURE_DEPENDS ${SPHC_JAVA_FOLDER}/src/test/java/org/spherecloud/*.java)
sphc_java_classes(java_tests ${jar}:${junit} ${sources})
sphc_java_classes(java_example ${jar} ${SPHC_JAVA_FOLDER}/examples/FirstPose.java)
set(tests ${sources})
list(FILTER tests INCLUDE REGEX "Test\\.java$")
list(TRANSFORM tests REPLACE "^.*/([A-Za-z]+)\\.java$" "org.spherecloud.\\1")

set(run ${Java_JAVA_EXECUTABLE} -Xcheck:jni -ea -Xshare:auto -XX:TieredStopAtLevel=1
  -Dspherecloud.jni=$<TARGET_FILE:spherecloud_jni>)
sphc_binding_test(java COMMAND ${run} -Dspherecloud.layout=${PROJECT_SOURCE_DIR}/tests/abi/layout.csv
  -cp ${jar}:${CMAKE_CURRENT_BINARY_DIR}/java_tests:${junit} org.junit.runner.JUnitCore ${tests})
sphc_binding_test(java_example COMMAND ${SPHC_SAYS_POSES} "q_wxyz 0[.]99975.*, t_m .*" "q_wxyz 0[.]99.*, t_m .*" "FEW_KEYPOINTS .*" ${run} -cp ${jar}:${CMAKE_CURRENT_BINARY_DIR}/java_example FirstPose ${SPHC_GOLDEN})
sphc_binding_test(java_packages COMMAND ${Python3_EXECUTABLE} -B ${CMAKE_CURRENT_SOURCE_DIR}/java_packages_test.py
  ${Java_JAVA_EXECUTABLE} ${Java_JAVAC_EXECUTABLE} ${jar} $<TARGET_FILE:spherecloud_jni> $<TARGET_FILE:spherecloud>)
add_custom_target(java_test_programs ALL)
add_dependencies(java_test_programs spherecloud_java java_tests java_example)
sphc_label(bindings java_test_programs)

sphc_java_classes(java_overhead ${jar} ${PROJECT_SOURCE_DIR}/bindings/overhead/Overhead.java)
sphc_overhead(java PACKAGES ${jar} $<TARGET_FILE:spherecloud_jni> # which has the library in it
  COMMAND ${Java_JAVA_EXECUTABLE} -Dspherecloud.jni=$<TARGET_FILE:spherecloud_jni> -cp ${jar}:${CMAKE_CURRENT_BINARY_DIR}/java_overhead Overhead
  DEPENDS java_overhead spherecloud_java)
