# `cmake --install`, and what find_package(lightcuts) and pkg-config read afterwards. The Embree adapter is a component
# of its own, so that a user of the headers alone needs no Embree.
include(CMakePackageConfigHelpers)

set(package_directory ${CMAKE_INSTALL_DATADIR}/cmake/lightcuts)

install(TARGETS lightcuts EXPORT lightcuts-targets)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/lightcuts DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        FILES_MATCHING PATTERN "*.hpp" PATTERN adapt EXCLUDE)
install(EXPORT lightcuts-targets NAMESPACE lightcuts:: DESTINATION ${package_directory})
if(TARGET lightcuts_embree)
  install(TARGETS lightcuts_embree EXPORT lightcuts-embree-targets)
  install(FILES ${PROJECT_SOURCE_DIR}/include/lightcuts/adapt/embree.hpp
          DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/lightcuts/adapt)
  install(EXPORT lightcuts-embree-targets NAMESPACE lightcuts:: DESTINATION ${package_directory})
endif()

configure_package_config_file(
  ${CMAKE_CURRENT_LIST_DIR}/lightcuts-config.cmake.in ${PROJECT_BINARY_DIR}/lightcuts-config.cmake
  INSTALL_DESTINATION ${package_directory}
)
write_basic_package_version_file(
  ${PROJECT_BINARY_DIR}/lightcuts-config-version.cmake COMPATIBILITY SameMinorVersion ARCH_INDEPENDENT
)
install(
  FILES ${PROJECT_BINARY_DIR}/lightcuts-config.cmake ${PROJECT_BINARY_DIR}/lightcuts-config-version.cmake
        ${CMAKE_CURRENT_LIST_DIR}/glm.cmake
  DESTINATION ${package_directory}
)

# For builds without CMake. Paths start from where the file lies, so that an installation may be moved.
file(RELATIVE_PATH lightcuts_pc_include ${CMAKE_INSTALL_FULL_DATAROOTDIR}/pkgconfig ${CMAKE_INSTALL_FULL_INCLUDEDIR})
# Not every package of GLM comes with a glm.pc.
find_file(LIGHTCUTS_GLM_PC glm.pc PATH_SUFFIXES share/pkgconfig lib/pkgconfig lib64/pkgconfig)
mark_as_advanced(LIGHTCUTS_GLM_PC)
set(lightcuts_pc_requires "")
if(LIGHTCUTS_GLM_PC)
  set(lightcuts_pc_requires "Requires: glm\n")
endif()
configure_file(${CMAKE_CURRENT_LIST_DIR}/lightcuts.pc.in ${PROJECT_BINARY_DIR}/lightcuts.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/lightcuts.pc DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/pkgconfig)

# Where Debian looks for licences; CMAKE_INSTALL_DOCDIR would be named after a parent project.
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/lightcuts)
