// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/surface/impl/marching_cubes_rimls.hpp>

#include <pcl/impl/instantiate.hpp>
#include <pcl/point_types.h>

// The point types that PCL compiles its marching cubes for.
PCL_INSTANTIATE(MarchingCubesRIMLS, (pcl::PointNormal)(pcl::PointXYZRGBNormal)(pcl::PointXYZINormal))
