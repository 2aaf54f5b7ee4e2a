// SPDX-License-Identifier: BSD-3-Clause
#include "support/shapes.h"

#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/operators/steered_fit.h>
#include <pcl_gpf/core/sampling.h>
#include <pcl_gpf/core/soa_buffer.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

namespace pcl_gpf::test {
namespace {

constexpr double kNoise = 0.01;

/** A noisy surface over the unit square and a guide with true normals, off the surface by a wave of `residue` noises, as a filter leaves
 * it: neighbours are off by about the same. */
struct Scene {
  SoaBuffer noisy, guide, normals;

  Scene(std::size_t count, double residue, const std::function<std::array<double, 3>(double, double)>& height_and_slope)
  : noisy(count), guide(count), normals(count)
  {
    SplitMix64 random(11);
    for (std::size_t i = 0; i < count; ++i) {
      const double x = random.uniform(), y = random.uniform(), deviation = kNoise * random.normal();
      const auto [height, slope_x, slope_y] = height_and_slope(x, y);
      const double length = std::sqrt(1 + slope_x * slope_x + slope_y * slope_y);
      const double n[3] = {-slope_x / length, -slope_y / length, 1 / length};
      const double p[3] = {x, y, height};
      const double wave = residue * kNoise * std::sin(60 * x) * std::cos(60 * y);
      float* to[2][3] = {{noisy.x.data(), noisy.y.data(), noisy.z.data()}, {guide.x.data(), guide.y.data(), guide.z.data()}};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        to[0][axis][i] = static_cast<float>(p[axis] + deviation * n[axis]);
        to[1][axis][i] = static_cast<float>(p[axis] + wave * n[axis]);
      }
      normals.x[i] = static_cast<float>(n[0]);
      normals.y[i] = static_cast<float>(n[1]);
      normals.z[i] = static_cast<float>(n[2]);
    }
  }

  Scene(const Scene& other) : noisy(copyOf(other.noisy)), guide(copyOf(other.guide)), normals(copyOf(other.normals)) {}
  Scene& operator=(const Scene&) = delete;

  std::size_t size() const { return noisy.size(); }

private:
  static SoaBuffer
  copyOf(const SoaBuffer& from)
  {
    SoaBuffer to(from.size());
    std::copy_n(from.x.data(), from.size(), to.x.data());
    std::copy_n(from.y.data(), from.size(), to.y.data());
    std::copy_n(from.z.data(), from.size(), to.z.data());
    return to;
  }
};

std::array<double, 3>
flat(double, double)
{
  return {0.0, 0.0, 0.0};
}

/** A roof whose ridge runs along y. */
std::array<double, 3>
roof(double x, double)
{
  return {-std::abs(x - 0.5), x < 0.5 ? 1.0 : -1.0, 0.0};
}

SteeredFitParameters
parameters(double radius = 0.03)
{
  SteeredFitParameters p;
  p.radius = radius;
  p.direction_radius = 0.05;
  p.passes = 1;
  p.merge_above = 0;
  return p;
}

std::vector<std::uint32_t>
all(const Scene& scene)
{
  std::vector<std::uint32_t> places(scene.size());
  std::iota(places.begin(), places.end(), 0u);
  return places;
}

/** The page's equations in double, at one point; balls of directions hold every point. */
Eigen::Vector3d
literalFit(const Scene& s, const SteeredFitParameters& p, std::size_t i, Eigen::Vector3d& normal)
{
  const auto at = [](const SoaBuffer& b, std::size_t k) { return Eigen::Vector3d(b.x[k], b.y[k], b.z[k]); };
  Eigen::Matrix3d bend = Eigen::Matrix3d::Zero();
  double count = 0;
  for (std::size_t j = 0; j < s.size(); ++j)
    if ((at(s.guide, j) - at(s.guide, i)).norm() < p.direction_radius) {
      bend += at(s.normals, j) * at(s.normals, j).transpose();
      ++count;
    }
  const double longest = p.longest_share * p.radius;
  const Eigen::Matrix3d metric =
      Eigen::Matrix3d::Identity() / (longest * longest) + p.bending_weight / (p.radius * p.radius) * bend / count;
  double weight_sum = 0;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero(), shift = mean;
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (std::size_t j = 0; j < s.size(); ++j) {
    const Eigen::Vector3d d = at(s.guide, j) - at(s.guide, i);
    const double share = 1 - d.dot(metric * d);
    if (share <= 0)
      continue;
    const double w = share * share;
    weight_sum += w;
    mean += w * d;
    const Eigen::Vector3d n = at(s.normals, j);
    const double u = (1 - std::abs(n.dot(at(s.normals, i)))) / (1 - std::sqrt(0.5));
    const double planes = u < 2 ? 0.5 * std::pow(1 - u * u / 4, 4) : 0;
    shift += w * ((1 - planes) * d + planes * d.dot(n) * n + at(s.noisy, j) - at(s.guide, j));
    scatter += w * d * d.transpose();
  }
  mean /= weight_sum;
  scatter = scatter / weight_sum - mean * mean.transpose();
  normal = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter).eigenvectors().col(0);
  if (normal.dot(at(s.normals, i)) < 0)
    normal = -normal;
  return at(s.guide, i) + normal.dot(shift / weight_sum) * normal;
}

