// SPDX-License-Identifier: BSD-3-Clause
#include "support/local_cloud.h"

#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/operators/bilateral_normals.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_gpf::test {
namespace {

/** Normals with an angular noise of a few degrees; `flips` turns every third one around. */
SoaBuffer
noisyNormals(const LocalCloud& cloud, bool flips)
{
  SplitMix64 random(17);
  std::vector<Vector3> normals = cloud.b;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    for (double& component : normals[i])
      component += 0.1 * random.normal();
    const double length = distance(normals[i], {0, 0, 0}) * (flips && i % 3 == 0 ? -1 : 1);
    for (double& component : normals[i])
      component /= length;
  }
  return toBuffer(normals);
}

SoaBuffer
copyOf(const SoaBuffer& buffer)
{
  return toBuffer(toVectors(buffer));
}

SoaBuffer
filtered(const LocalCloud& cloud, const SoaBuffer& normals, BilateralNormalsParameters p, unsigned iterations, NeighborSearch search = {})
{
  SoaBuffer out = copyOf(normals);
  p.iterations = iterations;
  filterNormalsBilaterally(p, cloud.points.view(), out.view(), search);
  return out;
}

/** Squared radius of point i and which points are within it; false when rounding to float leaves that open. */
bool
neighborhood(const LocalCloud& cloud, const BilateralNormalsParameters& p, std::size_t i, double& radius_sq, std::vector<double>& r_sq)
{
  r_sq.clear();
  for (const Vector3& q : cloud.v)
    r_sq.push_back(std::pow(distance(cloud.v[i], q), 2));
  radius_sq = p.radius * p.radius;
  if (p.neighbors > 0) {
    std::vector<double> sorted = r_sq;
    std::sort(sorted.begin(), sorted.end()); // the first is the point itself
    radius_sq = sorted[p.neighbors] * 1.00001;
    return sorted[p.neighbors + 1] > radius_sq * 1.00001;
  }
  return std::none_of(r_sq.begin(), r_sq.end(), [&](double r) { return std::abs(r / radius_sq - 1) < 1e-5; });
}

/** One round at point i, as the header states it. */
Vector3
literalRound(const LocalCloud& cloud, const std::vector<Vector3>& n, const BilateralNormalsParameters& p, std::size_t i, double radius_sq,
             const std::vector<double>& r_sq)
{
  const double one_minus_cosine = 1 - std::cos(p.angle * 3.14159265358979323846 / 180);
  Vector3 sum{0, 0, 0};
  for (std::size_t j = 0; j < cloud.size(); ++j) {
    if (r_sq[j] >= radius_sq)
      continue;
    double cosine = n[i][0] * n[j][0] + n[i][1] * n[j][1] + n[i][2] * n[j][2];
    const double sign = p.sign_invariant && cosine < 0 ? -1 : 1;
    cosine *= sign;
    const double weight = std::exp(-r_sq[j] / radius_sq) * std::exp(-std::pow((1 - cosine) / one_minus_cosine, 2));
    for (std::size_t axis = 0; axis < 3; ++axis)
      sum[axis] += sign * weight * n[j][axis];
  }
  const double length = distance(sum, {0, 0, 0});
  return {sum[0] / length, sum[1] / length, sum[2] / length};
}

/** Every round against the formula, evaluated where the filter itself stood before. */
void
compareRounds(const LocalCloud& cloud, const SoaBuffer& normals, const BilateralNormalsParameters& p, NeighborSearch search = {})
{
  std::size_t undecided = 0;
  double largest_turn = 0;
  for (unsigned round = 0; round < 3; ++round) {
    const auto before = toVectors(filtered(cloud, normals, p, round, search));
    const auto after = toVectors(filtered(cloud, normals, p, round + 1, search));
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      double radius_sq = 0;
      std::vector<double> r_sq;
      if (!neighborhood(cloud, p, i, radius_sq, r_sq)) {
        ++undecided;
        continue;
      }
      const Vector3 expected = literalRound(cloud, before, p, i, radius_sq, r_sq);
      ASSERT_LE(distance(after[i], expected), 2e-5) << "point " << i << " in round " << round + 1;
      largest_turn = std::fmax(largest_turn, distance(before[i], after[i]));
    }
  }
  EXPECT_LT(undecided, cloud.size() / 10);
  EXPECT_GT(largest_turn, 0.05) << "nothing was filtered";
}

