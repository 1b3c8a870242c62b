# What an installation has, and the names by which other projects know it: docs/install.md.
option(SPHC_INSTALL "Rules of installation, and the target uninstall" ${PROJECT_IS_TOP_LEVEL})
set(SPHC_INSTALL_FILES ${CMAKE_CURRENT_LIST_DIR}/install)
if(SPHC_INSTALL)
  include(GNUInstallDirs)
  set(SPHC_INSTALL_CMAKEDIR ${CMAKE_INSTALL_LIBDIR}/cmake/SphereCloud)
endif()

# sphc_development(OUT COMPONENT): the component of the installation for those who build with it; devices need the runtime alone.
function(sphc_development out component)
  string(REGEX REPLACE "^runtime$" "development" development ${component})
  set(${out} ${development} PARENT_SCOPE)
endfunction()

# sphc_export(COMPONENT TARGET NAME): other projects say SphereCloud::NAME, whether they find it installed or build it.
function(sphc_export component target name)
  get_target_property(type ${target} TYPE)
  if(type STREQUAL "EXECUTABLE")
    add_executable(SphereCloud::${name} ALIAS ${target})
  else()
    add_library(SphereCloud::${name} ALIAS ${target})
  endif()
  if(SPHC_INSTALL)
    sphc_development(development ${component})
    set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
    set_property(GLOBAL APPEND PROPERTY SPHC_INSTALLED_COMPONENTS ${component})
    install(TARGETS ${target} EXPORT SphereCloud-${component}
      RUNTIME COMPONENT ${component}
      LIBRARY COMPONENT ${component} NAMELINK_COMPONENT ${development}
      ARCHIVE COMPONENT ${development})
  endif()
endfunction()

# sphc_linker_names(OUT TARGETS...): other projects' targets as the linker knows them.
function(sphc_linker_names out)
  set(names)
  foreach(link ${ARGN})
    if(link MATCHES "^PkgConfig::(.+)$")
      list(APPEND names ${${CMAKE_MATCH_1}_LIBRARIES})
    elseif(link STREQUAL "ZLIB::ZLIB")
      list(APPEND names z)
    elseif(link STREQUAL "Threads::Threads")
      list(APPEND names ${CMAKE_THREAD_LIBS_INIT})
    elseif(NOT link MATCHES "[:$]") # no headers alone, no flags of ours
      list(APPEND names ${link})
    endif()
  endforeach()
  set(${out} ${names} PARENT_SCOPE)
endfunction()

# sphc_export_driver(TARGET NAME HEADERS...): a static library and its public headers, under the paths by which they are
# included in the tree.  Whoever links it installed needs the libraries of others as the linker knows them, and no
# package of theirs.  Those that a library links are exported before it.
function(sphc_export_driver target name)
  sphc_export(drivers ${target} ${name})
  target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
  if(NOT SPHC_INSTALL)
    return()
  endif()
  target_include_directories(${target} PUBLIC
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/spherecloud>)
  get_target_property(links ${target} INTERFACE_LINK_LIBRARIES)
  set(ours ${links})
  list(FILTER ours INCLUDE REGEX "^(sphc_|spherecloud$)")
  list(REMOVE_ITEM links ${ours})
  sphc_linker_names(theirs ${links})
  set_property(TARGET ${target} PROPERTY INTERFACE_LINK_LIBRARIES
    "${ours};$<BUILD_INTERFACE:${links}>;$<INSTALL_INTERFACE:${theirs}>")

  file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
  string(REGEX REPLACE "^sdk/" "" folder ${folder})
  install(FILES ${ARGN} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/spherecloud/${folder} COMPONENT drivers)

  get_property(libraries GLOBAL PROPERTY SPHC_DRIVER_LIBRARIES)
  list(PREPEND libraries ${target})
  list(APPEND libraries ${theirs})
  set_property(GLOBAL PROPERTY SPHC_DRIVER_LIBRARIES ${libraries})
endfunction()

# sphc_linker_flags(OUT NAMES...): libraries in a line of pkg-config.
function(sphc_linker_flags out)
  set(names ${ARGN})
  list(REMOVE_DUPLICATES names)
  list(TRANSFORM names REPLACE "^([^-].*)$" "-l\\1")
  list(JOIN names " " flags)
  set(${out} ${flags} PARENT_SCOPE)
endfunction()

