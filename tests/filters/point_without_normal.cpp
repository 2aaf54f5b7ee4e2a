// SPDX-License-Identifier: BSD-3-Clause
// Must not compile, and the compiler must say why.
#include <pcl_gpf/filters/gpf.h>

#include <pcl/point_types.h>

pcl_gpf::GPF<pcl::PointXYZ> gpf;
