// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#ifndef PCL_NO_PRECOMPILE
#error "a point type of one's own needs PCL_NO_PRECOMPILE before the first PCL header"
#endif

#include <pcl/impl/pcl_base.hpp>
#include <pcl/point_types.h>
#include <pcl/register_point_struct.h>

#include <cstddef>
#include <cstdint>

/** \brief A point type that the library was not compiled for. */
struct EIGEN_ALIGN16 ScannerPoint {
  PCL_ADD_POINT4D;
  PCL_ADD_NORMAL4D;
  double time = 0;
  std::uint16_t ring = 0;

  ScannerPoint() : data{0, 0, 0, 1}, data_n{0, 0, 0, 0} {}
  PCL_MAKE_ALIGNED_OPERATOR_NEW
};

POINT_CLOUD_REGISTER_POINT_STRUCT(ScannerPoint,
                                  (float, x, x)(float, y, y)(float, z, z)(float, normal_x, normal_x)(float, normal_y, normal_y)(
                                      float, normal_z, normal_z)(double, time, time)(std::uint16_t, ring, ring))

// What the contract suite calls for every point type (support/clouds.h); found beside the type.
inline void
setForeignFields(ScannerPoint& point, std::size_t i)
{
  point.time = 0.1 * static_cast<double>(i);
  point.ring = static_cast<std::uint16_t>(i);
}
inline int
numberOf(const ScannerPoint& point)
{
  return point.time == 0.1 * static_cast<double>(point.ring) ? static_cast<int>(point.ring) : -1;
}
