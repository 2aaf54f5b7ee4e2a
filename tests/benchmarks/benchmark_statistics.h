// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace pcl_gpf::benchmark_statistics {

/** \brief Middle value; mean of the two middle ones of an even number. \param[in] values not empty */
inline double
median(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

/** \brief Slope of the least-squares line of log y over log x. \param[in] x, y as many, at least two different x, all > 0 */
inline double
logarithmicSlope(const std::vector<double>& x, const std::vector<double>& y)
{
  const double count = static_cast<double>(x.size());
  double mean_x = 0, mean_y = 0, xx = 0, xy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    mean_x += std::log(x[i]) / count;
    mean_y += std::log(y[i]) / count;
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double offset = std::log(x[i]) - mean_x;
    xx += offset * offset;
    xy += offset * (std::log(y[i]) - mean_y);
  }
  return xy / xx;
}

} // namespace pcl_gpf::benchmark_statistics