BilateralNormalsParameters
withRadius(double radius)
{
  BilateralNormalsParameters p;
  p.radius = radius;
  return p;
}

TEST(BilateralNormals, equalTheFormulaOriented)
{
  const LocalCloud cloud = toLocalCloud(turned(cube(1000, 0.01, 1)));
  BilateralNormalsParameters p = withRadius(0.12);
  p.sign_invariant = false;
  compareRounds(cloud, noisyNormals(cloud, false), p);
}

TEST(BilateralNormals, equalTheFormulaOnMixedSigns)
{
  const LocalCloud cloud = toLocalCloud(turned(sphere(1000, 0.005, 2)));
  for (const double angle : {10.0, 30.0, 90.0}) {
    BilateralNormalsParameters p = withRadius(0.12);
    p.angle = angle;
    compareRounds(cloud, noisyNormals(cloud, true), p);
    compareRounds(cloud, noisyNormals(cloud, true), p, bruteForceSearch);
  }
}

TEST(BilateralNormals, equalTheFormulaWithARadiusFromNeighbors)
{
  const LocalCloud cloud = toLocalCloud(turned(edge(1000, 0.005, 3)));
  for (const unsigned neighbors : {3u, 20u}) {
    BilateralNormalsParameters p;
    p.neighbors = neighbors;
    compareRounds(cloud, noisyNormals(cloud, true), p);
    compareRounds(cloud, noisyNormals(cloud, true), p, bruteForceSearch);
  }
}

TEST(BilateralNormals, areUnitVectorsWhateverTheirLengthWas)
{
  const LocalCloud cloud = toLocalCloud(turned(cube(2000, 0.01, 4)));
  SoaBuffer normals = noisyNormals(cloud, true);
  const SoaBuffer unit = copyOf(normals);
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const float scale = i % 2 == 0 ? 50.0f : 1e-4f;
    normals.x[i] *= scale;
    normals.y[i] *= scale;
    normals.z[i] *= scale;
  }
  for (const unsigned rounds : {0u, 1u, 5u}) {
    const auto expected = toVectors(filtered(cloud, unit, withRadius(0.1), rounds));
    const auto out = toVectors(filtered(cloud, normals, withRadius(0.1), rounds));
    for (std::size_t i = 0; i < out.size(); ++i) {
      ASSERT_NEAR(distance(out[i], {0, 0, 0}), 1.0, 1e-6);
      ASSERT_LE(distance(out[i], expected[i]), 1e-5);
    }
  }
}

TEST(BilateralNormals, makeNoisyNormalsBetterAndKeepEdges)
{
  const LocalCloud cloud = toLocalCloud(turned(cube(6000, 0, 5)));
  const SoaBuffer normals = noisyNormals(cloud, true);
  const auto before = toVectors(normals), after = toVectors(filtered(cloud, normals, withRadius(0.08), 5));
  double error_before = 0, error_after = 0;
  std::size_t wrong_face = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    error_before += lineAngle(before[i], cloud.b[i]);
    error_after += lineAngle(after[i], cloud.b[i]);
    wrong_face += lineAngle(after[i], cloud.b[i]) > 0.5;
  }
  EXPECT_LT(error_after, error_before / 4);
  EXPECT_LT(wrong_face, cloud.size() / 500);
}

TEST(BilateralNormals, ofACleanCubeStay)
{
  const LocalCloud cloud = toLocalCloud(turned(cube(3000, 0, 6)));
  for (const bool sign_invariant : {false, true}) {
    BilateralNormalsParameters p = withRadius(0.1);
    p.sign_invariant = sign_invariant;
    const auto after = toVectors(filtered(cloud, cloud.normals, p, 5));
    for (std::size_t i = 0; i < cloud.size(); ++i)
      ASSERT_LE(distance(after[i], cloud.b[i]), 1e-6);
  }
}

