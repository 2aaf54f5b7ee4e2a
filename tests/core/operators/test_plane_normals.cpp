// SPDX-License-Identifier: BSD-3-Clause
#include "support/local_cloud.h"

#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/operators/plane_normals.h>

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace pcl_gpf::test {
namespace {

struct Estimate {
  std::vector<Vector3> normals;
  AlignedArray<float> variation;
  std::size_t failed = 0;
};

Estimate
estimate(const LocalCloud& cloud, double radius, unsigned threads = 0)
{
  PlaneNormalsParameters p;
  p.radius = radius;
  p.number_of_threads = threads;
  SoaBuffer normals(cloud.size());
  Estimate result;
  result.variation = AlignedArray<float>(cloud.size());
  result.failed = estimatePlaneNormals(p, cloud.points.view(), normals.view(), result.variation.data());
  result.normals = toVectors(normals);
  return result;
}

struct LiteralPlane {
  bool decided = true; ///< false when rounding leaves the choice of neighbours open
  Eigen::Vector3d values{0, 0, 0}, normal{0, 0, 1};
};

void
fit(const LocalCloud& cloud, const std::vector<std::size_t>& neighbors, LiteralPlane& plane)
{
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const std::size_t j : neighbors)
    mean += Eigen::Vector3d(cloud.v[j].data()) / static_cast<double>(neighbors.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const std::size_t j : neighbors) {
    const Eigen::Vector3d d = Eigen::Vector3d(cloud.v[j].data()) - mean;
    covariance += d * d.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  plane.values = solver.eigenvalues();
  plane.normal = solver.eigenvectors().col(0);
}

/** The plane that the header promises: of the ball, or of the 12, 32 or 96 nearest when the ball holds fewer than 6 points or a line. */
LiteralPlane
literalPlane(const LocalCloud& cloud, std::size_t i, double radius)
{
  std::vector<double> r(cloud.size());
  for (std::size_t j = 0; j < cloud.size(); ++j)
    r[j] = distance(cloud.v[i], cloud.v[j]);
  std::vector<std::size_t> order(cloud.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return r[a] < r[b]; });
  LiteralPlane plane;
  plane.decided = std::none_of(r.begin(), r.end(), [&](double d) { return std::abs(d / radius - 1) < 1e-5; });
  const auto isLine = [&plane] {
    const double ratio = plane.values[1] / plane.values[2];
    plane.decided = plane.decided && std::abs(ratio / 0.05 - 1) > 1e-3;
    return ratio < 0.05;
  };
  const auto within = std::count_if(r.begin(), r.end(), [&](double d) { return d < radius; });
  if (within >= 6) {
    fit(cloud, {order.begin(), order.begin() + within}, plane);
    if (!isLine())
      return plane;
  }
  for (const std::size_t count : {12u, 32u, 96u}) {
    const std::size_t used = std::min(count, order.size());
    fit(cloud, {order.begin(), order.begin() + static_cast<std::ptrdiff_t>(used)}, plane);
    plane.decided = plane.decided && (used == order.size() || r[order[used]] > r[order[used - 1]] * (1 + 1e-5));
    if (!isLine() || used < count)
      break;
  }
  return plane;
}

/** Largest angle to Eigen's iterative solver in double over all points whose plane is well defined. */
double
largestAngle(const LocalCloud& cloud, double radius)
{
  const Estimate found = estimate(cloud, radius);
  double largest = 0;
  std::size_t compared = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const LiteralPlane plane = literalPlane(cloud, i, radius);
    if (!plane.decided || plane.values[1] < 2 * plane.values[0])
      continue; // or two directions are as good as each other
    ++compared;
    largest = std::fmax(largest, lineAngle(found.normals[i], {plane.normal[0], plane.normal[1], plane.normal[2]}));
    EXPECT_NEAR(found.variation[i], plane.values[0] / plane.values.sum(), 1e-5);
  }
  EXPECT_GT(compared, cloud.size() * 3 / 4);
  return largest;
}

TEST(PlaneNormals, agreeWithEigenOnCleanSurfaces)
{
  EXPECT_LT(largestAngle(toLocalCloud(turned(plane(2000))), 0.06), 1e-4);
  EXPECT_LT(largestAngle(toLocalCloud(turned(sphere(2000))), 0.06), 1e-4);
  EXPECT_LT(largestAngle(toLocalCloud(turned(edge(2000))), 0.06), 1e-4);
}

TEST(PlaneNormals, agreeWithEigenOnNoiseAndOnFewNeighbors)
{
  EXPECT_LT(largestAngle(toLocalCloud(turned(cube(1500, 0.01, 3))), 0.1), 1e-3);
  EXPECT_LT(largestAngle(toLocalCloud(turned(cube(600, 0.01, 3))), 0.02), 1e-3) << "12 nearest neighbours";
}

