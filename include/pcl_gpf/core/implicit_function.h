// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/views.h>

#include <cstdint>
#include <functional>

namespace pcl_gpf {

/** \brief What an implicit function writes, one entry a position; arrays may be null where a value is not wanted. */
struct ImplicitValues {
  float* value = nullptr;         ///< f, about a signed distance near the surface, positive outside; NaN where it is not defined
  MutableVectorsView gradient;    ///< grad f; 0 where f is not defined
  std::uint8_t* inside = nullptr; ///< 1 where f is defined
};

/** \brief A function whose zero set is a surface, evaluated at many positions at once. The value at a position must not depend on the
 * others. Called from one thread at a time. */
using ImplicitFunction = std::function<void(PointsView positions, const ImplicitValues& values)>;

} // namespace pcl_gpf
