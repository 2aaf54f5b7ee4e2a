# SPDX-License-Identifier: BSD-3-Clause
install(TARGETS pcl_gpf_core pcl_gpf EXPORT pcl_gpf-targets)
