# SPDX-License-Identifier: BSD-3-Clause
# PCL_GPF_SANITIZE applies to every target below this folder: a sanitizer on half of a program finds nothing.
if(NOT PCL_GPF_SANITIZE)
  return()
endif()
add_compile_options(-fsanitize=${PCL_GPF_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
add_link_options(-fsanitize=${PCL_GPF_SANITIZE})
add_compile_definitions(PCL_GPF_FEW_TARGETS)
if(PCL_GPF_SANITIZE MATCHES "address")
  # Eigen takes malloc for unaligned under this sanitizer and would then not fit PCL's binary (common/abi_check.h).
  add_compile_definitions(EIGEN_MALLOC_ALREADY_ALIGNED=1)
endif()
