// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/common/point_types.h>
#include <pcl_gpf/filters/impl/normal_orientation.hpp>

#include <pcl/impl/instantiate.hpp>
#include <pcl/point_types.h>

PCL_INSTANTIATE(NormalOrientation, PCL_GPF_POINT_TYPES)
