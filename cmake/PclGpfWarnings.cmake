# SPDX-License-Identifier: BSD-3-Clause
# pcl_gpf_warnings: link it PRIVATE (as $<BUILD_INTERFACE:pcl_gpf_warnings>) to every target of the project.
add_library(pcl_gpf_warnings INTERFACE)
target_compile_options(pcl_gpf_warnings INTERFACE
  $<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-Wall;-Wextra;-Wconversion;-Wshadow>
  $<$<AND:$<BOOL:${PCL_GPF_WERROR}>,$<CXX_COMPILER_ID:GNU,Clang,AppleClang>>:-Werror>)
