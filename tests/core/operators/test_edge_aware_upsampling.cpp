// SPDX-License-Identifier: BSD-3-Clause
#include "support/local_cloud.h"

#include <pcl_gpf/core/analysis/spacing.h>
#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/operators/edge_aware_upsampling.h>
#include <pcl_gpf/core/simd.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>

namespace pcl_gpf::test {
namespace {

EdgeAwareUpsamplingResult
upsample(const LocalCloud& cloud, const EdgeAwareUpsamplingParameters& parameters, const ProgressCallback& progress = {})
{
  return upsampleEdgeAware(parameters, cloud.points.view(), cloud.normals.view(), progress);
}

EdgeAwareUpsamplingParameters
times(double factor, double edge_sensitivity = 0.0)
{
  EdgeAwareUpsamplingParameters p;
  p.factor = factor;
  p.edge_sensitivity = edge_sensitivity;
  return p;
}

/** Input and inserted points. */
std::vector<Vector3>
allPoints(const LocalCloud& cloud, const EdgeAwareUpsamplingResult& result)
{
  std::vector<Vector3> all = cloud.v;
  for (const Vector3& p : toVectors(result.points))
    all.push_back(p);
  return all;
}

double
dot(const Vector3& p, const Vector3& q)
{
  return p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
}

double
spacingOf(const std::vector<Vector3>& points)
{
  const SoaBuffer buffer = toBuffer(points);
  return estimateSpacing(buffer.view());
}

/** C(b) of the equation, over neighbours of v within the radius, and the largest priority. */
double
literalPriority(const LocalCloud& cloud, std::size_t v, double radius, double rho, std::vector<std::size_t>& partners)
{
  std::vector<std::size_t> near;
  for (std::size_t s = 0; s < cloud.size(); ++s)
    if (distance(cloud.v[s], cloud.v[v]) < radius)
      near.push_back(s);
  double best = 0.0;
  std::vector<std::pair<double, std::size_t>> found;
  for (const std::size_t t : near) {
    if (t == v)
      continue;
    const Vector3 b{(cloud.v[v][0] + cloud.v[t][0]) / 2, (cloud.v[v][1] + cloud.v[t][1]) / 2, (cloud.v[v][2] + cloud.v[t][2]) / 2};
    double clearance = 1e30;
    for (const std::size_t s : near) {
      const Vector3 d{b[0] - cloud.v[s][0], b[1] - cloud.v[s][1], b[2] - cloud.v[s][2]};
      const double along = dot(d, cloud.b[s]);
      clearance = std::min(clearance, dot(d, d) - along * along);
    }
    found.emplace_back(clearance * std::pow(2.0 - std::abs(dot(cloud.b[v], cloud.b[t])), rho), t);
    best = std::max(best, found.back().first);
  }
  for (const auto& [priority, t] : found)
    if (priority >= best * (1 - 1e-4))
      partners.push_back(t);
  return best;
}

TEST(EdgeAwareUpsampling, FirstPointLiesInTheWidestGapOfTheLiteralEquations)
{
  for (const double rho : {0.0, 5.0}) {
    const LocalCloud cloud = toLocalCloud(edge(400, 0, 7));
    EdgeAwareUpsamplingParameters p;
    p.target_count = cloud.size() + 1;
    p.edge_sensitivity = rho;
    p.radius = 2.0 * spacingOf(cloud.v); // about 12 neighbours, below the number that is looked at
    const EdgeAwareUpsamplingResult result = upsample(cloud, p);
    ASSERT_EQ(result.parents.size(), 1u);
    double widest = 0.0;
    for (std::size_t v = 0; v < cloud.size(); ++v) {
      std::vector<std::size_t> partners;
      widest = std::max(widest, literalPriority(cloud, v, p.radius, rho, partners));
    }
    std::vector<std::size_t> partners;
    EXPECT_NEAR(literalPriority(cloud, result.first_base[0], p.radius, rho, partners), widest, 1e-4 * widest);
    EXPECT_NE(std::find(partners.begin(), partners.end(), result.second_base[0]), partners.end());
  }
}

TEST(EdgeAwareUpsampling, ProjectionIsTheLiteralWeightedMean)
{
  const LocalCloud cloud = toLocalCloud(sphere(500, 0.01, 3));
  EdgeAwareUpsamplingParameters p = times(1.5);
  p.radius = 0.2;
  const EdgeAwareUpsamplingResult result = upsample(cloud, p);
  const std::vector<Vector3> all = allPoints(cloud, result), normals = toVectors(result.normals);
  const double psi_scale = 1.0 - std::cos(30.0 * std::acos(-1.0) / 180.0);
  std::size_t checked = 0;
  for (std::size_t k = 0; k < normals.size(); ++k) {
    if (result.first_base[k] >= cloud.size() || result.second_base[k] >= cloud.size())
      continue;
    const std::size_t bases[2] = {result.first_base[k], result.second_base[k]};
    const Vector3 &v = all[bases[0]], &t = all[bases[1]];
    const Vector3 b{(v[0] + t[0]) / 2, (v[1] + t[1]) / 2, (v[2] + t[2]) / 2};
    double nearest_difference = 1.0;
    for (const std::size_t m : bases) { // whichever of the two normals was taken
      double weights = 0.0, offset = 0.0;
      Vector3 sum{0, 0, 0};
      for (std::size_t q = 0; q < cloud.size(); ++q) {
        const double r = distance(b, cloud.v[q]);
        if (r >= p.radius)
          continue;
        const double cosine = dot(cloud.b[m], cloud.b[q]), sign = cosine < 0 ? -1 : 1;
        const double turn = (1 - sign * cosine) / psi_scale;
        const double w = std::exp(-4 * r * r / (p.radius * p.radius) - turn * turn);
        const Vector3 d{b[0] - cloud.v[q][0], b[1] - cloud.v[q][1], b[2] - cloud.v[q][2]};
        weights += w;
        offset += w * sign * dot(d, cloud.b[q]);
        for (std::size_t axis = 0; axis < 3; ++axis)
          sum[axis] += w * sign * cloud.b[q][axis];
      }
      const double length = std::sqrt(dot(sum, sum));
      Vector3 expected{};
      for (std::size_t axis = 0; axis < 3; ++axis)
        expected[axis] = b[axis] - offset / weights * sum[axis] / length;
      nearest_difference = std::min(nearest_difference, distance(expected, all[cloud.size() + k]));
    }
    EXPECT_LT(nearest_difference, 2e-6);
    ++checked;
  }
  EXPECT_GT(checked, 100u);
}

TEST(EdgeAwareUpsampling, InsertsExactlyAsManyAsAskedAndInputIsNotRepeated)
{
  const LocalCloud cloud = toLocalCloud(cube(700, 0.002, 2));
  for (const double factor : {1.0, 1.001, 1.3, 2.0, 7.7}) {
    const EdgeAwareUpsamplingResult result = upsample(cloud, times(factor, 5.0));
    EXPECT_EQ(result.parents.size(), static_cast<std::size_t>(std::floor(factor * 700 + 0.5)) - 700) << factor;
    EXPECT_TRUE(result.target_reached);
  }
  EdgeAwareUpsamplingParameters p;
  p.target_count = 701;
  EXPECT_EQ(upsample(cloud, p).parents.size(), 1u);
  EXPECT_EQ(upsample(cloud, EdgeAwareUpsamplingParameters()).parents.size(), 700u) << "twice as many without a target";
}

TEST(EdgeAwareUpsampling, PlaneStaysFlatAndBecomesEven)
{
  const LocalCloud cloud = toLocalCloud(plane(2000, 0, 5));
  const EdgeAwareUpsamplingResult result = upsample(cloud, times(4));
  for (const Vector3& p : toVectors(result.points))
    EXPECT_NEAR(p[2], cloud.v[0][2], 1e-6);
  for (const Vector3& n : toVectors(result.normals))
    EXPECT_NEAR(std::abs(n[2]), 1.0, 1e-6);
  // Distance of the farthest neighbour-to-be: a random cloud four times as dense leaves holes about twice as wide.
  const std::vector<Vector3> all = allPoints(cloud, result);
  const double spacing = std::sqrt(0.5 / static_cast<double>(all.size())); // the square's diagonal is 1
  double closest_new = 1.0;
  for (std::size_t i = cloud.size(); i < all.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      closest_new = std::min(closest_new, distance(all[i], all[j]));
  EXPECT_GT(closest_new, 0.5 * spacing) << "no new point sits on another";
  EXPECT_LT(result.widest_gap, 1.3 * spacing);
}

TEST(EdgeAwareUpsampling, WidestGapIsToldWhereNothingIsInserted)
{
  const LocalCloud cloud = toLocalCloud(plane(2000, 0, 5));
  const EdgeAwareUpsamplingResult same = upsample(cloud, times(1.0)), one_more = upsample(cloud, times(1.0005));
  EXPECT_EQ(same.parents.size(), 0u);
  EXPECT_TRUE(same.target_reached);
  EXPECT_GT(same.widest_gap, 0.0);
  EXPECT_LE(same.widest_gap, same.radius);
  EXPECT_GE(same.widest_gap, one_more.widest_gap);
}

TEST(EdgeAwareUpsampling, EdgeIsSharpenedAndNormalsAreOfOneSideEach)
{
  const LocalCloud cloud = toLocalCloud(edge(3000, 0, 9));
  const EdgeAwareUpsamplingResult result = upsample(cloud, times(2, 5.0));
  const std::vector<Vector3> points = toVectors(result.points), normals = toVectors(result.normals);
  std::size_t on_edge = 0;
  const double scale = std::sqrt(3.0);
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double x = points[k][0] * scale, z = points[k][2] * scale; // the box is the unit cube about the origin
    const double above = std::abs(z - 0.5), beside = std::abs(x + 0.5);
    EXPECT_LT(std::min(above, beside), 2e-3) << "every new point lies on one of the two squares";
    EXPECT_GT(std::max(std::abs(normals[k][0]), std::abs(normals[k][2])), 0.999) << "no normal is a mixture";
    const Vector3& parent = cloud.b[result.parents[k]];
    EXPECT_GT(std::abs(dot(parent, normals[k])), 0.99) << "the parent lies on the same side";
    on_edge += above < 2e-3 && beside < 2e-3;
  }
  EXPECT_GT(on_edge, 30u) << "points on the edge itself";
}

TEST(EdgeAwareUpsampling, PointsBesideAnEdgeOfAnyAngleLieOnItsFaces)
{
  for (const double degrees : {75.0, 110.0, 125.0}) {
    // One face along x; the other, in place of the upright square, goes down at this angle inside the solid.
    const double angle = degrees * std::acos(-1.0) / 180.0;
    Shape bent = edge(3000, 0, 9);
    for (std::size_t i = 0; i < bent.size(); ++i)
      if (bent.normals[i][0] < -0.5) {
        bent.points[i] = {-std::cos(angle) * bent.points[i][2], bent.points[i][1], std::sin(angle) * bent.points[i][2]};
        bent.normals[i] = {-std::sin(angle), 0, -std::cos(angle)};
      }
    for (const bool sign_invariant : {true, false}) {
      EdgeAwareUpsamplingParameters p = times(2, 5.0);
      p.sign_invariant = sign_invariant;
      const SoaBuffer points = toBuffer(bent.points), normals = toBuffer(bent.normals);
      const EdgeAwareUpsamplingResult result = upsampleEdgeAware(p, points.view(), normals.view());
      for (const Vector3& q : toVectors(result.points)) {
        const double along = q[0] * std::cos(angle) - q[2] * std::sin(angle);
        const double from_first = std::hypot(q[2], std::min(q[0], 0.0));
        const double from_second = std::hypot(q[0] * std::sin(angle) + q[2] * std::cos(angle), std::min(along, 0.0));
        ASSERT_LT(std::min(from_first, from_second), 3e-3) << degrees << " degrees: the input's spacing is 0.026";
      }
    }
  }
}

TEST(EdgeAwareUpsampling, EdgeSensitivityMovesPointsToTheEdge)
{
  const LocalCloud cloud = toLocalCloud(edge(3000, 0, 9));
  std::vector<double> shares;
  for (const double rho : {0.0, 2.0, 8.0}) {
    const EdgeAwareUpsamplingResult result = upsample(cloud, times(1.5, rho));
    std::size_t near_edge = 0;
    for (const Vector3& p : toVectors(result.points))
      near_edge += std::hypot(p[0] * std::sqrt(3.0) + 0.5, p[2] * std::sqrt(3.0) - 0.5) < 0.05;
    shares.push_back(static_cast<double>(near_edge) / static_cast<double>(result.parents.size()));
  }
  EXPECT_LT(shares[0], shares[1]);
  EXPECT_LT(shares[1], shares[2]);
  EXPECT_GT(shares[2], 2 * shares[0]);
}

TEST(EdgeAwareUpsampling, SpacingIsReached)
{
  for (const double ratio : {0.8, 0.5, 0.3}) {
    const LocalCloud cloud = toLocalCloud(sphere(1500, 0, 4));
    EdgeAwareUpsamplingParameters p;
    p.spacing = ratio * spacingOf(cloud.v);
    p.edge_sensitivity = 0.0;
    const EdgeAwareUpsamplingResult result = upsample(cloud, p);
    EXPECT_TRUE(result.target_reached);
    EXPECT_NEAR(spacingOf(allPoints(cloud, result)) / p.spacing, 1.0, 0.1) << ratio;
  }
  const LocalCloud cloud = toLocalCloud(sphere(1500, 0, 4));
  EdgeAwareUpsamplingParameters p;
  p.spacing = 10.0 * spacingOf(cloud.v);
  EXPECT_EQ(upsample(cloud, p).parents.size(), 0u) << "finer parts stay";
}

TEST(EdgeAwareUpsampling, SameBitsForAnyNumberOfThreads)
{
  const LocalCloud cloud = toLocalCloud(cube(4000, 0.003, 6));
  EdgeAwareUpsamplingParameters p = times(3, 5.0);
  p.number_of_threads = 1;
  const EdgeAwareUpsamplingResult one = upsample(cloud, p);
  for (const unsigned threads : {2u, 3u, 7u}) {
    p.number_of_threads = threads;
    const EdgeAwareUpsamplingResult many = upsample(cloud, p);
    EXPECT_TRUE(sameBits(one.points, many.points));
    EXPECT_TRUE(sameBits(one.normals, many.normals));
    EXPECT_EQ(one.parents, many.parents);
  }
}

TEST(EdgeAwareUpsampling, SameBitsForEveryInstructionSet)
{
  const LocalCloud cloud = toLocalCloud(cube(1500, 0.003, 6));
  const std::string before = activeSimdTarget();
  for (const bool sign_invariant : {true, false}) {
    EdgeAwareUpsamplingParameters p = times(3, 2.0);
    p.sign_invariant = sign_invariant;
    p.radius = 5.0 * spacingOf(cloud.v); // more neighbours than are looked at
    setSimdTarget("scalar");
    const EdgeAwareUpsamplingResult scalar = upsample(cloud, p);
    for (const std::string& target : availableSimdTargets()) {
      setSimdTarget(target);
      const EdgeAwareUpsamplingResult wide = upsample(cloud, p);
      EXPECT_TRUE(sameBits(scalar.points, wide.points)) << target;
      EXPECT_TRUE(sameBits(scalar.normals, wide.normals)) << target;
      EXPECT_EQ(scalar.parents, wide.parents) << target;
    }
  }
  setSimdTarget(before);
}

TEST(EdgeAwareUpsampling, AnIndexOfTheCallerGivesTheSame)
{
  const LocalCloud cloud = toLocalCloud(cube(1000, 0.003, 6));
  const EdgeAwareUpsamplingParameters p = times(2, 5.0);
  const EdgeAwareUpsamplingResult plain = upsample(cloud, p);
  const PointIndex index(cloud.points.view());
  std::vector<Vector3> normals;
  for (const std::uint32_t i : index.order())
    normals.push_back(cloud.b[i]);
  const EdgeAwareUpsamplingResult sorted = upsampleEdgeAware(p, index, toBuffer(normals).view(), estimateSpacing(index));
  EXPECT_TRUE(sameBits(plain.points, sorted.points));
  ASSERT_EQ(plain.parents.size(), sorted.parents.size());
  for (std::size_t k = 0; k < plain.parents.size(); ++k) {
    EXPECT_EQ(plain.parents[k], index.order()[sorted.parents[k]]);
    const std::uint32_t base = sorted.first_base[k];
    EXPECT_EQ(plain.first_base[k], base < cloud.size() ? index.order()[base] : base);
  }
}

TEST(EdgeAwareUpsampling, SignsOfNormalsDoNotMatter)
{
  LocalCloud cloud = toLocalCloud(cube(2000, 0.002, 6));
  const EdgeAwareUpsamplingResult straight = upsample(cloud, times(2, 5.0));
  for (std::size_t i = 0; i < cloud.size(); i += 3) {
    cloud.normals.x[i] = -cloud.normals.x[i];
    cloud.normals.y[i] = -cloud.normals.y[i];
    cloud.normals.z[i] = -cloud.normals.z[i];
  }
  const EdgeAwareUpsamplingResult flipped = upsample(cloud, times(2, 5.0));
  ASSERT_EQ(straight.parents.size(), flipped.parents.size());
  EXPECT_TRUE(sameBits(straight.points, flipped.points));
}

TEST(EdgeAwareUpsampling, NormalsKeepAConsistentOrientation)
{
  for (const bool sign_invariant : {true, false}) {
    const LocalCloud cloud = toLocalCloud(cube(2000, 0, 8));
    EdgeAwareUpsamplingParameters p = times(3, 5.0);
    p.sign_invariant = sign_invariant;
    const EdgeAwareUpsamplingResult result = upsample(cloud, p);
    const std::vector<Vector3> points = toVectors(result.points), normals = toVectors(result.normals);
    for (std::size_t k = 0; k < points.size(); ++k)
      EXPECT_GT(dot(points[k], normals[k]), 0.0) << "outward: the cube's centre is the origin";
  }
}

TEST(EdgeAwareUpsampling, OrientedThinPlateStaysTwoSheets)
{
  // Two sheets one spacing apart: with signs each is filled on its own.
  Shape plate = plane(1500, 0, 3);
  const Shape lower = plane(1500, 0, 4);
  const double thickness = 1.0 / std::sqrt(1500.0);
  for (std::size_t i = 0; i < lower.size(); ++i) {
    plate.points.push_back({lower.points[i][0], lower.points[i][1], -thickness});
    plate.normals.push_back({0, 0, -1});
  }
  const LocalCloud cloud = toLocalCloud(plate);
  EdgeAwareUpsamplingParameters p = times(2);
  p.sign_invariant = false;
  const EdgeAwareUpsamplingResult result = upsample(cloud, p);
  for (const Vector3& point : toVectors(result.points))
    EXPECT_LT(std::min(std::abs(point[2] - cloud.v.front()[2]), std::abs(point[2] - cloud.v.back()[2])), 1e-5);
}

TEST(EdgeAwareUpsampling, ProgressRisesToOneAndCancels)
{
  const LocalCloud cloud = toLocalCloud(cube(2000, 0, 8));
  std::vector<double> fractions;
  upsample(cloud, times(4), [&](double f) {
    fractions.push_back(f);
    return true;
  });
  EXPECT_GT(fractions.size(), 3u);
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_EQ(fractions.front(), 0.0);
  EXPECT_EQ(fractions.back(), 1.0);
  std::size_t calls = 0;
  EXPECT_THROW(upsample(cloud, times(4), [&](double) { return ++calls < 3; }), Cancelled);
  EXPECT_EQ(calls, 3u);
}

TEST(EdgeAwareUpsampling, HostileClouds)
{
  for (const std::size_t count : {0u, 1u, 2u})
    EXPECT_THROW(upsample(toLocalCloud(plane(count)), times(2)), UnsuitableData) << count;
  Shape three;
  three.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  three.normals.assign(3, {0, 0, 1});
  const EdgeAwareUpsamplingResult triangle = upsample(toLocalCloud(three), times(4));
  EXPECT_EQ(triangle.parents.size(), 9u);
  Shape same = plane(50);
  for (Vector3& p : same.points)
    p = {0.5, 0.5, 0};
  EXPECT_THROW(upsample(toLocalCloud(same), times(2)), UnsuitableData);
  Shape line = plane(50);
  for (std::size_t i = 0; i < line.size(); ++i)
    line.points[i] = {0.1 * static_cast<double>(i), 0.2 * static_cast<double>(i), 0};
  EXPECT_THROW(upsample(toLocalCloud(line), times(2)), UnsuitableData);
  Shape doubled = plane(500);
  const Shape copy = doubled;
  doubled.points.insert(doubled.points.end(), copy.points.begin(), copy.points.end());
  doubled.normals.insert(doubled.normals.end(), copy.normals.begin(), copy.normals.end());
  const EdgeAwareUpsamplingResult twice = upsample(toLocalCloud(doubled), times(2));
  EXPECT_EQ(twice.parents.size(), 1000u);
  for (const Vector3& p : toVectors(twice.points))
    EXPECT_TRUE(std::isfinite(p[0] + p[1] + p[2]));
}

TEST(EdgeAwareUpsampling, PilesWithoutGapsEndBeforeTheTarget)
{
  Shape piles; // three places, 100 points each: after a few insertions only distances of rounding are left
  for (std::size_t i = 0; i < 300; ++i)
    piles.points.push_back({static_cast<double>(i % 3 == 1), static_cast<double>(i % 3 == 2), 0});
  piles.normals.assign(300, {0, 0, 1});
  EdgeAwareUpsamplingParameters p = times(2);
  p.radius = 1e-3;
  const EdgeAwareUpsamplingResult result = upsample(toLocalCloud(piles), p);
  EXPECT_FALSE(result.target_reached);
  EXPECT_EQ(result.parents.size(), 0u);
}

/** One point that strayed a million extents away makes the frame so wide that the others lie about its origin. */
TEST(EdgeAwareUpsampling, AStrayPointDoesNotCloseTheGapsOfTheOthers)
{
  Shape shape = plane(2000, 0, 5);
  for (Vector3& p : shape.points)
    for (double& coordinate : p)
      coordinate *= 1e-6;
  shape.points.push_back({1.0, 0.0, 0.0});
  shape.normals.push_back(shape.normals.front());
  const EdgeAwareUpsamplingResult result = upsample(toLocalCloud(shape), times(2.0));
  EXPECT_TRUE(result.target_reached);
  EXPECT_EQ(result.parents.size(), 2001u);
}

TEST(EdgeAwareUpsampling, CopiesOfOnePointAddNoGaps)
{
  Shape pile = plane(1000);
  const std::size_t copied = 500;
  for (std::size_t i = 0; i < 2000; ++i) {
    pile.points.push_back(pile.points[copied]);
    pile.normals.push_back(pile.normals[copied]);
  }
  const EdgeAwareUpsamplingResult result = upsample(toLocalCloud(pile), times(1.5));
  ASSERT_EQ(result.parents.size(), 1500u);
  std::set<std::uint32_t> bases;
  for (const std::vector<std::uint32_t>* ends : {&result.first_base, &result.second_base})
    for (const std::uint32_t base : *ends)
      if (base == copied || (base >= 1000 && base < 3000))
        bases.insert(base);
  EXPECT_GE(bases.size(), 1u);
  EXPECT_LE(bases.size(), 8u);
}

TEST(EdgeAwareUpsampling, RadiusThatExplodesIsRefusedBeforeTheFirstRound)
{
  const LocalCloud cloud = toLocalCloud(plane(100000));
  EdgeAwareUpsamplingParameters p = times(2);
  p.radius = 1.0;
  bool begun = false;
  try {
    upsample(cloud, p, [&](double) { return begun = true; });
    ADD_FAILURE() << "not refused";
  } catch (const ExcessiveWork& error) {
    for (const char* part : {"upsampling.radius", "billion pairs", " s and ", " MB"})
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
  EXPECT_FALSE(begun);
}

TEST(EdgeAwareUpsampling, ParametersAreChecked)
{
  const LocalCloud cloud = toLocalCloud(plane(100));
  const auto rejects = [&](auto change) {
    EdgeAwareUpsamplingParameters p;
    change(p);
    EXPECT_THROW(upsample(cloud, p), InvalidParameter);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  rejects([](auto& p) { p.target_count = 99; });
  rejects([](auto& p) { p.target_count = 100001; });
  rejects([](auto& p) { p.factor = 0.99; });
  rejects([](auto& p) { p.factor = 1001; });
  rejects([nan](auto& p) { p.factor = nan; });
  rejects([](auto& p) { p.spacing = -1; });
  rejects([](auto& p) { p.radius = -1; });
  rejects([](auto& p) { p.angle = 0; });
  rejects([](auto& p) { p.angle = 91; });
  rejects([](auto& p) { p.edge_sensitivity = -0.1; });
  rejects([](auto& p) { p.edge_sensitivity = 10.1; });
  rejects([](auto& p) { p.factor = 2, p.spacing = 0.1; });
  EdgeAwareUpsamplingParameters fine;
  fine.spacing = 1e-6;
  try {
    upsample(cloud, fine);
    FAIL();
  }
  catch (const ExcessiveWork& error) {
    EXPECT_NE(std::string(error.what()).find("100"), std::string::npos) << "names the figures: " << error.what();
  }
}

} // namespace
} // namespace pcl_gpf::test
