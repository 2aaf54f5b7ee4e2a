// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/common/pcl_abi.h>

#include <Eigen/Core>

/** \file
  * \brief Refuses, at compile time, flags with which a program cannot exchange point clouds with the PCL binary.
  *
  * Eigen chooses its alignment and its way of calling malloc from the compiler's flags. With `-mavx` or
  * `-march=native` a cloud is allocated in one way here and freed in another way in libpcl (or the reverse), which ends
  * in "double free or corruption" and other memory errors; other alignments also change the layout of PCL's classes,
  * which gives wrong results in silence. AddressSanitizer under GCC changes the allocation in the same way.
  * Every header of pcl_gpf that shows a PCL type includes this one. A check of the layout is all it is: it defines
  * nothing but PCL_GPF_ABI_CHECKED and costs nothing at run time.
  *
  * \note Cures, best first: compile the files that include PCL without these flags, or with `-mno-avx` after
  * `-march=native`; build PCL and pcl_gpf from source with the same flags. `-DEIGEN_MAX_ALIGN_BYTES=16` alone is not
  * one: Eigen's default alignment stays 32, and with it the other way of allocating. pcl_gpf chooses its own
  * instruction set at run time, so it gains nothing from these flags.
  * \note With `-DPCL_GPF_ALLOW_AVX_WITH_PCL` the check is left out, at your own risk.
  */
#define PCL_GPF_ABI_CHECKED 1

#if !defined(PCL_GPF_ALLOW_AVX_WITH_PCL) && \
  (EIGEN_DEFAULT_ALIGN_BYTES != PCL_GPF_PCL_EIGEN_DEFAULT_ALIGN_BYTES || \
   EIGEN_MAX_STATIC_ALIGN_BYTES != PCL_GPF_PCL_EIGEN_MAX_STATIC_ALIGN_BYTES || \
   EIGEN_MALLOC_ALREADY_ALIGNED != PCL_GPF_PCL_EIGEN_MALLOC_ALREADY_ALIGNED)
#if defined(__SANITIZE_ADDRESS__) && !EIGEN_MALLOC_ALREADY_ALIGNED
#error "pcl_gpf: with -fsanitize=address Eigen allocates in another way than the installed PCL (bad free). \
Cure: add -DEIGEN_MALLOC_ALREADY_ALIGNED=1."
#elif defined(__AVX__)
#error "pcl_gpf: this file is compiled with AVX (-march=native or -mavx...), the installed PCL is not; \
clouds that cross the border between them corrupt memory (double free). \
Cure: drop that flag for files that include PCL, or add -mno-avx after it, or build PCL and pcl_gpf with it too."
#else
#error "pcl_gpf: Eigen's alignment differs from that of the installed PCL, so classes have another layout here. \
Cure: remove the flags and EIGEN_... macros that change it, or build PCL and pcl_gpf with them too."
#endif
#endif
