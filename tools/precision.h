// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "load_cloud.h"

#include <string>

namespace pcl_gpf {

/** \brief Whether the coordinates are fine enough for the spacing of the points.
 *
 * A float far from the origin has coarse steps: 0.5 m at 5,500,000 m, so UTM coordinates in float lose all detail. The step is the
 * distance to the next float at the largest coordinate; coordinates that came as double count when every value is one a float
 * can hold, because then they went through float before. */
struct Precision {
  enum class Verdict {
    Fine,     ///< step <= spacing / 100
    Coarse,   ///< detail below the step is lost
    Quantized ///< step > spacing / 2: the points sit on a lattice; results are meaningless
  };
  Verdict verdict = Verdict::Fine;
  double step = 0.0;         ///< largest step over the three axes, cloud units; 0 when no axis is float
  double spacing = 0.0;      ///< of the points, cloud units
  bool stored_double = false; ///< the fields are double but their values are floats
};

/** \brief Judges a cloud whose spacing is known. */
Precision
judgePrecision(const LoadedCloud& cloud, double spacing);

/** \brief "fine", "coarse" or "quantized". */
const char*
nameOf(Precision::Verdict verdict);

/** \brief The figures and the cure in one sentence. */
std::string
describe(const Precision& precision);

/** \brief Points on a float lattice look like data and are none: refused unless `force`; coarse ones get a warning.
 * \throws UnsuitableData */
void
refuseQuantized(const LoadedCloud& cloud, const CloudScale& scale, bool force, Console& console);

} // namespace pcl_gpf
