// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/analysis/metrics.h>
#include <pcl_gpf/core/errors.h>

#include <algorithm>
#include <limits>
#include <string>

namespace pcl_gpf {
namespace {

/** \brief Percentile by linear interpolation between ranks; reorders `values`, which is not empty. */
double
percentile(std::vector<double>& values, double fraction)
{
  const double rank = fraction * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(rank);
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(below);
  std::nth_element(values.begin(), at, values.end());
  const double low = *at;
  if (below + 1 == values.size())
    return low;
  const double high = *std::min_element(at + 1, values.end());
  return low + (rank - static_cast<double>(below)) * (high - low);
}

} // namespace

DistanceSummary
summarizeDistances(const std::vector<double>& distances)
{
  DistanceSummary summary;
  std::vector<double> magnitudes;
  magnitudes.reserve(distances.size());
  double sum = 0;
  for (const double distance : distances) {
    if (!std::isfinite(distance))
      continue;
    sum += distance;
    magnitudes.push_back(std::abs(distance));
  }
  summary.count = magnitudes.size();
  summary.left_out = distances.size() - magnitudes.size();
  if (magnitudes.empty())
    return summary;

  summary.max = *std::max_element(magnitudes.begin(), magnitudes.end());
  double sum_magnitudes = 0;
  double sum_squares = 0; // of d / max, so that nothing overflows
  for (const double magnitude : magnitudes) {
    sum_magnitudes += magnitude;
    const double ratio = summary.max > 0 ? magnitude / summary.max : 0;
    sum_squares += ratio * ratio;
  }
  const auto count = static_cast<double>(summary.count);
  summary.mean = sum_magnitudes / count;
  summary.signed_mean = sum / count;
  summary.rms = summary.max * std::sqrt(sum_squares / count);
  summary.p95 = percentile(magnitudes, 0.95);
  return summary;
}

std::vector<double>
rowDistances(const std::vector<Position>& a, const std::vector<Position>& b)
{
  if (a.size() != b.size())
    throw InvalidParameter("row by row distances need as many points on both sides; there are " +
                           std::to_string(a.size()) + " and " + std::to_string(b.size()));
  std::vector<double> distances(a.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < a.size(); ++i)
    if (isMeasurable(a[i]) && isMeasurable(b[i]))
      distances[i] = length(subtract(a[i], b[i]));
  return distances;
}

} // namespace pcl_gpf
