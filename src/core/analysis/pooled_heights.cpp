// SPDX-License-Identifier: BSD-3-Clause
#include "pooled_heights.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace pcl_gpf {

namespace {

constexpr double kPi = 3.14159265358979323846;
/** Densities are cosine series: their period in standard deviations, and the terms. */
constexpr double kHalfPeriod = 6.0;
constexpr std::size_t kTerms = 48;
/** Directions of planes, as ratios of the extents of even noise along them: from along an axis to along the diagonal. */
constexpr double kDirections[][3] = {{1, 0, 0},     {1, .1, .05}, {1, .2, .1},  {1, .3, .1},   {1, .3, .3}, {1, .5, 0}, {1, .5, .3},
                                     {1, .5, .5},   {1, .75, 0},  {1, .75, .4}, {1, .75, .75}, {1, 1, 0},   {1, 1, .5}, {1, 1, 1}};
constexpr double kLeastShare = 0.05, kMostShare = 0.86, kShareStep = 0.05;
constexpr double kLeastScale = 0.9, kMostScale = 1.13, kScaleStep = 0.02;

using Series = std::array<double, kTerms>;
using Histogram = std::array<double, kHeightBins>;

double
sinc(double x)
{
  return std::abs(x) < 1e-6 ? 1.0 : std::sin(x) / x;
}

/** Characteristic function of noise of variance 1: normal, or even along three axes and seen along `direction`. */
double
characteristic(const double* direction, double k)
{
  if (!direction)
    return std::exp(-0.5 * k * k);
  const double length = std::hypot(direction[0], direction[1], direction[2]);
  double product = 1.0;
  for (int axis = 0; axis < 3; ++axis)
    product *= sinc(std::sqrt(3.0) * direction[axis] / length * k);
  return product;
}

/** Of the heights above fitted patches, which follow `leverage` of each point's own height. */
Series
seriesOf(const double* direction, double share, double leverage)
{
  Series series;
  const double kept = 1.0 - leverage;
  for (std::size_t m = 0; m < kTerms; ++m) {
    const double k = static_cast<double>(m + 1) * kPi / kHalfPeriod;
    series[m] = characteristic(direction, k * kept * std::sqrt(1.0 - share)) * std::cos(k * kept * std::sqrt(share)) *
                std::exp(-0.5 * k * k * leverage * kept);
  }
  return series;
}

/** Integrals of the terms over the bins, for densities that are stretched by a scale. */
class BinTable {
public:
  explicit BinTable(double scale)
  {
    for (std::size_t bin = 0; bin < kHeightBins; ++bin) {
      const double from = edge(bin) / scale, to = edge(bin + 1) / scale;
      constant_[bin] = (to - from) / kHalfPeriod;
      for (std::size_t m = 0; m < kTerms; ++m) {
        const double k = static_cast<double>(m + 1) * kPi / kHalfPeriod;
        terms_[bin][m] = 2.0 / (kHalfPeriod * k) * (std::sin(k * to) - std::sin(k * from));
      }
    }
  }
  /** Shares of the bins. */
  Histogram
  of(const Series& series) const
  {
    Histogram shares;
    double sum = 0.0;
    for (std::size_t bin = 0; bin < kHeightBins; ++bin) {
      double share = constant_[bin];
      for (std::size_t m = 0; m < kTerms; ++m)
        share += terms_[bin][m] * series[m];
      sum += shares[bin] = std::max(share, 0.0) + 1e-9;
    }
    for (double& share : shares)
      share /= sum;
    return shares;
  }

private:
  static double
  edge(std::size_t bin)
  {
    return kPooledHeight * static_cast<double>(bin) / kHeightBins;
  }
  std::array<double, kHeightBins> constant_;
  std::array<Series, kHeightBins> terms_;
};

/** Logarithm of the likelihood for each height of the likeliest mixture of some shapes and points anywhere. */
double
mixtureLikelihood(const Histogram& seen, const std::vector<Histogram>& shapes, int rounds)
{
  constexpr double kAnywhere = 1.0 / kHeightBins;
  std::vector<double> weights(shapes.size() + 1, 1.0 / static_cast<double>(shapes.size() + 1));
  if (shapes.size() == 1)
    weights = {0.97, 0.03};
  Histogram mixture{};
  for (int round = 0;; ++round) {
    for (std::size_t bin = 0; bin < kHeightBins; ++bin) {
      mixture[bin] = weights.back() * kAnywhere;
      for (std::size_t shape = 0; shape < shapes.size(); ++shape)
        mixture[bin] += weights[shape] * shapes[shape][bin];
    }
    if (round == rounds)
      break;
    Histogram ratio;
    double anywhere = 0.0;
    for (std::size_t bin = 0; bin < kHeightBins; ++bin) {
      ratio[bin] = seen[bin] / mixture[bin];
      anywhere += kAnywhere * ratio[bin];
    }
    double total = weights.back() *= anywhere * anywhere; // squares: steps of twice the length
    for (std::size_t shape = 0; shape < shapes.size(); ++shape) {
      double sum = 0.0;
      for (std::size_t bin = 0; bin < kHeightBins; ++bin)
        sum += shapes[shape][bin] * ratio[bin];
      total += weights[shape] *= sum * sum;
    }
    for (double& weight : weights)
      weight /= total;
  }
  double likelihood = 0.0;
  for (std::size_t bin = 0; bin < kHeightBins; ++bin)
    if (seen[bin] > 0.0)
      likelihood += seen[bin] * std::log(mixture[bin]);
  return likelihood;
}

struct TwoSheets {
  double share;
  Series series;
};

} // namespace

SheetsFit
fitSheets(const HeightCounts& counts, double points_per_patch)
{
  constexpr int kMixtureRounds = 40, kSingleRounds = 8;
  SheetsFit fit;
  double sum = 0.0;
  for (const double count : counts)
    sum += count;
  if (!(sum > 0.0))
    return fit;
  Histogram seen = counts;
  for (double& share : seen)
    share /= sum;
  const double leverage = 6.0 / points_per_patch;
  std::vector<Series> even;
  std::vector<TwoSheets> two;
  for (double share = kLeastShare; share < kMostShare; share += kShareStep)
    two.push_back({share, seriesOf(nullptr, share, leverage)});
  for (const auto& direction : kDirections) {
    even.push_back(seriesOf(direction, 0.0, leverage));
    if (even.size() % 2 == 1)
      for (double share = kLeastShare; share < kMostShare; share += kShareStep)
        two.push_back({share, seriesOf(direction, share, leverage)});
  }
  const Series normal = seriesOf(nullptr, 0.0, leverage);
  double one = -std::numeric_limits<double>::infinity(), best = one;
  for (double scale = kLeastScale; scale < kMostScale; scale += kScaleStep) {
    const BinTable table(scale);
    std::vector<Histogram> shapes;
    for (const Series& series : even) {
      shapes.push_back(table.of(series));
      one = std::max(one, mixtureLikelihood(seen, {shapes.back()}, kSingleRounds));
    }
    one = std::max({one, mixtureLikelihood(seen, shapes, kMixtureRounds), mixtureLikelihood(seen, {table.of(normal)}, kSingleRounds)});
    for (const TwoSheets& sheets : two) {
      const double likelihood = mixtureLikelihood(seen, {table.of(sheets.series)}, kSingleRounds);
      if (likelihood > best) {
        best = likelihood;
        fit.share = sheets.share;
        fit.deviation = scale * std::sqrt(1.0 - sheets.share);
      }
    }
  }
  fit.gain = best - one;
  return fit;
}

} // namespace pcl_gpf
