// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/operators/outlier_probability.h>
#include <pcl_gpf/core/parallel.h>

#include "../check_range.h"
#include "../sorted_points.h"

#include <algorithm>
#include <cmath>

namespace pcl_gpf {

namespace {

constexpr double kPi = 3.14159265358979323846;
/** Radius in which support is counted: most of the noise, at least a few neighbours, and no more than are needed to
 * tell. */
constexpr double kBallNoises = 2.5, kLeastBallSpacings = 3.0, kMostBallSpacings = 8.0;
/** Width of the surface component: the noise and what its estimate and the surface may be wrong by. Beside sharp edges
 * the filter itself moves points by up to a spacing. */
constexpr double kNoiseMargin = 1.25, kLeastWidthSpacings = 0.5;
/** Standard deviations by which support must exceed what outliers leave there. */
constexpr double kSignificance = 2.0;

/** What all points have in common. */
struct Mixture {
  explicit Mixture(const OutlierProbabilityParameters& p)
  : ball(std::min(std::max(kBallNoises * p.noise, kLeastBallSpacings * p.spacing), kMostBallSpacings * p.spacing))
  , width(std::max(kNoiseMargin * p.noise, kLeastWidthSpacings * p.spacing))
  {
    // a filter narrower than the spacing does not make outliers of all points
    const double spread = std::max(p.data_radius, ball);
    const double expected = kPi * spread * spread / (p.spacing * p.spacing);
    uniform = p.outlier_weight * expected / (4.0 / 3.0 * kPi * std::pow(spread, 3));
    const double background = uniform * 4.0 / 3.0 * kPi * std::pow(ball, 3);
    threshold = background + kSignificance * std::sqrt(background);
    // Mean cross-section of the ball under the noise: turns a number of points into one per area.
    const double sigma = std::max(p.noise, 1e-6 * ball), reach = ball / sigma;
    area = kPi * ((ball * ball - sigma * sigma) * std::erf(reach * std::sqrt(0.5)) +
                  ball * sigma * std::sqrt(2.0 / kPi) * std::exp(-0.5 * reach * reach));
  }

  /** \param[in] support input points in the ball but the point's own */
  double
  probability(double support, double move) const
  {
    if (!(uniform > 0.0))
      return 0.0;
    const double scaled = move / width;
    const double surface =
        std::max(0.0, support - threshold) / area * std::exp(-0.5 * scaled * scaled) / (width * std::sqrt(2.0 * kPi));
    return uniform / (uniform + surface);
  }

  double ball, width;
  double uniform = 0.0, threshold = 0.0, area = 1.0;
};

/** Input points in the ball about each of the queries, which are sorted. \param[out] unused room for as many floats */
AlignedArray<float>
countData(const PointIndex& data, const SoaBuffer& queries, double radius, std::size_t threads, float* unused)
{
  const PointsView points = data.sorted();
  AlignedArray<float> count(queries.size() + kQueryBlock);
  kernels::FieldSums a;
  a.queries = {queries.x.data(), queries.y.data(), queries.z.data()};
  a.data = {points.x, points.y, points.z};
  a.radius.radius_sq = static_cast<float>(radius * radius);
  a.first_field = a.second_field = points.x; // any: only the count is wanted
  a.count = count.data();
  a.weight_sum = a.first_sum = a.second_sum = unused;
  const Neighborhoods near = findNeighborhoods(data.tree(), queries.view(), radius, threads);
  const kernels::Candidates candidates = candidatesOf(near);
  parallelBlocks(blockCount(queries.size()), kBlocksPerTask, threads,
                 [&](std::size_t begin, std::size_t end) { kernels::active().field_sums(candidates, a, begin, end); });
  return count;
}

double
lengthOfPath(PointsView p)
{
  double length = 0.0;
  for (std::size_t k = 1; k < p.size; ++k)
    length += std::hypot(p.x[k] - p.x[k - 1], p.y[k] - p.y[k - 1], p.z[k] - p.z[k - 1]);
  return length;
}

/** Whether places that are next to each other in memory are so in space, as in the order of the data. */
bool
followsCurve(const SoaBuffer& places, const PointIndex& data)
{
  constexpr double kMuchLonger = 2.0;
  return places.size() == data.size() && lengthOfPath(places.view()) < kMuchLonger * lengthOfPath(data.sorted());
}

} // namespace

std::vector<float>
outlierProbabilities(const OutlierProbabilityParameters& p, const PointIndex& data, const SoaBuffer& filtered,
                     const float* moves)
{
  checkRange("noise", p.noise, p.noise >= 0.0, ">= 0");
  checkRange("spacing", p.spacing, p.spacing > 0.0, "> 0");
  checkRange("data_radius", p.data_radius, p.data_radius > 0.0, "> 0");
  checkRange("outlier_weight", p.outlier_weight, p.outlier_weight >= 0.0 && p.outlier_weight < 1.0, ">= 0 and < 1");
  if (filtered.size() == 0)
    return {};
  std::vector<float> probabilities(filtered.size() + kQueryBlock); // first holds what the kernel sums beside the count
  const std::size_t threads = resolveThreads(p.number_of_threads);
  const Mixture mixture(p);
  const double ball = boundedRadius(mixture.ball);
  std::vector<std::uint32_t> order; // empty: as they are
  if (!followsCurve(filtered, data))
    order = hilbertOrder(filtered.view(), threads);
  const AlignedArray<float> count =
      order.empty() ? countData(data, filtered, ball, threads, probabilities.data())
                    : countData(data, elementsOf(filtered.view(), order), ball, threads, probabilities.data());
  for (std::size_t k = 0; k < filtered.size(); ++k) {
    const std::size_t place = order.empty() ? k : order[k];
    const double move = moves[place];
    const double own = move < ball ? 1.0 : 0.0;
    probabilities[place] = static_cast<float>(mixture.probability(count[k] - own, move));
  }
  probabilities.resize(filtered.size());
  return probabilities;
}

} // namespace pcl_gpf
