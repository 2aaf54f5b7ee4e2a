// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/** \brief The point types that the library is compiled for; define PCL_NO_PRECOMPILE before any PCL header to use
 * another. */
#define PCL_GPF_POINT_TYPES (pcl::PointNormal)(pcl::PointXYZRGBNormal)(pcl::PointXYZINormal)(pcl::PointXYZLNormal)
