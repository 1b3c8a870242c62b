# The C# binding, with Mono: Debian's mono-mcs and mono-runtime.
sphc_generated(csharp)
find_program(SPHC_MCS mcs)
find_program(SPHC_MONO mono)
if(NOT SPHC_MCS OR NOT SPHC_MONO)
  message(STATUS "C#: mcs and mono are missing; its tests are left out. Install mono-mcs and mono-runtime.")
  return()
endif()

set(SPHC_CSHARP ${PROJECT_SOURCE_DIR}/bindings/csharp)
set(SPHC_CSHARP_BUILT ${CMAKE_CURRENT_BINARY_DIR}/csharp)
file(GLOB SPHC_CSHARP_SOURCES CONFIGURE_DEPENDS ${SPHC_CSHARP}/Runtime/*.cs ${SPHC_CSHARP}/Runtime/Generated/*.cs)
file(GLOB SPHC_CSHARP_TESTS CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/csharp/*.cs)
set(SPHC_CSHARP_STAND_INS ${CMAKE_CURRENT_LIST_DIR}/csharp/stand_ins)
set(SPHC_CSHARP_COMPILE ${SPHC_MCS} -langversion:7.2 -unsafe -optimize -warn:4 -warnaserror)

# sphc_csharp(FILE SOURCES FLAGS...): FILE is an .exe or a .dll.
function(sphc_csharp file sources)
  get_filename_component(folder ${file} DIRECTORY)
  file(MAKE_DIRECTORY ${folder})
  add_custom_command(OUTPUT ${file} COMMAND ${SPHC_CSHARP_COMPILE} -out:${file} ${ARGN} ${sources} DEPENDS ${sources}
    VERBATIM)
endfunction()

# Alone, with a comment on everything public; for Unity and for .NET by stand-ins of what mono has not.
sphc_csharp(${SPHC_CSHARP_BUILT}/SphereCloud.dll "${SPHC_CSHARP_SOURCES}" -target:library -doc:${SPHC_CSHARP_BUILT}/SphereCloud.xml)
sphc_csharp(${SPHC_CSHARP_BUILT}/dotnet.dll "${SPHC_CSHARP_SOURCES};${SPHC_CSHARP_STAND_INS}/NativeLibrary.cs"
  -target:library -define:NET5_0_OR_GREATER)
set(SPHC_CSHARP_UNITY "${SPHC_CSHARP_STAND_INS}/UnityEngine.cs;${SPHC_CSHARP}/Samples~/Unity/RelocalizedCamera.cs")
set(SPHC_CSHARP_PLAYERS)
foreach(player IOS TVOS VISIONOS WEBGL ANDROID)
  sphc_csharp(${SPHC_CSHARP_BUILT}/unity_${player}.dll "${SPHC_CSHARP_SOURCES};${SPHC_CSHARP_UNITY}"
    -target:library -define:UNITY_5_3_OR_NEWER -define:UNITY_${player})
  list(APPEND SPHC_CSHARP_PLAYERS ${SPHC_CSHARP_BUILT}/unity_${player}.dll)
endforeach()
sphc_csharp(${SPHC_CSHARP_BUILT}/tests.exe
  "${SPHC_CSHARP_SOURCES};${SPHC_CSHARP_TESTS};${SPHC_CSHARP_UNITY}"
  -define:UNITY_5_3_OR_NEWER)
add_custom_command(OUTPUT ${SPHC_CSHARP_BUILT}/FirstPose.exe
  COMMAND ${SPHC_CSHARP_COMPILE} -out:${SPHC_CSHARP_BUILT}/FirstPose.exe -reference:${SPHC_CSHARP_BUILT}/SphereCloud.dll
    ${SPHC_CSHARP}/Samples~/FirstPose/FirstPose.cs
  COMMAND ${CMAKE_COMMAND} -E copy ${SPHC_CSHARP_BUILT}/FirstPose.exe ${SPHC_CSHARP_BUILT}/SphereCloud.dll ${SPHC_CSHARP_BUILT}/lost
  DEPENDS ${SPHC_CSHARP_BUILT}/SphereCloud.dll ${SPHC_CSHARP}/Samples~/FirstPose/FirstPose.cs VERBATIM)
add_custom_target(csharp_tests ALL DEPENDS ${SPHC_CSHARP_BUILT}/tests.exe ${SPHC_CSHARP_BUILT}/dotnet.dll ${SPHC_CSHARP_BUILT}/FirstPose.exe
  ${SPHC_CSHARP_PLAYERS})
sphc_label(bindings csharp_tests)

# Mono's way to name a library: a map beside the assembly that has the binding in it, named after that assembly.
foreach(assembly SphereCloud.dll tests.exe)
  file(GENERATE OUTPUT ${SPHC_CSHARP_BUILT}/${assembly}.config
    CONTENT "<configuration><dllmap dll=\"spherecloud\" target=\"$<TARGET_FILE:spherecloud_shared>\"/></configuration>\n")
endforeach()
file(WRITE ${SPHC_CSHARP_BUILT}/lost/SphereCloud.dll.config
  "<configuration><dllmap dll=\"spherecloud\" target=\"/lost/libspherecloud.so\"/></configuration>\n")

set(SPHC_FIRST_FRAME ${SPHC_GOLDEN}/room.sphc ${SPHC_GOLDEN}/color_00.gray8 ${SPHC_GOLDEN}/depth_00.depth16)
sphc_binding_test(csharp ${SPHC_MONO} ${SPHC_CSHARP_BUILT}/tests.exe)
sphc_binding_test(csharp_first_pose ${SPHC_MONO} ${SPHC_CSHARP_BUILT}/FirstPose.exe ${SPHC_FIRST_FRAME})
sphc_binding_test(csharp_without_library ${SPHC_MONO} ${SPHC_CSHARP_BUILT}/lost/FirstPose.exe ${SPHC_FIRST_FRAME})
set_tests_properties(bindings.csharp_without_library PROPERTIES PASS_REGULAR_EXPRESSION "was not found.*place_library.py")

set(csharp_overhead ${PROJECT_SOURCE_DIR}/bindings/overhead/Overhead.cs)
add_custom_command(OUTPUT ${SPHC_CSHARP_BUILT}/Overhead.exe DEPENDS ${SPHC_CSHARP_BUILT}/SphereCloud.dll ${csharp_overhead} VERBATIM
  COMMAND ${SPHC_CSHARP_COMPILE} -out:${SPHC_CSHARP_BUILT}/Overhead.exe -reference:${SPHC_CSHARP_BUILT}/SphereCloud.dll ${csharp_overhead})
add_custom_target(csharp_overhead DEPENDS ${SPHC_CSHARP_BUILT}/Overhead.exe)
sphc_overhead(csharp PACKAGES ${SPHC_CSHARP_BUILT}/SphereCloud.dll $<TARGET_FILE:spherecloud_shared> COMMAND ${SPHC_MONO} ${SPHC_CSHARP_BUILT}/Overhead.exe DEPENDS csharp_overhead)
