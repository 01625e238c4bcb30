# `cmake --install`, and what find_package(lightcuts) reads afterwards. The Embree adapter is a component of its
# own, so that a user of the headers alone needs no Embree.
include(CMakePackageConfigHelpers)

set(package_directory ${CMAKE_INSTALL_DATADIR}/cmake/lightcuts)

install(TARGETS lightcuts EXPORT lightcuts-targets FILE_SET HEADERS)
install(EXPORT lightcuts-targets NAMESPACE lightcuts:: DESTINATION ${package_directory})
if(TARGET lightcuts_embree)
  install(TARGETS lightcuts_embree EXPORT lightcuts-embree-targets FILE_SET HEADERS)
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
