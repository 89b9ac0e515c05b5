# What `cmake --install` puts into a folder, so that find_package(morepro) and pkg-config find it there.
option(MOREPRO_INSTALL "Install rules of the library" ${PROJECT_IS_TOP_LEVEL})
if(NOT MOREPRO_INSTALL)
  return()
endif()
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/morepro")
set(templates "${PROJECT_SOURCE_DIR}/toolchains/package")

file(GLOB c_headers CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/lib/c/*.h")
install(FILES ${c_headers} TYPE INCLUDE)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/lib" "${PROJECT_SOURCE_DIR}/hal"
  DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/morepro" FILES_MATCHING PATTERN "*.hpp" PATTERN lib/c EXCLUDE)

# Two files, because a program in C needs no Eigen.
foreach(component c monitor)
  install(TARGETS morepro_${component} EXPORT morepro_${component} ARCHIVE)
  install(EXPORT morepro_${component} NAMESPACE morepro:: DESTINATION "${package_dir}")
endforeach()

configure_package_config_file("${templates}/morepro-config.cmake.in" morepro-config.cmake
  INSTALL_DESTINATION "${package_dir}" NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file("${CMAKE_CURRENT_BINARY_DIR}/morepro-config-version.cmake"
  COMPATIBILITY SameMinorVersion)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/morepro-config.cmake"
  "${CMAKE_CURRENT_BINARY_DIR}/morepro-config-version.cmake" DESTINATION "${package_dir}")

file(RELATIVE_PATH prefix_from_pc "/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/")
string(REGEX REPLACE "/$" "" prefix_from_pc "${prefix_from_pc}")
configure_file("${templates}/morepro.pc.in" morepro.pc @ONLY)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/morepro.pc" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig")