TEST(PlaneNormals, agreeWithEigenOnRandomBlobs)
{
  SplitMix64 random(5);
  for (int blob = 0; blob < 50; ++blob) {
    Shape shape;
    const double thickness = std::pow(10.0, -3.0 * random.uniform()), width = 0.2 + 0.8 * random.uniform();
    for (int i = 0; i < 40; ++i)
      append(shape, turned(Vector3{random.normal(), width * random.normal(), thickness * random.normal()}), {0, 0, 1});
    const LocalCloud cloud = toLocalCloud(shape);
    const Estimate found = estimate(cloud, 3.0); // every point sees all
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const LiteralPlane plane = literalPlane(cloud, i, 3.0);
      const double separation = 1 - plane.values[0] / plane.values[1];
      if (!plane.decided)
        continue;
      ASSERT_LT(lineAngle(found.normals[i], {plane.normal[0], plane.normal[1], plane.normal[2]}),
                1e-5 / (separation * separation) * plane.values[2] / plane.values[1])
          << "blob " << blob;
    }
  }
}

TEST(PlaneNormals, lookBeyondASingleScanLine)
{
  Shape lines; // 20 lines, ten times farther apart than their points
  SplitMix64 random(6);
  for (int line = 0; line < 20; ++line)
    for (int i = 0; i < 200; ++i)
      append(lines, turned(Vector3{0.005 * (i + 0.2 * random.uniform()), 0.05 * line, 0}), turned(Vector3{0, 0, 1}));
  const LocalCloud cloud = toLocalCloud(lines);
  const Estimate found = estimate(cloud, 0.03);
  EXPECT_EQ(found.failed, 0u);
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i)
    wrong += lineAngle(found.normals[i], cloud.b[i]) > 0.01;
  EXPECT_LT(wrong, cloud.size() / 100);
}

TEST(PlaneNormals, haveTheirLargestComponentPositiveAndLengthOne)
{
  for (const Vector3& n : estimate(toLocalCloud(turned(cube(2000, 0.01, 1))), 0.08).normals) {
    const Vector3 size = {std::abs(n[0]), std::abs(n[1]), std::abs(n[2])};
    const auto largest = static_cast<std::size_t>(std::max_element(size.begin(), size.end()) - size.begin());
    ASSERT_GT(n[largest], 0.0);
    ASSERT_NEAR(distance(n, {0, 0, 0}), 1.0, 1e-6);
  }
}

TEST(PlaneNormals, countPointsThatSpanNoPlane)
{
  const auto isUp = [](const Vector3& n) { return n == Vector3{0, 0, 1}; };
  const auto collinear = [](std::size_t size) {
    Shape shape;
    for (std::size_t i = 0; i < size; ++i) {
      const double t = static_cast<double>(i) / static_cast<double>(size);
      append(shape, turned(Vector3{t, 0, 0}), {0, 0, 1});
    }
    return toLocalCloud(shape);
  };
  for (const std::size_t size : {2u, 3u, 5u, 100u}) {
    const Estimate line = estimate(collinear(size), 0.1);
    EXPECT_EQ(line.failed, size) << "a line of " << size;
    EXPECT_TRUE(std::all_of(line.normals.begin(), line.normals.end(), isUp));
  }
  for (const std::size_t size : {1u, 2u, 50u}) {
    Shape shape;
    for (std::size_t i = 0; i < size; ++i)
      append(shape, {1, 2, 3}, {1, 0, 0});
    const Estimate identical = estimate(toLocalCloud(shape), 0.1);
    EXPECT_EQ(identical.failed, size) << size << " in one place";
    EXPECT_TRUE(std::all_of(identical.normals.begin(), identical.normals.end(), isUp));
  }
  EXPECT_EQ(estimate(toLocalCloud(turned(plane(500))), 0.1).failed, 0u);
  EXPECT_EQ(estimate(toLocalCloud(Shape{}), 0.1).failed, 0u);
}

TEST(PlaneNormals, findPlanesBesideAThickPileOfDuplicates)
{
  Shape shape = turned(plane(300));
  for (int i = 0; i < 50; ++i)
    append(shape, shape.points[0], shape.normals[0]);
  const LocalCloud cloud = toLocalCloud(shape);
  const Estimate found = estimate(cloud, 0.1);
  EXPECT_EQ(found.failed, 0u);
  for (const Vector3& n : found.normals)
    EXPECT_LT(lineAngle(n, cloud.b[0]), 1e-4);
}

TEST(PlaneNormals, haveTheSameBitsForAnyNumberOfThreads)
{
  const LocalCloud cloud = toLocalCloud(turned(cube(5000, 0.01, 8)));
  const auto expected = estimate(cloud, 0.05, 1).normals;
  for (const unsigned threads : {2u, 3u, 7u})
    EXPECT_EQ(estimate(cloud, 0.05, threads).normals, expected);
}

TEST(PlaneNormals, refuseARadiusThatIsNone)
{
  for (const double bad : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    EXPECT_THROW(estimate(toLocalCloud(cube(10)), bad), InvalidParameter);
}

} // namespace
} // namespace pcl_gpf::test