double
meanDistanceToRoof(const SoaBuffer& points)
{
  double sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    sum += std::abs(points.z[i] + std::abs(points.x[i] - 0.5f)) / std::sqrt(2.0);
  return sum / static_cast<double>(points.size());
}

TEST(SteeredFit, EqualsItsEquationsInDouble)
{
  const Scene scene(1500, 0.3, roof); // so few that no two points share a tensor
  Scene fitted = scene;
  const SteeredFitParameters p = parameters(0.06);
  fitSteeredPlanes(p, scene.noisy.view(), all(scene), fitted.guide.view(), fitted.normals.view());
  double largest = 0;
  for (std::size_t i = 0; i < scene.size(); i += 7) {
    Eigen::Vector3d normal;
    const Eigen::Vector3d expected = literalFit(scene, p, i, normal);
    largest = std::max(largest, (expected - Eigen::Vector3d(fitted.guide.x[i], fitted.guide.y[i], fitted.guide.z[i])).norm());
    EXPECT_GT(normal.dot(Eigen::Vector3d(fitted.normals.x[i], fitted.normals.y[i], fitted.normals.z[i])), 1 - 1e-5) << i;
  }
  EXPECT_LT(largest, 1e-4 * p.radius);
}

TEST(SteeredFit, AveragesTheNoiseOfAPlaneOnce)
{
  const Scene scene(20000, 0.5, flat);
  Scene fitted = scene;
  fitSteeredPlanes(parameters(), scene.noisy.view(), all(scene), fitted.guide.view(), fitted.normals.view());
  double before = 0, after = 0;
  for (std::size_t i = 0; i < scene.size(); ++i) {
    before += std::abs(scene.guide.z[i]);
    after += std::abs(fitted.guide.z[i]);
  }
  EXPECT_LT(after, 0.3 * before); // hundreds of points in an ellipsoid
}

TEST(SteeredFit, ReachesAlongARidgeWithoutRoundingIt)
{
  const Scene scene(20000, 0.3, roof);
  SteeredFitParameters ball = parameters();
  ball.bending_weight = 0.0;
  ball.longest_share = 1.0;
  Scene steered = scene, round = scene;
  fitSteeredPlanes(parameters(), scene.noisy.view(), all(scene), steered.guide.view(), steered.normals.view());
  fitSteeredPlanes(ball, scene.noisy.view(), all(scene), round.guide.view(), round.normals.view());
  const double left = meanDistanceToRoof(steered.guide);
  EXPECT_LT(left, 0.5 * meanDistanceToRoof(scene.guide));
  EXPECT_LT(left, 0.9 * meanDistanceToRoof(round.guide));
}