TEST(BilateralNormals, followTheSignsOfTheirInputAndNothingElseDoes)
{
  const LocalCloud cloud = toLocalCloud(turned(cube(2000, 0.01, 7)));
  const SoaBuffer normals = noisyNormals(cloud, false);
  SoaBuffer flipped = copyOf(normals);
  SplitMix64 random(3);
  std::vector<float> sign(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    sign[i] = random.below(2) == 0 ? 1.0f : -1.0f;
    flipped.x[i] *= sign[i];
    flipped.y[i] *= sign[i];
    flipped.z[i] *= sign[i];
  }
  const SoaBuffer expected = filtered(cloud, normals, withRadius(0.1), 4), out = filtered(cloud, flipped, withRadius(0.1), 4);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    ASSERT_EQ(out.x[i], sign[i] * expected.x[i]);
    ASSERT_EQ(out.y[i], sign[i] * expected.y[i]);
    ASSERT_EQ(out.z[i], sign[i] * expected.z[i]);
  }
}

TEST(BilateralNormals, haveTheSameBitsForAnyNumberOfThreads)
{
  const LocalCloud cloud = toLocalCloud(turned(cube(5000, 0.01, 8)));
  const SoaBuffer normals = noisyNormals(cloud, true);
  for (const unsigned neighbors : {0u, 15u}) {
    BilateralNormalsParameters p = withRadius(neighbors > 0 ? 0 : 0.06);
    p.neighbors = neighbors;
    p.number_of_threads = 1;
    const SoaBuffer expected = filtered(cloud, normals, p, 3);
    for (const unsigned threads : {2u, 3u, 7u}) {
      p.number_of_threads = threads;
      EXPECT_TRUE(sameBits(filtered(cloud, normals, p, 3), expected)) << threads << " threads";
    }
  }
}

TEST(BilateralNormals, ofIsolatedPointsStayAndAreCounted)
{
  Shape shape = turned(sphere(500, 0, 9));
  append(shape, {4, 4, 4}, {0.6, 0, 0.8});
  append(shape, {-4, 4, 4}, {0, 1, 0});
  const LocalCloud cloud = toLocalCloud(shape);
  SoaBuffer normals = copyOf(cloud.normals);
  BilateralNormalsParameters p = withRadius(0.03);
  const BilateralNormalsStatistics statistics = filterNormalsBilaterally(p, cloud.points.view(), normals.view());
  EXPECT_EQ(statistics.isolated_points, 2u);
  ASSERT_EQ(statistics.mean_change.size(), p.iterations);
  for (const std::size_t i : {500u, 501u}) {
    EXPECT_EQ(normals.x[i], cloud.normals.x[i]);
    EXPECT_EQ(normals.y[i], cloud.normals.y[i]);
    EXPECT_EQ(normals.z[i], cloud.normals.z[i]);
  }
}

TEST(BilateralNormals, tellTheMeanTurnOfEachRound)
{
  const LocalCloud cloud = toLocalCloud(turned(cube(1000, 0.01, 1)));
  const SoaBuffer normals = noisyNormals(cloud, false);
  SoaBuffer out = copyOf(normals);
  BilateralNormalsParameters p = withRadius(0.12);
  p.iterations = 2;
  const auto statistics = filterNormalsBilaterally(p, cloud.points.view(), out.view());
  for (unsigned round = 0; round < 2; ++round) {
    const auto before = toVectors(filtered(cloud, normals, p, round)), after = toVectors(filtered(cloud, normals, p, round + 1));
    double sum = 0;
    for (std::size_t i = 0; i < cloud.size(); ++i)
      sum += lineAngle(before[i], after[i]) * 180 / 3.14159265358979323846;
    EXPECT_NEAR(statistics.mean_change[round], sum / static_cast<double>(cloud.size()), 1e-4);
  }
}

