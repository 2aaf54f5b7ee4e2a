// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/operators/quadric_fit.h>

#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/parallel.h>
#include <pcl_gpf/core/point_index.h>

#include "../check_range.h"
#include "fitted_quadric.h"
#include "pooled_misfit.h"
#include "quadric_data.h"

#include <algorithm>
#include <cmath>

namespace pcl_gpf {

namespace {

/** Widest ball, in box diagonals: beyond, the sixth order draws a sphere inwards. */
constexpr double kWidest = 0.17;
/** From one radius to the next, and at least to the widest. */
const double kGrowth = std::pow(2.0, 0.35);
constexpr double kLeastGrowth = 1.05;
/** Points of the narrowest ball for each of its fits. */
constexpr double kPointsPerFit = 40.0;
constexpr std::size_t kMostShare = 64;
/** Least variance of heights, in that of the noise, which is known to a tenth or so: where the filter followed the noise, heights above its
 * result are smaller. */
constexpr double kLeastVariance = 0.85;
/** Misfit at which a quadric counts for nothing, above that up to which it counts fully. */
constexpr double kMisfitRange = 0.3;
/** So much more a fit may have by itself than together with those about it; from kEdgeMisfit on it is left out of their means. */
constexpr double kOwnMisfit = 0.5, kEdgeMisfit = 2.2;
/** Unevenness up to which a quadric counts fully, and above that until it counts for nothing. */
constexpr double kUneven = 1.5, kUnevenRange = 0.4;
/** The radius of the ball in those of curvature, likewise. From kBent on edges begin to look like tubes: the misfit may be less then, by up
 * to kStricter. */
constexpr double kBending = 1.2, kBendingRange = 0.3, kBent = 0.85, kStricter = 0.2;
/** The narrowest quadrics average hardly more than the filter did: they move points this share of the way. */
constexpr double kFirstShare = 0.6;
/** Least cosine of a point's normal with that of the fit that serves it. */
constexpr double kSameFace = 0.85;

/** 1 up to `from`, 0 from `to` on. */
double
falling(double value, double from, double to)
{
  const double t = std::min(1.0, std::max(0.0, (to - value) / (to - from)));
  return t * t * (3.0 - 2.0 * t);
}

/** The places of the fits: one for `share` consecutive points. */
class Fits {
public:
  Fits(const QuadricFitParameters& p, PointsView noisy, MutableVectorsView positions, MutableVectorsView normals)
  : p_(p)
  , threads_(resolveThreads(p.number_of_threads))
  , data_(p, noisy, positions, normals, threads_)
  , positions_(positions)
  , normals_(normals)
  , moves_(positions.size)
  , frames_(0)
  {
    const double held = 3.14159265358979323846 * p.radius * p.radius / (p.spacing * p.spacing);
    while (static_cast<double>(2 * share_) * kPointsPerFit <= held && share_ < kMostShare)
      share_ *= 2;
    belief_.assign((data_.points().size() + share_ - 1) / share_, 1.0);
    for (std::size_t k = 0; k < data_.points().size(); ++k) {
      const std::uint32_t i = data_.points().order()[k];
      moves_.x[i] = moves_.y[i] = moves_.z[i] = 0.0f;
    }
  }

  /** One radius. \return whether any fit is still believed */
  bool
  run(unsigned level)
  {
    const double wanted = p_.radius * std::pow(kGrowth, level), radius = std::min(wanted, kWidest);
    if (wanted > kWidest && kLeastGrowth * wanted > kGrowth * kWidest)
      return false;
    std::vector<std::uint32_t> probes;
    for (std::size_t f = 0; f < belief_.size(); ++f)
      if (belief_[f] > 0.0)
        probes.push_back(static_cast<std::uint32_t>(f));
    if (probes.empty() || !data_.average(radius))
      return false;
    frames_ = QueryFrames(data_, placesOf(probes));
    const QuadricSums sums = data_.sums(frames_, radius);
    std::vector<FittedQuadric> quadrics(probes.size());
    parallelBlocks(probes.size(), kFitsPerTask, threads_, [&](std::size_t begin, std::size_t end) {
      const double least = kLeastVariance * p_.noise * p_.noise / (radius * radius);
      for (std::size_t q = begin; q < end; ++q)
        if (!solveQuadric(sums.of(q), sums.row(), least, quadrics[q]))
          belief_[probes[q]] = 0.0;
    });
    judge(probes, quadrics, radius);
    parallelBlocks(probes.size(), kFitsPerTask, threads_, [&](std::size_t begin, std::size_t end) {
      for (std::size_t q = begin; q < end; ++q)
        useFit(quadrics[q], q, probes[q], radius, level == 0 ? kFirstShare : 1.0);
    });
    return true;
  }

  void
  apply()
  {
    for (std::size_t i = 0; i < positions_.size; ++i) {
      positions_.x[i] += moves_.x[i];
      positions_.y[i] += moves_.y[i];
      positions_.z[i] += moves_.z[i];
    }
  }

private:
  static constexpr std::size_t kFitsPerTask = 512;

  std::vector<std::uint32_t>
  placesOf(const std::vector<std::uint32_t>& probes) const
  {
    std::vector<std::uint32_t> places;
    places.reserve(probes.size());
    for (const std::uint32_t f : probes)
      places.push_back(static_cast<std::uint32_t>(std::min(f * share_ + share_ / 2, data_.points().size() - 1)));
    return places;
  }