TEST(SteeredFit, LeavesACurvedSurfaceWhereItIs)
{
  const auto bowl = [](double x, double y) {
    return std::array<double, 3>{0.5 * (x * x + y * y), x, y}; // curvature 1, or a little less
  };
  const Scene scene(20000, 0.0, bowl);
  Scene fitted = scene, clean = scene;
  fitSteeredPlanes(parameters(0.05), clean.guide.view(), all(scene), fitted.guide.view(), fitted.normals.view());
  double signed_sum = 0;
  std::size_t inner = 0;
  for (std::size_t i = 0; i < scene.size(); ++i)
    if (scene.guide.x[i] > 0.2f && scene.guide.x[i] < 0.8f && scene.guide.y[i] > 0.2f && scene.guide.y[i] < 0.8f) {
      signed_sum += fitted.guide.z[i] - scene.guide.z[i];
      ++inner;
    }
  // Means of heights over balls of radius 0.05 alone would lift it by 0.05^2 / 8 = 3e-4.
  EXPECT_LT(std::abs(signed_sum / static_cast<double>(inner)), 3e-5);
}

TEST(SteeredFit, TouchesOnlyTheGivenPlacesAndKeepsTheSideOfNormals)
{
  Scene scene(3000, 0.3, roof);
  for (std::size_t i = 0; i < scene.size(); i += 2) {
    scene.normals.x[i] = -scene.normals.x[i];
    scene.normals.z[i] = -scene.normals.z[i];
  }
  Scene fitted = scene;
  fitSteeredPlanes(parameters(0.06), scene.noisy.view(), {5, 8, 2000}, fitted.guide.view(), fitted.normals.view());
  std::vector<std::size_t> changed;
  for (std::size_t i = 0; i < scene.size(); ++i)
    if (fitted.guide.z[i] != scene.guide.z[i])
      changed.push_back(i);
  EXPECT_EQ(changed, (std::vector<std::size_t>{5, 8, 2000}));
  for (const std::size_t i : changed)
    EXPECT_GT(fitted.normals.z[i] * scene.normals.z[i], 0.0f);
}

TEST(SteeredFit, DoesNotDependOnThreads)
{
  const Scene scene(20000, 0.3, roof);
  Scene one = scene, two = scene;
  SteeredFitParameters p = parameters();
  p.merge_above = 50;
  p.passes = 2;
  p.number_of_threads = 1;
  fitSteeredPlanes(p, scene.noisy.view(), all(scene), one.guide.view(), one.normals.view());
  p.number_of_threads = 2;
  fitSteeredPlanes(p, scene.noisy.view(), all(scene), two.guide.view(), two.normals.view());
  for (std::size_t i = 0; i < scene.size(); ++i) {
    ASSERT_EQ(one.guide.x[i], two.guide.x[i]) << i;
    ASSERT_EQ(one.guide.z[i], two.guide.z[i]) << i;
    ASSERT_EQ(one.normals.x[i], two.normals.x[i]) << i;
  }
  p.merge_above = 0;
  Scene unmerged = scene;
  fitSteeredPlanes(p, scene.noisy.view(), all(scene), unmerged.guide.view(), unmerged.normals.view());
  EXPECT_NE(unmerged.guide.z[0], one.guide.z[0]); // there were means
}

TEST(SteeredFit, MeansInDenseNeighbourhoodsCostLittle)
{
  const Scene scene(20000, 0.3, roof);
  Scene fitted = scene, merged = scene;
  SteeredFitParameters p = parameters(0.05);
  fitSteeredPlanes(p, scene.noisy.view(), all(scene), fitted.guide.view(), fitted.normals.view());
  p.merge_above = 200;
  fitSteeredPlanes(p, scene.noisy.view(), all(scene), merged.guide.view(), merged.normals.view());
  EXPECT_NE(merged.guide.z[0], fitted.guide.z[0]); // means were taken
  EXPECT_LT(meanDistanceToRoof(merged.guide), 1.25 * meanDistanceToRoof(fitted.guide));
}

