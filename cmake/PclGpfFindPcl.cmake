# SPDX-License-Identifier: BSD-3-Clause
# Finds PCL for the library's build and, installed beside the package configuration, for its users.
#
# PCL's own configuration ties the components features, surface and io to all of VTK, Qt and MPI, which then needs the
# language C and puts Qt's macros on every command line, although the library pcl_features uses none of them. So only
# the components without that burden are taken from there, and pcl_gpf_find_pcl_library() makes a plain target for
# the others.
include(CMakeFindDependencyMacro)
find_dependency(PCL 1.13 COMPONENTS common search kdtree filters)

# pcl_gpf_find_pcl_library(<component>): the imported target pcl_gpf::pcl_<component>.
function(pcl_gpf_find_pcl_library component)
  if(TARGET pcl_gpf::pcl_${component})
    return()
  endif()
  find_library(PCL_GPF_PCL_${component} NAMES pcl_${component} HINTS ${PCL_LIBRARY_DIRS})
  mark_as_advanced(PCL_GPF_PCL_${component})
  if(NOT PCL_GPF_PCL_${component})
    message(FATAL_ERROR "pcl_gpf: the library pcl_${component} was not found beside PCL ${PCL_VERSION} (${PCL_DIR}).")
  endif()
  add_library(pcl_gpf::pcl_${component} UNKNOWN IMPORTED)
  set_target_properties(pcl_gpf::pcl_${component} PROPERTIES
    IMPORTED_LOCATION "${PCL_GPF_PCL_${component}}"
    INTERFACE_LINK_LIBRARIES "pcl_filters;pcl_search;pcl_kdtree;pcl_common")
endfunction()

if(PCL_FOUND)
  pcl_gpf_find_pcl_library(features)
  pcl_gpf_find_pcl_library(surface)
endif()