# sphc_install_pc(NAME COMPONENT)
function(sphc_install_pc name component)
  configure_file(${SPHC_INSTALL_FILES}/${name}.pc.in ${PROJECT_BINARY_DIR}/install/${name}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/install/${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT ${component})
endfunction()

# sphc_install_package(): what describes the rest, once all is declared.
function(sphc_install_package)
  include(CMakePackageConfigHelpers)
  get_property(components GLOBAL PROPERTY SPHC_INSTALLED_COMPONENTS)
  list(REMOVE_DUPLICATES components)
  foreach(component ${components})
    sphc_development(development ${component})
    install(EXPORT SphereCloud-${component} NAMESPACE SphereCloud:: DESTINATION ${SPHC_INSTALL_CMAKEDIR}
      COMPONENT ${development})
  endforeach()
  set(description ${PROJECT_BINARY_DIR}/install/SphereCloudConfigVersion.cmake)
  write_basic_package_version_file(${description} VERSION ${PROJECT_VERSION} COMPATIBILITY SameMajorVersion)
  install(FILES ${SPHC_INSTALL_FILES}/SphereCloudConfig.cmake ${description} DESTINATION ${SPHC_INSTALL_CMAKEDIR}
    COMPONENT development)

  # From the prefix, wherever that is moved to; a folder that is told in full stays where it is.
  cmake_path(APPEND pc_libdir "\${prefix}" ${CMAKE_INSTALL_LIBDIR})
  cmake_path(APPEND pc_includedir "\${prefix}" ${CMAKE_INSTALL_INCLUDEDIR})
  set(to_prefix ${CMAKE_INSTALL_PREFIX})
  if(NOT IS_ABSOLUTE ${CMAKE_INSTALL_LIBDIR})
    file(RELATIVE_PATH to_prefix /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
    string(REGEX REPLACE "/$" "" to_prefix ${to_prefix})
    string(PREPEND to_prefix "\${pcfiledir}/")
  endif()
  set(of_cxx ${CMAKE_CXX_IMPLICIT_LINK_LIBRARIES}) # what a C compiler does not link by itself
  list(REMOVE_ITEM of_cxx ${CMAKE_C_IMPLICIT_LINK_LIBRARIES})
  sphc_linker_flags(runtime_libraries ${SPHC_HWY_LIBRARIES} ${of_cxx})
  set(highway_folder) # where no linker looks by itself
  if(SPHC_HWY_LIBDIR AND NOT CMAKE_CROSSCOMPILING AND NOT SPHC_HWY_LIBDIR IN_LIST CMAKE_CXX_IMPLICIT_LINK_DIRECTORIES)
    set(highway_folder "-L${SPHC_HWY_LIBDIR} ")
  endif()
  sphc_install_pc(spherecloud development)
  sphc_install_pc(spherecloud-signature signature)
  sphc_install_pc(spherecloud-encryption encryption)
  if("drivers" IN_LIST components)
    get_property(libraries GLOBAL PROPERTY SPHC_DRIVER_LIBRARIES)
    sphc_linker_flags(driver_libraries ${libraries} ${of_cxx})
    sphc_install_pc(spherecloud-drivers drivers)
    install(DIRECTORY ${PROJECT_SOURCE_DIR}/examples DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT drivers
      PATTERN quickstart.sh EXCLUDE) # of the tree
  endif()

  install(DIRECTORY ${PROJECT_SOURCE_DIR}/sdk/include/spherecloud TYPE INCLUDE COMPONENT development)
  # Where Debian's Python looks, so it is for Debian's package alone; docs/python.md has the ways for all others.
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/bindings/python/spherecloud DESTINATION lib/python3/dist-packages COMPONENT python
    EXCLUDE_FROM_ALL FILES_MATCHING PATTERN "*.py" PATTERN py.typed PATTERN __pycache__ EXCLUDE)
  # One of them all: packages of the others depend on this one.
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/NOTICE ${PROJECT_SOURCE_DIR}/CHANGELOG.md TYPE DOC COMPONENT runtime)
  # The pages that headers, help texts and messages name.  Some recipes bring the sources without them.
  if(EXISTS ${PROJECT_SOURCE_DIR}/docs)
    install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT documentation)
  endif()
  # Of those that have the code; each in a folder of its own, since two packages may not bring one file.
  set(has_lzfse drivers host)
  if(NOT TARGET sphc_lzfse)
    set(has_lzfse)
  endif()
  foreach(component ${has_lzfse})
    if(component IN_LIST components)
      install(FILES ${PROJECT_SOURCE_DIR}/third_party/lzfse/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR}/${component}
        RENAME LICENSE.lzfse COMPONENT ${component})
    endif()
  endforeach()
  if(PROJECT_IS_TOP_LEVEL)
    add_custom_target(uninstall VERBATIM
      COMMAND ${CMAKE_COMMAND} -DBUILD=${PROJECT_BINARY_DIR} -P ${SPHC_INSTALL_FILES}/uninstall.cmake)
    include(SphcSbom)
    set(SPHC_SBOM ${SPHC_SBOM} PARENT_SCOPE) # for its test
    include(SphcPackages)
  endif()
endfunction()