TEST(BilateralNormals, takeCoincidentPointsAndTinyClouds)
{
  Shape shape;
  for (int i = 0; i < 20; ++i)
    append(shape, {0, 0, 0}, {0, 0, 1});
  append(shape, {1, 0, 0}, {1, 0, 0});
  const LocalCloud cloud = toLocalCloud(shape);
  BilateralNormalsParameters p;
  p.neighbors = 5; // the fifth neighbour coincides: a radius that is tiny, not 0
  for (const Vector3& n : toVectors(filtered(cloud, cloud.normals, p, 3)))
    EXPECT_NEAR(distance(n, {0, 0, 0}), 1.0, 1e-6);
  for (const std::size_t size : {0u, 1u, 2u}) {
    const LocalCloud tiny = toLocalCloud(sphere(size, 0, 1));
    EXPECT_EQ(filtered(tiny, tiny.normals, withRadius(0.5), 2).size(), size);
    EXPECT_EQ(filtered(tiny, tiny.normals, p, 2).size(), size);
  }
}

TEST(BilateralNormals, canBeCancelled)
{
  const LocalCloud cloud = toLocalCloud(cube(300));
  for (int stop = 0; stop < 5; ++stop) {
    SoaBuffer normals = copyOf(cloud.normals);
    int calls = 0;
    EXPECT_THROW(filterNormalsBilaterally(withRadius(0.1), cloud.points.view(), normals.view(), {}, [&](double) { return calls++ < stop; }),
                 Cancelled);
  }
}

TEST(BilateralNormals, refuseParametersOutsideTheirRange)
{
  const auto refused = [](auto change) {
    BilateralNormalsParameters p;
    change(p);
    EXPECT_THROW(validate(p), InvalidParameter);
  };
  for (const double bad : {-1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    refused([bad](BilateralNormalsParameters& p) { p.radius = bad; });
    refused([bad](BilateralNormalsParameters& p) { p.angle = bad; });
  }
  refused([](BilateralNormalsParameters& p) { p.angle = 0; });
  refused([](BilateralNormalsParameters& p) { p.angle = 91; });
  refused([](BilateralNormalsParameters& p) { p.neighbors = 2; });
  refused([](BilateralNormalsParameters& p) { p.neighbors = 1001; });
  refused([](BilateralNormalsParameters& p) { p.iterations = 1001; });
  refused([](BilateralNormalsParameters& p) { p.radius = 1; p.neighbors = 5; });
  EXPECT_NO_THROW(validate(BilateralNormalsParameters{}));
  const LocalCloud cloud = toLocalCloud(cube(10));
  SoaBuffer normals = copyOf(cloud.normals);
  EXPECT_THROW(filterNormalsBilaterally({}, cloud.points.view(), normals.view()), InvalidParameter);
}

TEST(BilateralNormals, ASearchOfOthersIsCheckedBeforeItsAnswersAreUsed)
{
  const LocalCloud cloud = toLocalCloud(sphere(200));
  BilateralNormalsParameters p;
  p.radius = 0.2;
  const auto search = [](std::size_t rows, std::uint32_t neighbor) {
    return [rows, neighbor](PointsView, PointsView, double) {
      NeighborLists lists;
      for (std::size_t row = 0; row <= rows; ++row)
        lists.offsets.push_back(row);
      lists.indices.assign(rows, neighbor);
      return lists;
    };
  };
  EXPECT_NO_THROW(filtered(cloud, cloud.normals, p, 1, search(200, 199)));
  EXPECT_THROW(filtered(cloud, cloud.normals, p, 1, search(200, 200)), InvalidParameter) << "no such point";
  EXPECT_THROW(filtered(cloud, cloud.normals, p, 1, search(200, 0xffffffffu)), InvalidParameter) << "-1";
  EXPECT_THROW(filtered(cloud, cloud.normals, p, 1, search(199, 0)), InvalidParameter) << "a row too few";
  EXPECT_THROW(filtered(cloud, cloud.normals, p, 1, [](PointsView, PointsView, double) { return NeighborLists(); }), InvalidParameter);
}

} // namespace
} // namespace pcl_gpf::test
