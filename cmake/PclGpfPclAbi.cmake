# SPDX-License-Identifier: BSD-3-Clause
# Writes pcl_gpf/common/pcl_abi.h: how Eigen allocates and aligns in the PCL that was found. Only the flags that PCL
# itself exports count, not those of this build, because the header describes a binary that exists already.
# pcl_gpf/common/abi_check.h compares every program with it.
function(pcl_gpf_probe_pcl_abi)
  set(CMAKE_CXX_FLAGS "")
  set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
  get_target_property(include_dirs pcl_common INTERFACE_INCLUDE_DIRECTORIES)
  list(REMOVE_DUPLICATES include_dirs)
  set(probe "${PROJECT_BINARY_DIR}/CMakeFiles/pcl_abi_probe")
  try_compile(probed "${probe}" SOURCES "${PROJECT_SOURCE_DIR}/cmake/pcl_abi_probe.cpp"
    CMAKE_FLAGS "-DINCLUDE_DIRECTORIES=${include_dirs}"
    COMPILE_DEFINITIONS ${PCL_COMPILE_OPTIONS}
    CXX_STANDARD 17
    COPY_FILE "${probe}.bin"
    OUTPUT_VARIABLE log)
  if(NOT probed)
    message(FATAL_ERROR "pcl_gpf: Eigen, as PCL uses it, does not compile:\n${log}")
  endif()
  foreach(name IN ITEMS DEFAULT_ALIGN_BYTES MAX_STATIC_ALIGN_BYTES MALLOC_ALREADY_ALIGNED)
    file(STRINGS "${probe}.bin" line REGEX "pcl_gpf:${name}=[0-9]+ " LIMIT_COUNT 1)
    if(NOT line MATCHES "pcl_gpf:${name}=([0-9]+) ")
      message(FATAL_ERROR "pcl_gpf: EIGEN_${name} of PCL could not be determined.")
    endif()
    set(PCL_GPF_PCL_EIGEN_${name} ${CMAKE_MATCH_1} CACHE INTERNAL "EIGEN_${name} in the PCL that was found")
  endforeach()
endfunction()

if(NOT DEFINED PCL_GPF_PCL_EIGEN_MALLOC_ALREADY_ALIGNED)
  pcl_gpf_probe_pcl_abi()
endif()
configure_file(cmake/pcl_abi.h.in include/pcl_gpf/common/pcl_abi.h @ONLY)
