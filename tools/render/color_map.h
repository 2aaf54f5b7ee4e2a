// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "image.h"

namespace pcl_gpf {

/** \brief Viridis: dark violet for 0 over green to yellow for 1; values outside are clamped, NaN is grey. */
Color
mapColor(double value);

} // namespace pcl_gpf
