# find_package(SphereCloud [VERSION] [COMPONENTS runtime drivers host]); without components: runtime.
#
#   runtime  SphereCloud::spherecloud (static), SphereCloud::spherecloud_shared
#   drivers  SphereCloud::replay, ::raw, ::sample, ::simulated, ::v4l2, ::libcamera, ::openni2, as far as they were built
#   host     SphereCloud::command, the program `spherecloud`
set(known runtime drivers host)
include(${CMAKE_CURRENT_LIST_DIR}/SphereCloud-runtime.cmake) # the drivers link it
foreach(component ${SphereCloud_FIND_COMPONENTS})
  set(targets ${CMAKE_CURRENT_LIST_DIR}/SphereCloud-${component}.cmake)
  set(SphereCloud_${component}_FOUND FALSE)
  if(NOT component IN_LIST known)
    list(JOIN known ", " names)
    set(why "SphereCloud has no component \"${component}\"; its components are ${names}.")
  elseif(NOT EXISTS ${targets})
    string(TOUPPER SPHC_${component} option)
    set(why "the component \"${component}\" is not in this installation of SphereCloud; build and install it with -D${option}=ON.")
  else()
    include(${targets})
    set(SphereCloud_${component}_FOUND TRUE)
  endif()
  if(SphereCloud_FIND_REQUIRED_${component} AND NOT SphereCloud_${component}_FOUND)
    set(SphereCloud_FOUND FALSE)
    set(SphereCloud_NOT_FOUND_MESSAGE ${why})
  endif()
endforeach()
