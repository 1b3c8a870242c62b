# find_package(SphereCloud [VERSION] [COMPONENTS runtime signature encryption drivers host]); without components: runtime.
#
#   runtime  SphereCloud::spherecloud (static), SphereCloud::spherecloud_shared
#   signature  SphereCloud::signature, which refuses maps that are not signed
#   encryption  SphereCloud::encryption, which decrypts maps
#   drivers  SphereCloud::replay, ::raw, ::sample, ::simulated, ::v4l2, ::libcamera, ::openni2, as far as they were built;
#            ::contract, the suite that every driver passes
#   host     SphereCloud::command, the program `spherecloud`
function(_spherecloud_find component)
  set(known runtime signature encryption drivers host)
  set(targets ${CMAKE_CURRENT_LIST_DIR}/SphereCloud-${component}.cmake)
  if(NOT component IN_LIST known)
    list(JOIN known ", " names)
    set(why "SphereCloud has no component \"${component}\"; its components are ${names}.")
  elseif(NOT EXISTS ${targets})
    set(cure "install the component \"${component}\" too.")
    if(component MATCHES "^(drivers|host)$") # of which a build may have none
      string(TOUPPER SPHC_${component} option)
      set(cure "build and install it with -D${option}=ON.")
    endif()
    set(why "the component \"${component}\" is not in this installation of SphereCloud; ${cure}")
  else()
    include(${targets})
    set(SphereCloud_${component}_FOUND TRUE PARENT_SCOPE)
    return()
  endif()
  set(SphereCloud_${component}_FOUND FALSE PARENT_SCOPE)
  if(SphereCloud_FIND_REQUIRED_${component})
    set(SphereCloud_FOUND FALSE PARENT_SCOPE)
    set(SphereCloud_NOT_FOUND_MESSAGE ${why} PARENT_SCOPE)
  endif()
endfunction()

# What the static library links lies where this machine has it: CMAKE_PREFIX_PATH tells, as of any other package.  Where it
# is not found the linker says so, if it is needed.
if(NOT TARGET SphereCloud::highway)
  find_library(SphereCloud_HIGHWAY hwy)
  mark_as_advanced(SphereCloud_HIGHWAY)
  add_library(SphereCloud::highway INTERFACE IMPORTED)
  target_link_libraries(SphereCloud::highway INTERFACE $<IF:$<BOOL:${SphereCloud_HIGHWAY}>,${SphereCloud_HIGHWAY},hwy>)
endif()

_spherecloud_find(runtime) # the drivers link it
foreach(_spherecloud_component ${SphereCloud_FIND_COMPONENTS})
  _spherecloud_find(${_spherecloud_component})
endforeach()
unset(_spherecloud_component)