/** All passes but the last move means, and hand their moves down. */
TEST(SteeredFit, PassesOverMeansReachWhatPassesOverPointsReach)
{
  const Scene scene(20000, 1.0, roof);
  Scene fitted = scene, merged = scene, some = scene;
  SteeredFitParameters p = parameters(0.05);
  p.passes = 3;
  fitSteeredPlanes(p, scene.noisy.view(), all(scene), fitted.guide.view(), fitted.normals.view());
  p.merge_above = 200;
  fitSteeredPlanes(p, scene.noisy.view(), all(scene), merged.guide.view(), merged.normals.view());
  EXPECT_LT(meanDistanceToRoof(fitted.guide), 0.3 * meanDistanceToRoof(scene.guide));
  EXPECT_LT(meanDistanceToRoof(merged.guide), 1.1 * meanDistanceToRoof(fitted.guide));

  std::vector<std::uint32_t> lower; // the others stay to the last bit
  for (std::size_t i = 0; i < scene.size(); ++i)
    if (scene.guide.x[i] < 0.5f)
      lower.push_back(static_cast<std::uint32_t>(i));
  fitSteeredPlanes(p, scene.noisy.view(), lower, some.guide.view(), some.normals.view());
  std::size_t moved = 0;
  for (std::size_t i = 0; i < scene.size(); ++i) {
    const bool differs = some.guide.z[i] != scene.guide.z[i] || some.normals.x[i] != scene.normals.x[i];
    EXPECT_FALSE(differs && scene.guide.x[i] >= 0.5f) << i;
    moved += differs;
  }
  EXPECT_GT(moved, lower.size() * 99 / 100);
}

TEST(SteeredFit, FewAndCoincidentPointsStay)
{
  for (const std::size_t count : {std::size_t{1}, std::size_t{2}, std::size_t{3}}) {
    const Scene scene(count, 0.3, flat);
    Scene fitted = scene;
    fitSteeredPlanes(parameters(), scene.noisy.view(), all(scene), fitted.guide.view(), fitted.normals.view());
    for (std::size_t i = 0; i < count; ++i)
      EXPECT_EQ(fitted.guide.z[i], scene.guide.z[i]);
  }
  Scene same(100, 0.0, [](double, double) { return std::array<double, 3>{0.0, 0.0, 0.0}; });
  for (std::size_t i = 0; i < same.size(); ++i)
    same.guide.x[i] = same.guide.y[i] = same.noisy.x[i] = same.noisy.y[i] = same.noisy.z[i] = 0.25f;
  Scene fitted = same;
  fitSteeredPlanes(parameters(), same.noisy.view(), all(same), fitted.guide.view(), fitted.normals.view());
  for (std::size_t i = 0; i < same.size(); ++i)
    EXPECT_EQ(fitted.guide.z[i], same.guide.z[i]);
  Scene none(0, 0.3, flat);
  fitSteeredPlanes(parameters(), none.noisy.view(), {}, none.guide.view(), none.normals.view());
}

TEST(SteeredFit, RefusesBadParameters)
{
  Scene scene(10, 0.3, flat);
  const auto refuses = [&](auto change) {
    SteeredFitParameters p = parameters();
    change(p);
    EXPECT_THROW(fitSteeredPlanes(p, scene.noisy.view(), all(scene), scene.guide.view(), scene.normals.view()), InvalidParameter);
  };
  refuses([](auto& p) { p.radius = 0.0; });
  refuses([](auto& p) { p.radius = -1.0; });
  refuses([](auto& p) { p.radius = std::numeric_limits<double>::quiet_NaN(); });
  refuses([](auto& p) { p.direction_radius = 0.0; });
  refuses([](auto& p) { p.longest_share = 0.5; });
  refuses([](auto& p) { p.bending_weight = -1.0; });
  EXPECT_THROW(fitSteeredPlanes(parameters(), scene.noisy.view(), {10}, scene.guide.view(), scene.normals.view()), InvalidParameter);
}

TEST(SteeredFit, IsCancelledBetweenPasses)
{
  Scene scene(1000, 0.3, flat);
  SteeredFitParameters p = parameters();
  p.passes = 3;
  unsigned calls = 0;
  const auto second = [&calls](double) { return ++calls < 2; };
  EXPECT_THROW(fitSteeredPlanes(p, scene.noisy.view(), all(scene), scene.guide.view(), scene.normals.view(), second), Cancelled);
  EXPECT_EQ(calls, 2u);
}

} // namespace
} // namespace pcl_gpf::test
