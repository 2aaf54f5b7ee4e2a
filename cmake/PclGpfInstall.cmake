# SPDX-License-Identifier: BSD-3-Clause
# Installs the headers, the libraries, the tool and what find_package, pkg-config and ROS need to find them.
include(CMakePackageConfigHelpers)
set(_package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/pcl_gpf")

# Two export sets, because the component core must be usable where no PCL is installed.
install(TARGETS pcl_gpf_core EXPORT pcl_gpf-core-targets)
install(TARGETS pcl_gpf EXPORT pcl_gpf-targets)
foreach(set IN ITEMS core-targets targets)
  install(EXPORT pcl_gpf-${set} FILE pcl_gpf-${set}.cmake NAMESPACE pcl_gpf:: DESTINATION "${_package_dir}")
endforeach()
if(TARGET pcl_gpf_tool)
  install(TARGETS pcl_gpf_tool)
endif()

install(DIRECTORY "${PROJECT_SOURCE_DIR}/include/pcl_gpf" "${PROJECT_BINARY_DIR}/include/pcl_gpf"
  DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" FILES_MATCHING PATTERN "*.h" PATTERN "*.hpp")

configure_package_config_file(cmake/pcl_gpf-config.cmake.in "${PROJECT_BINARY_DIR}/pcl_gpf-config.cmake"
  INSTALL_DESTINATION "${_package_dir}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/pcl_gpf-config-version.cmake"
  COMPATIBILITY SameMinorVersion)
install(FILES
  "${PROJECT_BINARY_DIR}/pcl_gpf-config.cmake"
  "${PROJECT_BINARY_DIR}/pcl_gpf-config-version.cmake"
  "${PROJECT_SOURCE_DIR}/cmake/PclGpfFindPcl.cmake"
  DESTINATION "${_package_dir}")

# The .pc files find their prefix from where they lie, so the installed tree may be moved.
file(RELATIVE_PATH _pkgconfig_to_prefix "${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig" "${CMAKE_INSTALL_PREFIX}")
string(REGEX REPLACE "/$" "" _pkgconfig_to_prefix "${_pkgconfig_to_prefix}")
foreach(name IN ITEMS pcl_gpf-core pcl_gpf)
  configure_file(cmake/${name}.pc.in ${name}.pc @ONLY)
  install(FILES "${PROJECT_BINARY_DIR}/${name}.pc" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig")
endforeach()

install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DOCDIR}")
install(FILES "${PROJECT_SOURCE_DIR}/package.xml" DESTINATION "${CMAKE_INSTALL_DATADIR}/pcl_gpf")