  /** Lowers the belief in each fit by its tests. */
  void
  judge(const std::vector<std::uint32_t>& probes, const std::vector<FittedQuadric>& quadrics, double radius)
  {
    std::vector<double> own(probes.size(), 2.0 * kEdgeMisfit);
    for (std::size_t q = 0; q < probes.size(); ++q)
      if (belief_[probes[q]] > 0.0)
        own[q] = quadrics[q].misfit;
    const std::vector<double> pooled = p_.pooling > 0.0 ? poolMisfits(frames_.origin, own, kEdgeMisfit, p_.pooling * radius, threads_) : own;
    for (std::size_t q = 0; q < probes.size(); ++q) {
      const double bent = 1.0 - falling(quadrics[q].bending, kBent, kBending);
      const double misfit = std::max(pooled[q], own[q] - kOwnMisfit) + kStricter * bent;
      double& belief = belief_[probes[q]];
      belief *= falling(misfit, p_.misfit, p_.misfit + kMisfitRange) * falling(quadrics[q].unevenness, kUneven, kUneven + kUnevenRange) *
                falling(quadrics[q].bending, kBending, kBending + kBendingRange);
      if (belief < 1e-3)
        belief = 0.0;
    }
  }

  void
  useFit(const FittedQuadric& quadric, std::size_t q, std::size_t fit, double radius, double share)
  {
    const std::size_t end = std::min(data_.points().size(), (fit + 1) * share_);
    for (std::size_t k = fit * share_; k < end && belief_[fit] > 0.0; ++k)
      moveOne(quadric, frames_.of(q), k, radius, belief_[fit] * share);
  }

  /** Along the quadric's normal, from where the point would be after narrower balls towards it. */
  void
  moveOne(const FittedQuadric& quadric, const QueryFrame& frame, std::size_t k, double radius, double share)
  {
    const Eigen::Vector3d side = data_.normal(k), offset = (data_.position(k) - frame.origin) / radius;
    const double cosine = side.dot(frame.n);
    if (!(std::abs(cosine) >= kSameFace) || !(offset.squaredNorm() < 0.25))
      return;
    const double x = offset.dot(frame.u), y = offset.dot(frame.v);
    const Eigen::Matrix<double, 6, 1>& c = quadric.of;
    const Eigen::Vector3d normal =
        frame.n - (c[1] + 2 * c[3] * x + c[4] * y) * frame.u - (c[2] + c[4] * x + 2 * c[5] * y) * frame.v;
    const Eigen::Vector3d wanted = radius * (quadric.height(x, y) - offset.dot(frame.n)) / normal.squaredNorm() * normal;
    const std::uint32_t i = data_.points().order()[k];
    const Eigen::Vector3d move(moves_.x[i], moves_.y[i], moves_.z[i]), now = move + share * (wanted - move);
    moves_.x[i] = static_cast<float>(now[0]);
    moves_.y[i] = static_cast<float>(now[1]);
    moves_.z[i] = static_cast<float>(now[2]);
    const Eigen::Vector3d old(normals_.x[i], normals_.y[i], normals_.z[i]);
    const Eigen::Vector3d fitted = (normal.dot(old) < 0.0 ? -1.0 : 1.0) * normal.normalized();
    const Eigen::Vector3d turned = (old + share * (fitted - old)).normalized();
    normals_.x[i] = static_cast<float>(turned[0]);
    normals_.y[i] = static_cast<float>(turned[1]);
    normals_.z[i] = static_cast<float>(turned[2]);
  }

  const QuadricFitParameters& p_;
  std::size_t threads_;
  QuadricData data_;
  MutableVectorsView positions_, normals_;
  SoaBuffer moves_; ///< in the caller's order
  std::size_t share_ = 1;
  std::vector<double> belief_; ///< in each fit, 0 .. 1
  QueryFrames frames_;
};

} // namespace

void
validate(const QuadricFitParameters& p)
{
  checkRange("quadric radius", p.radius, p.radius >= 0.0, ">= 0, 0 = estimated");
  checkRange("quadric noise", p.noise, p.noise >= 0.0, ">= 0");
  checkRange("quadric spacing", p.spacing, p.spacing >= 0.0, ">= 0, 0 = estimated");
  checkRange("quadric misfit", p.misfit, p.misfit > 0.0, "> 0");
  checkRange("quadric pooling", p.pooling, p.pooling >= 0.0, ">= 0");
  checkRange("quadric merge_above", p.merge_above, p.merge_above >= 16, ">= 16");
}

void
fitQuadrics(const QuadricFitParameters& p, PointsView noisy, MutableVectorsView positions, MutableVectorsView normals,
            const ProgressCallback& progress)
{
  validate(p);
  if (p.levels == 0)
    return;
  checkRange("quadric radius", p.radius, p.radius > 0.0, "> 0");
  checkRange("quadric spacing", p.spacing, p.spacing > 0.0, "> 0");
  if (positions.size != noisy.size || normals.size != noisy.size)
    throw InvalidParameter("positions and normals of another number than the points");
  if (noisy.size == 0 || !(p.radius <= kWidest))
    return;
  Fits fits(p, noisy, positions, normals);
  for (unsigned level = 0; level < p.levels; ++level) {
    if (progress && !progress(static_cast<double>(level) / p.levels))
      throw Cancelled();
    if (!fits.run(level))
      break;
  }
  fits.apply();
  if (progress && !progress(1.0))
    throw Cancelled();
}

} // namespace pcl_gpf
