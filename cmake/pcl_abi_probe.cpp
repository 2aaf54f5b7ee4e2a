// SPDX-License-Identifier: BSD-3-Clause
// Compiled while CMake configures; the settings are read from the strings in the binary (PclGpfPclAbi.cmake).
#include <Eigen/Core>

#define PCL_GPF_TEXT_(x) #x
#define PCL_GPF_TEXT(x) PCL_GPF_TEXT_(x)

extern const char pcl_gpf_abi_probe[];
const char pcl_gpf_abi_probe[] =
  "pcl_gpf:DEFAULT_ALIGN_BYTES=" PCL_GPF_TEXT(EIGEN_DEFAULT_ALIGN_BYTES) " "
  "pcl_gpf:MAX_STATIC_ALIGN_BYTES=" PCL_GPF_TEXT(EIGEN_MAX_STATIC_ALIGN_BYTES) " "
  "pcl_gpf:MALLOC_ALREADY_ALIGNED=" PCL_GPF_TEXT(EIGEN_MALLOC_ALREADY_ALIGNED) " ";
