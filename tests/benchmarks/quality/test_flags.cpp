// SPDX-License-Identifier: BSD-3-Clause
// Outliers and edge points that denoise() finds, against models whose outliers and edges are known.
#include "models.h"
#include "noisy_cloud.h"

#include <pcl_gpf/pipeline/denoise.h>

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace pcl_gpf::quality {
namespace {

constexpr std::size_t kSize = 33490;

struct Filtered {
  Filtered(const std::string& model, double percent, double outliers)
  : cloud(makeNoisyCloud(makeModel(model, kSize), kSize, {NoiseKind::Gaussian, percent, outliers, 1}))
  {
    std::vector<double> axes[3];
    for (const Position& p : cloud.points)
      for (std::size_t axis = 0; axis < 3; ++axis)
        axes[axis].push_back(p[axis]);
    DenoiseInput input;
    input.x = axes[0].data();
    input.y = axes[1].data();
    input.z = axes[2].data();
    input.size = cloud.points.size();
    DenoiseParameters parameters;
    parameters.flags.edges = true;
    result = denoise(input, parameters);
  }

  Position
  at(std::size_t i) const
  {
    return {result.x[i], result.y[i], result.z[i]};
  }
  double
  distance(const Position& p) const
  {
    return std::abs(cloud.model.surface->nearest(p).signed_distance);
  }
  /** Mean error of the points that are no outliers. */
  double
  error() const
  {
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < result.x.size(); ++i)
      if (cloud.is_outlier[i] == 0) {
        sum += distance(at(i));
        ++count;
      }
    return sum / count;
  }

  NoisyCloud cloud;
  DenoiseResult result;
};

TEST(Flags, findNineOfTenOutliersBeyondSixSigmaAndSpareTheRest)
{
  for (const char* model : {"block", "cube", "sphere"})
    for (const double percent : {0.5, 1.0})
      for (const double share : {0.01, 0.05}) {
        const Filtered filtered(model, percent, share);
        const double six_sigma = 6 * percent / 100 * filtered.cloud.model.surface->diagonal();
        std::size_t far = 0, found = 0, inliers = 0, alarms = 0;
        for (std::size_t i = 0; i < kSize; ++i) {
          const bool flagged = filtered.result.outlier[i] > DenoiseResult::kOutlier;
          if (filtered.cloud.is_outlier[i] == 0) {
            ++inliers;
            alarms += flagged;
          } else if (filtered.distance(filtered.cloud.points[i]) > six_sigma) {
            ++far;
            found += flagged;
          }
        }
        const std::string what = std::string(model) + " " + std::to_string(percent) + " " + std::to_string(share);
        EXPECT_GT(far, 100u) << what;
        EXPECT_GE(static_cast<double>(found), 0.93 * static_cast<double>(far)) << what;
        EXPECT_LE(static_cast<double>(alarms), 0.001 * static_cast<double>(inliers)) << what;
      }
}

TEST(Flags, ofCloudsWithoutOutliersAreFew)
{
  const auto alarms = [](const char* model) {
    const Filtered filtered(model, 0.5, 0);
    std::size_t count = 0;
    for (const float probability : filtered.result.outlier)
      count += probability > DenoiseResult::kOutlier;
    return count;
  };
  for (const char* model : {"torus", "plane", "relief", "sheets"})
    EXPECT_LE(alarms(model), kSize / 200) << model;
  // Where the density is ten times lower than elsewhere, some points have too little support.
  EXPECT_LE(alarms("cube-graded"), kSize / 100);
}

TEST(Flags, outliersDoNotDamageTheRest)
{
  for (const char* model : {"block", "cube", "sphere"})
    for (const double percent : {0.5, 1.0}) {
      const double clean = Filtered(model, percent, 0).error();
      EXPECT_LE(Filtered(model, percent, 0.05).error(), 1.1 * clean) << model << " " << percent;
    }
}

TEST(Flags, edgePointsAreThoseWithinAQuarterOfTheSupportRadius)
{
  for (const char* model : {"block", "cube"})
    for (const double percent : {0.1, 0.25, 0.5}) {
      const Filtered filtered(model, percent, 0);
      double h = 0;
      for (const ParameterOrigin& origin : filtered.result.parameters)
        if (origin.name == "gpf.support_radius")
          h = origin.value;
      std::size_t right = 0, false_ones = 0, missed = 0;
      for (std::size_t i = 0; i < kSize; ++i) {
        const double d = filtered.cloud.model.surface->edgeDistance(filtered.at(i));
        const bool edge = filtered.result.edge[i] != 0;
        if (d < 0.9 * h / 4)
          ++(edge ? right : missed);
        else if (d > 1.1 * h / 4)
          false_ones += edge;
      }
      EXPECT_GT(right, 3000u);
      EXPECT_GE(static_cast<double>(right), 0.9 * static_cast<double>(right + false_ones)) << "precision, " << model << " " << percent;
      EXPECT_GE(static_cast<double>(right), 0.9 * static_cast<double>(right + missed)) << "recall, " << model << " " << percent;
    }
}

} // namespace
} // namespace pcl_gpf::quality
