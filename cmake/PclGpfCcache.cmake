# SPDX-License-Identifier: BSD-3-Clause
# The presets turn PCL_GPF_CCACHE on: ccache is used when it is there, and not missed when it is not.
option(PCL_GPF_CCACHE "Compile through ccache when it is installed" OFF)
if(PCL_GPF_CCACHE AND PROJECT_IS_TOP_LEVEL AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  find_program(PCL_GPF_CCACHE_PROGRAM ccache)
  mark_as_advanced(PCL_GPF_CCACHE_PROGRAM)
  if(PCL_GPF_CCACHE_PROGRAM)
    set(CMAKE_CXX_COMPILER_LAUNCHER "${PCL_GPF_CCACHE_PROGRAM}")
  endif()
endif()
