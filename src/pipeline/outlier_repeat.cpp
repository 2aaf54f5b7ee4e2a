// SPDX-License-Identifier: BSD-3-Clause
#include "outlier_repeat.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace pcl_gpf {

namespace {

/** A second run pays when at least this share are outliers that were drawn in from afar, which is what does the harm; points that only
 * lack support may be those of a sparse part. */
constexpr double kLeastDrawnIn = 0.003, kAfarNoises = 4.0;
/** More suspects than this are no outliers. */
constexpr double kMostSuspects = 0.5;

/** Outlier probability above which a point is no data for others: one good point of many does not matter, one bad one does. */
constexpr float kSuspect = 0.1f;

bool
isSuspect(const DenoiseResult& result, std::size_t k)
{
  return result.outlier[k] > kSuspect;
}

/** Columns of some rows of an input. */
struct PartOfInput {
  PartOfInput(const DenoiseInput& input, const std::vector<std::uint32_t>& rows)
  {
    const auto take = [&rows](const auto* from, auto& to) {
      for (std::size_t k = 0; k < rows.size() && from; ++k)
        to.push_back(from[rows[k]]);
      return from ? to.data() : nullptr;
    };
    view.x = take(input.x, x);
    view.y = take(input.y, y);
    view.z = take(input.z, z);
    view.normal_x = take(input.normal_x, normal_x);
    view.normal_y = take(input.normal_y, normal_y);
    view.normal_z = take(input.normal_z, normal_z);
    view.size = rows.size();
  }

  std::vector<double> x, y, z;
  std::vector<float> normal_x, normal_y, normal_z;
  DenoiseInput view;
};

/** Puts values of the second run where their points were in the first. */
template <typename T>
void
putBack(const std::vector<T>& from, const std::vector<std::size_t>& places, std::vector<T>& to)
{
  if (from.empty())
    return;
  for (std::size_t k = 0; k < places.size(); ++k)
    to[places[k]] = from[k];
}

/** Cuts the moves of suspects to the limit of the second run. \return how many reach it */
std::size_t
limitSuspects(const DenoiseInput& input, double limit, DenoiseResult& result)
{
  std::size_t limited = 0;
  for (std::size_t k = 0; k < result.x.size(); ++k) {
    const std::size_t row = result.sample_indices[k];
    const double x = result.x[k] - input.x[row], y = result.y[k] - input.y[row], z = result.z[k] - input.z[row];
    const double length = std::hypot(x, y, z);
    if (!isSuspect(result, k) || !(length > limit * (1.0 - 1e-5)))
      continue;
    const double share = length > 0.0 ? std::min(1.0, limit / length * (1.0 - 1e-6)) : 0.0;
    const auto place = [share](double from, double move) { return move != 0.0 ? from + share * move : from; };
    result.x[k] = place(input.x[row], x);
    result.y[k] = place(input.y[row], y);
    result.z[k] = place(input.z[row], z);
    ++limited;
  }
  return limited;
}

} // namespace

bool
outliersDisturb(const DenoiseParameters& parameters, const DenoiseInput& input, const DenoiseResult& result)
{
  if (result.outlier.empty() || runsInDouble(parameters.gpf) || parameters.gpf.sample_ratio < 1.0)
    return false;
  std::size_t suspects = 0, drawn_in = 0;
  for (std::size_t k = 0; k < result.outlier.size(); ++k) {
    suspects += isSuspect(result, k);
    if (!(result.outlier[k] > DenoiseResult::kOutlier))
      continue;
    const std::size_t row = result.sample_indices[k];
    const double move = std::hypot(result.x[k] - input.x[row], result.y[k] - input.y[row], result.z[k] - input.z[row]);
    drawn_in += move > kAfarNoises * result.scale.noise;
  }
  const auto count = static_cast<double>(result.outlier.size());
  return static_cast<double>(drawn_in) > kLeastDrawnIn * count && static_cast<double>(suspects) < kMostSuspects * count;
}

DenoiseResult
repeatWithoutOutliers(const DenoiseInput& input, DenoiseResult first, const std::function<DenoiseResult(const DenoiseInput&)>& filter)
{
  std::vector<std::size_t> places;
  std::vector<std::uint32_t> rows;
  for (std::size_t k = 0; k < first.x.size(); ++k)
    if (!isSuspect(first, k)) {
      places.push_back(k);
      rows.push_back(first.sample_indices[k]);
    }
  DenoiseResult second = filter(PartOfInput(input, rows).view);
  const std::size_t suspects_limited = limitSuspects(input, second.max_iteration_move, first);
  putBack(second.x, places, first.x);
  putBack(second.y, places, first.y);
  putBack(second.z, places, first.z);
  putBack(second.normal_x, places, first.normal_x);
  putBack(second.normal_y, places, first.normal_y);
  putBack(second.normal_z, places, first.normal_z);
  putBack(second.isolated, places, first.isolated);
  putBack(second.fine, places, first.fine);
  putBack(second.outlier, places, first.outlier);
  putBack(second.sigma, places, first.sigma);
  putBack(second.edge, places, first.edge);
  first.limited_points = second.limited_points + suspects_limited;
  first.max_move = second.max_move;
  first.max_iteration_move = second.max_iteration_move;
  first.repeated = true;
  first.scale = second.scale;
  first.parameters = std::move(second.parameters);
  first.iterations = std::move(second.iterations);
  first.finest_points = second.finest_points;
  first.fine_iterations = std::move(second.fine_iterations);
  first.gap_iterations = std::move(second.gap_iterations);
  first.seconds_normals += second.seconds_normals;
  first.seconds_bilateral += second.seconds_bilateral;
  first.seconds_filter += second.seconds_filter;
  return first;
}

} // namespace pcl_gpf
