// SPDX-License-Identifier: BSD-3-Clause
#include "support/columns.h"
#include "support/edge_band.h"
#include "support/local_cloud.h"

#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/pipeline/denoise.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>

namespace pcl_gpf::test {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/** A cloud as denoise() takes it. */
struct Cloud : Columns {
  std::vector<float> normal_x, normal_y, normal_z; ///< may be empty

  Cloud() = default;
  explicit Cloud(const Shape& shape, bool with_normals = false) : Columns(shape.points)
  {
    for (const Vector3& n : with_normals ? shape.normals : std::vector<Vector3>{}) {
      normal_x.push_back(static_cast<float>(n[0]));
      normal_y.push_back(static_cast<float>(n[1]));
      normal_z.push_back(static_cast<float>(n[2]));
    }
  }
  DenoiseInput
  input() const
  {
    DenoiseInput in = Columns::input();
    if (!normal_x.empty()) {
      in.normal_x = normal_x.data();
      in.normal_y = normal_y.data();
      in.normal_z = normal_z.data();
    }
    return in;
  }
};

Vector3
at(const DenoiseResult& result, std::size_t i)
{
  return {result.x[i], result.y[i], result.z[i]};
}

Vector3
normalAt(const DenoiseResult& result, std::size_t i)
{
  return {result.normal_x[i], result.normal_y[i], result.normal_z[i]};
}

bool
sameBits(const DenoiseResult& a, const DenoiseResult& b)
{
  const auto same = [](const auto& p, const auto& q) {
    return p.size() == q.size() && (p.empty() || std::memcmp(p.data(), q.data(), p.size() * sizeof(p[0])) == 0);
  };
  return same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z) && same(a.normal_x, b.normal_x) && same(a.normal_y, b.normal_y) &&
         same(a.normal_z, b.normal_z) && same(a.sample_indices, b.sample_indices) && same(a.isolated, b.isolated);
}

double
largestDistance(const DenoiseResult& a, const DenoiseResult& b)
{
  double largest = a.x.size() == b.x.size() ? 0 : std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < a.x.size() && i < b.x.size(); ++i)
    largest = std::fmax(largest, distance(at(a, i), at(b, i)));
  return largest;
}

/** The default chain, the chain with half of the points, and the paper's. */
std::vector<DenoiseParameters>
modes()
{
  std::vector<DenoiseParameters> all(3);
  all[1].gpf.sample_ratio = 0.5;
  all[1].gpf.repulsion_weight = 0.2;
  all[2].gpf = GPFParameters::paper();
  all[2].gpf.maximum_iterations = 5;
  return all;
}

double
cubeDistance(const Vector3& p)
{
  double outside_sq = 0, inside = std::numeric_limits<double>::infinity();
  for (const double c : p) {
    outside_sq += std::pow(std::max({0.0, -c, c - 1}), 2);
    inside = std::min({inside, c, 1 - c});
  }
  return outside_sq > 0 ? std::sqrt(outside_sq) : inside;
}

double
sphereDistance(const Vector3& p)
{
  return std::abs(distance(p, {0, 0, 0}) - 0.5);
}

/** Mean distance to the surface before / after. */
double
improvement(const Shape& shape, double (*surface)(const Vector3&))
{
  const DenoiseResult result = denoise(Cloud(shape).input(), {});
  double before = 0, after = 0;
  for (std::size_t i = 0; i < shape.size(); ++i) {
    before += surface(shape.points[i]);
    after += surface(at(result, i));
  }
  return before / after;
}

TEST(Denoise, shrinksTheErrorAtLeastFivefold)
{
  const double sigma = 0.01 * std::sqrt(3.0); // 1 % of the diagonal
  EXPECT_GT(improvement(cube(30000, sigma, 1), cubeDistance), 5.0);
  EXPECT_GT(improvement(sphere(30000, sigma, 2), sphereDistance), 5.0);
}

TEST(Denoise, zeroIterationsMoveNothing)
{
  const Cloud cloud(cube(6000, 0.01, 3));
  DenoiseParameters parameters;
  parameters.gpf.maximum_iterations = 0;
  const DenoiseResult result = denoise(cloud.input(), parameters);
  ASSERT_EQ(result.x.size(), cloud.size());
  const DenoiseInput input = cloud.input();
  for (std::size_t i = 0; i < cloud.size(); ++i)
    ASSERT_TRUE(result.x[i] == input.x[i] && result.y[i] == input.y[i] && result.z[i] == input.z[i]) << i;
}

TEST(Denoise, keepsEveryPointInOrderByDefault)
{
  const Cloud cloud(cube(2000, 0.01, 1));
  const DenoiseResult result = denoise(cloud.input(), {});
  ASSERT_EQ(result.x.size(), cloud.size());
  EXPECT_EQ(result.non_finite_points, 0u);
  EXPECT_EQ(result.estimated_normals, cloud.size());
  // Three lengths of each of three scales (edges are thin here), the quadrics' and the limit of moves; no steered fit below 0.75 spacings.
  EXPECT_EQ(result.parameters.size(), 11u);
  EXPECT_FALSE(result.iterations.empty());
  EXPECT_EQ(result.fine.size(), cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    ASSERT_EQ(result.sample_indices[i], i);
    ASSERT_LT(distance(at(result, i), {cloud.x[i], cloud.y[i], cloud.z[i]}), 0.2);
    ASSERT_NEAR(distance(normalAt(result, i), {0, 0, 0}), 1.0, 1e-5);
  }
}

/** A unit square with a round boss of the given height in the middle. */
Shape
bossed(std::size_t count, double height, double noise, std::uint64_t seed)
{
  return sampleShape(count, noise, seed, [height](SplitMix64& random, Vector3& point, Vector3& normal) {
    const double x = random.uniform(), y = random.uniform();
    point = {x, y, std::hypot(x - 0.5, y - 0.5) < 0.06 ? height : 0.0};
    normal = {0, 0, 1};
  });
}

TEST(Denoise, twoScalesKeepABossThatTheCoarseOneTakesAway)
{
  const double noise = 0.006, height = 0.02;
  const Shape shape = bossed(30000, height, noise, 4);
  const Cloud cloud(shape);
  DenoiseParameters coarse_only;
  coarse_only.two_scales = false;
  const DenoiseResult two = denoise(cloud.input(), {}), one = denoise(cloud.input(), coarse_only);
  EXPECT_TRUE(one.fine.empty());
  EXPECT_TRUE(one.fine_iterations.empty());
  double error_of_two = 0, error_of_one = 0;
  std::size_t on = 0, fine_on = 0;
  for (std::size_t i = 0; i < shape.size(); ++i) {
    if (std::hypot(shape.points[i][0] - 0.5, shape.points[i][1] - 0.5) > 0.045)
      continue;
    ++on;
    fine_on += two.fine[i];
    error_of_two += std::abs(two.z[i] - height);
    error_of_one += std::abs(one.z[i] - height);
  }
  EXPECT_EQ(fine_on, on);
  EXPECT_LT(error_of_two, 0.8 * error_of_one);
  EXPECT_LT(std::accumulate(two.fine.begin(), two.fine.end(), 0.0), 0.2 * static_cast<double>(shape.size()));
}

TEST(Denoise, twoScalesLeaveTheNoisyHalfOfAPlaneAsFlatAsOneDoes)
{
  for (const double factor : {1.5, 3.0}) {
    Shape shape = plane(20000, 0, 5);
    SplitMix64 random(6);
    for (Vector3& p : shape.points)
      p[2] += (p[0] < 0.5 ? 0.01 : 0.01 * factor) * random.normal();
    DenoiseParameters one_scale;
    one_scale.two_scales = false;
    const DenoiseResult two = denoise(Cloud(shape).input(), {}), one = denoise(Cloud(shape).input(), one_scale);
    double error_of_two = 0, error_of_one = 0;
    for (std::size_t i = 0; i < shape.size(); ++i)
      if (shape.points[i][0] >= 0.5) {
        error_of_two += std::abs(two.z[i]);
        error_of_one += std::abs(one.z[i]);
      }
    EXPECT_LT(error_of_two, 1.2 * error_of_one) << factor;
  }
}

TEST(Denoise, oneScaleWhereTheUserSetsALengthOrPointsMoveSideways)
{
  const Cloud cloud(cube(3000, 0.01, 1));
  std::vector<DenoiseParameters> all(5);
  all[0].gpf.support_radius = 0.3;
  all[1].bilateral.neighbors = 20;
  all[2].gpf.repulsion_weight = 0.1;
  all[3].gpf = GPFParameters::paper();
  all[4].gpf.gap_iterations = 1;
  for (const DenoiseParameters& p : all)
    EXPECT_TRUE(denoise(cloud.input(), p).fine.empty());
}

TEST(Denoise, fillsTheBandBesideEdgesAndTakesNoneOfItsMovesForAnOutlier)
{
  const Shape shape = cube(12000, 0.012, 1);
  const Cloud cloud(shape);
  DenoiseParameters p;
  p.gpf = GPFParameters::paper();
  p.gpf.variance_update = VarianceUpdate::Fixed;
  p.gpf.posterior_normalization = false;
  const auto measure = [&](double& band, double& error, double& outliers) {
    const DenoiseResult result = denoise(cloud.input(), p);
    std::vector<Vector3> points, normals;
    error = outliers = 0;
    for (std::size_t i = 0; i < result.x.size(); ++i) {
      points.push_back(at(result, i));
      normals.push_back({result.normal_x[i], result.normal_y[i], result.normal_z[i]});
      error += distanceToUnitCube(points.back());
      outliers += result.outlier[i] > DenoiseResult::kOutlier;
    }
    band = cubeBand(points, normals);
    EXPECT_EQ(result.gap_iterations.size(), p.gpf.gap_iterations);
  };
  double band = 0, error = 0, outliers = 0, band_after = 0, error_after = 0, outliers_after = 0;
  measure(band, error, outliers);
  p.gpf.gap_iterations = 2;
  measure(band_after, error_after, outliers_after);
  EXPECT_GE(band, 3.0);
  EXPECT_LE(band_after, 1.5);
  EXPECT_LE(error_after, 1.05 * error);
  EXPECT_LE(outliers_after, outliers + 6); // of 6000: where points are put counts, too
}

TEST(Denoise, gapFillingLeavesACleanCloudAsItIs)
{
  const Shape shape = cube(6000);
  DenoiseParameters p;
  p.gpf.normal_weight_floor = 1.0; // draws points onto edges, where the limit of moves takes them back
  p.gpf.gap_iterations = 2;
  const DenoiseResult result = denoise(Cloud(shape).input(), p);
  EXPECT_TRUE(std::isinf(result.max_move));
  std::size_t moved = 0;
  for (std::size_t i = 0; i < shape.size(); ++i)
    moved += distance(at(result, i), shape.points[i]) > 1e-6;
  EXPECT_LT(moved, shape.size() / 100);
}

TEST(Denoise, noMoveIsLongerThanTheLimit)
{
  const Shape shape = cube(5000, 0.02, 1);
  const Cloud cloud(shape);
  for (const bool paper : {false, true}) {
    DenoiseParameters p;
    if (paper)
      p.gpf = GPFParameters::paper();
    p.max_move = 0.01;
    const DenoiseResult result = denoise(cloud.input(), p);
    EXPECT_GT(result.limited_points, 0u);
    for (std::size_t i = 0; i < result.x.size(); ++i)
      ASSERT_LE(distance(at(result, i), shape.points[result.sample_indices[i]]), 0.01);
  }
  for (const double wrong : {-1.0, kNaN}) {
    DenoiseParameters p;
    p.max_move = wrong;
    EXPECT_THROW(denoise(cloud.input(), p), InvalidParameter);
  }
}

TEST(Denoise, unevenNoiseLimitsNoMove)
{
  std::vector<Vector3> points = plane(20000, 0, 5).points;
  SplitMix64 random(6);
  for (Vector3& p : points)
    p[2] += (p[0] < 0.2 ? 0.001 : 0.01) * random.normal(); // the noise is that of the quiet fifth
  Cloud uneven;
  for (const Vector3& p : points)
    uneven.add(p);
  EXPECT_TRUE(std::isinf(denoise(uneven.input(), {}).max_move));
}

/** Mean distance of a result, or of the input itself, from the surface of its shape. */
double
meanError(const std::vector<Vector3>& points, bool ball)
{
  double sum = 0;
  for (const Vector3& p : points) {
    double outside = 0, inside = -1;
    for (const double c : p) {
      outside += std::pow(std::max(0.0, std::abs(c - 0.5) - 0.5), 2);
      inside = std::max(inside, std::abs(c - 0.5) - 0.5);
    }
    sum += ball ? std::abs(distance(p, {0, 0, 0}) - 0.5) : std::abs(std::sqrt(outside) + std::min(inside, 0.0));
  }
  return sum / static_cast<double>(points.size());
}

TEST(Denoise, aFewPointsAreNoWorseAfterwards)
{
  for (const std::size_t count : {10u, 47u, 100u, 200u, 300u, 500u})
    for (const double share : {0.0, 0.005, 0.01}) // of the diagonal
      for (const bool ball : {false, true}) {
        const Shape shape = ball ? sphere(count, share * std::sqrt(3.0), 3) : cube(count, share * std::sqrt(3.0), 3);
        const DenoiseResult result = denoise(Cloud(shape).input(), {});
        std::vector<Vector3> after;
        for (std::size_t i = 0; i < count; ++i)
          after.push_back(at(result, i));
        EXPECT_LE(meanError(after, ball), 1.02 * meanError(shape.points, ball) + 1e-9)
            << count << " points, noise " << share << (ball ? ", sphere" : ", cube");
        const auto flagged = std::count_if(result.outlier.begin(), result.outlier.end(), [](float q) { return q > 0.5f; });
        EXPECT_LE(static_cast<double>(flagged), count < 200 ? 0.0 : 0.05 * static_cast<double>(count)) << count;
      }
  const Shape flat = plane(200, 0.005, 1); // where they do fit, they are used
  const DenoiseResult result = denoise(Cloud(flat).input(), {});
  double before = 0, after = 0;
  for (std::size_t i = 0; i < flat.size(); ++i) {
    before += std::abs(flat.points[i][2]);
    after += std::abs(result.z[i]);
  }
  EXPECT_LT(after, 0.7 * before);
}

TEST(Denoise, leavesACleanCloudAsItIs)
{
  for (const Shape& shape : {cube(20000), sphere(20000), plane(20000)}) {
    const DenoiseResult result = denoise(Cloud(shape).input(), {});
    double moved = 0;
    for (std::size_t i = 0; i < shape.size(); ++i)
      moved += distance(at(result, i), shape.points[i]);
    EXPECT_LE(moved / static_cast<double>(shape.size()), 1e-3 * result.scale.spacing);
  }
}

TEST(Denoise, takesTheShareOfPointsThatIsAskedFor)
{
  const Cloud cloud(cube(2001, 0.01, 1));
  DenoiseParameters p;
  p.gpf.sample_ratio = 0.25;
  const DenoiseResult result = denoise(cloud.input(), p);
  EXPECT_EQ(result.x.size(), 500u);
  EXPECT_TRUE(std::is_sorted(result.sample_indices.begin(), result.sample_indices.end()));
  for (std::size_t i = 0; i < result.x.size(); ++i) {
    const std::uint32_t row = result.sample_indices[i];
    ASSERT_LT(distance(at(result, i), {cloud.x[row], cloud.y[row], cloud.z[row]}), 0.2);
  }
  p.gpf.seed = 1;
  EXPECT_NE(denoise(cloud.input(), p).sample_indices, result.sample_indices);
  p.gpf.sample_ratio = 1e-9;
  EXPECT_EQ(denoise(cloud.input(), p).x.size(), 1u);
}

TEST(Denoise, givesTheSameBitsForAnyNumberOfThreads)
{
  const Cloud cloud(cube(6000, 0.01, 2));
  for (DenoiseParameters& p : modes()) {
    p.number_of_threads = 1;
    const DenoiseResult expected = denoise(cloud.input(), p);
    for (const unsigned threads : {2u, 3u, 7u}) {
      p.number_of_threads = threads;
      EXPECT_TRUE(sameBits(denoise(cloud.input(), p), expected)) << threads << " threads";
    }
  }
}

TEST(Denoise, doesNotDependOnTheOrderOfTheRows)
{
  const Cloud cloud(cube(3000, 0.01, 3));
  std::vector<std::uint32_t> row(cloud.size());
  std::iota(row.begin(), row.end(), 0u);
  SplitMix64 random(1);
  for (std::size_t i = row.size(); i-- > 1;)
    std::swap(row[i], row[random.below(i + 1)]);
  Cloud permuted;
  for (const std::uint32_t r : row)
    permuted.add({cloud.x[r], cloud.y[r], cloud.z[r]});
  const DenoiseResult expected = denoise(cloud.input(), {}), found = denoise(permuted.input(), {});
  for (std::size_t i = 0; i < row.size(); ++i)
    ASSERT_LE(distance(at(found, i), at(expected, row[i])), 1e-12);
}

TEST(Denoise, scalesWithTheUnitOfLength)
{
  const Shape shape = turned(cube(3000, 0.01, 4));
  const Cloud cloud(shape);
  for (const DenoiseParameters& p : modes()) {
    const DenoiseResult expected = denoise(cloud.input(), p);
    for (const double scale : {1e-6, 1e-3, 1e3, 1e6}) {
      Cloud scaled;
      for (const Vector3& q : shape.points)
        scaled.add({scale * q[0], scale * q[1], scale * q[2]});
      const DenoiseResult found = denoise(scaled.input(), p);
      for (std::size_t i = 0; i < expected.x.size(); ++i)
        ASSERT_LE(distance({found.x[i] / scale, found.y[i] / scale, found.z[i] / scale}, at(expected, i)), 1e-6);
      EXPECT_NEAR(found.scale.spacing / scale, expected.scale.spacing, 1e-6);
    }
  }
}

TEST(Denoise, movesWithARigidMotion)
{
  // Radii are given: estimates are medians over probes, which follow the curve through the (turned) box.
  const Shape shape = cube(4000, 0.01, 5);
  DenoiseParameters p;
  p.normals.radius = 0.12;
  p.bilateral.radius = 0.2;
  p.gpf.support_radius = 0.3;
  const DenoiseResult expected = denoise(Cloud(shape).input(), p);
  Cloud moved;
  for (const Vector3& q : shape.points) {
    const Vector3 r = turned(q);
    moved.add({r[0] + 10, r[1] - 20, r[2] + 30});
  }
  const DenoiseResult found = denoise(moved.input(), p);
  std::size_t apart = 0;
  double largest = 0;
  for (std::size_t i = 0; i < shape.size(); ++i) {
    const Vector3 r = turned(at(expected, i));
    const double error = distance(at(found, i), {r[0] + 10, r[1] - 20, r[2] + 30});
    largest = std::fmax(largest, error);
    apart += error > 1e-5 * std::sqrt(3.0);
  }
  // A pair at the very edge of a ball may be in on one side and out on the other.
  EXPECT_LT(apart, shape.size() / 20);
  EXPECT_LT(largest, 2e-3);
}

TEST(Denoise, keepsMillimetresInUtmCoordinates)
{
  Shape survey = turned(cube(5000, 0, 6));
  SplitMix64 random(2);
  for (Vector3& q : survey.points)
    for (double& c : q)
      c = std::round(1000 * (10 * c + 0.05 * random.normal())) / 1000; // metres, in millimetres
  Cloud utm;
  for (const Vector3& q : survey.points)
    utm.add({q[0] + 5e5, q[1] + 4e6, q[2]});
  const DenoiseResult expected = denoise(Cloud(survey).input(), {}), found = denoise(utm.input(), {});
  ASSERT_EQ(found.x.size(), expected.x.size());
  std::size_t apart = 0;
  for (std::size_t i = 0; i < found.x.size(); ++i) {
    const double error = distance({found.x[i] - 5e5, found.y[i] - 4e6, found.z[i]}, at(expected, i));
    apart += error > 1e-5; // a hundredth of one
    EXPECT_LT(error, 0.02) << i;
  }
  // Where both scales serve equally well, the last bit of the coordinates decides.
  EXPECT_LT(apart, found.x.size() / 200);
  EXPECT_GT(largestDistance(found, denoise(utm.input(), [] { DenoiseParameters p; p.gpf.maximum_iterations = 0; return p; }())), 0.01);
}

TEST(Denoise, leavesRowsOutThatAreNotFinite)
{
  const Cloud clean(cube(1500, 0.01, 7));
  Cloud holes;
  std::vector<std::uint32_t> rows;
  for (std::size_t i = 0; i < clean.size(); ++i) {
    if (i % 3 == 0)
      holes.add(i % 2 == 0 ? Vector3{kNaN, 0, 0} : Vector3{0, 0, -std::numeric_limits<double>::infinity()});
    rows.push_back(static_cast<std::uint32_t>(holes.size()));
    holes.add({clean.x[i], clean.y[i], clean.z[i]});
  }
  for (const DenoiseParameters& p : modes()) {
    const DenoiseResult expected = denoise(clean.input(), p), found = denoise(holes.input(), p);
    EXPECT_EQ(found.non_finite_points, 500u);
    EXPECT_EQ(largestDistance(found, expected), 0.0);
    for (std::size_t i = 0; i < expected.x.size(); ++i)
      ASSERT_EQ(found.sample_indices[i], rows[expected.sample_indices[i]]);
  }
}

TEST(Denoise, copiesToTheLastBitWithoutIterations)
{
  Cloud cloud(turned(cube(500, 0.01, 8)));
  cloud.x[7] = -0.0;
  for (double& x : cloud.x)
    x *= 1234567.0 / 3;
  DenoiseParameters p;
  p.gpf.maximum_iterations = 0;
  const DenoiseResult result = denoise(cloud.input(), p);
  EXPECT_TRUE(result.iterations.empty());
  EXPECT_EQ(std::memcmp(result.x.data(), cloud.x.data(), cloud.size() * sizeof(double)), 0);
  EXPECT_EQ(std::memcmp(result.y.data(), cloud.y.data(), cloud.size() * sizeof(double)), 0);
  EXPECT_EQ(std::memcmp(result.z.data(), cloud.z.data(), cloud.size() * sizeof(double)), 0);
}

TEST(Denoise, leavesAnOutlierToTheLastBit)
{
  Cloud cloud(turned(sphere(2000, 0.01, 9)));
  cloud.add({2.1, 2.2, 2.3});
  const DenoiseResult result = denoise(cloud.input(), {});
  EXPECT_EQ(at(result, 2000), (Vector3{2.1, 2.2, 2.3}));
  EXPECT_EQ(result.isolated[2000], 1);
  EXPECT_EQ(std::count(result.isolated.begin(), result.isolated.end(), std::uint8_t{1}), 1);
  EXPECT_EQ(result.iterations.back().isolated_points, 1u);
}

TEST(Denoise, countsIsolatedPointsInEveryMode)
{
  Cloud cloud(turned(sphere(2000, 0.01, 9)));
  for (int i = 0; i < 3; ++i)
    cloud.add({2.0 + i, 2.2, 2.3});
  DenoiseParameters exact; // runs in double
  exact.gpf.posterior_normalization = exact.gpf.density_weights = true;
  EXPECT_EQ(denoise(cloud.input(), exact).iterations.back().isolated_points, 3u);
  DenoiseParameters weighted;
  weighted.gpf.density_weights = true;
  EXPECT_EQ(denoise(cloud.input(), weighted).iterations.back().isolated_points, 3u);
}

TEST(Denoise, filtersBesideAnOutlierHoweverFarItIs)
{
  const Shape shape = cube(4000, 0.01, 3);
  const Cloud alone(shape);
  const DenoiseResult expected = denoise(alone.input(), {});
  for (const double far : {1e3, 1e6, 1e9}) {
    Cloud cloud(shape);
    cloud.add({far, far, -far});
    const DenoiseResult result = denoise(cloud.input(), {});
    ASSERT_EQ(result.x.size(), alone.size() + 1);
    EXPECT_EQ(result.x.back(), far);
    EXPECT_NEAR(result.scale.spacing, expected.scale.spacing, 0.02 * expected.scale.spacing) << far;
    double sum = 0;
    for (std::size_t i = 0; i < alone.size(); ++i)
      sum += std::hypot(result.x[i] - expected.x[i], result.y[i] - expected.y[i], result.z[i] - expected.z[i]);
    EXPECT_LT(sum / static_cast<double>(alone.size()), 1e-3) << far; // a tenth of the noise; the estimates differ a little
  }
}

TEST(Denoise, refusesAnOutlierBesideWhichNothingCanBeToldApart)
{
  const Shape shape = cube(1000, 0.01, 3);
  for (const double far : {1e22, static_cast<double>(std::numeric_limits<float>::max()), 1e300}) {
    Cloud cloud(shape);
    cloud.add({far, 0, 0});
    try {
      denoise(cloud.input(), {});
      ADD_FAILURE() << far;
    } catch (const UnsuitableData& error) {
      EXPECT_NE(std::string(error.what()).find("row 1000 "), std::string::npos) << error.what();
    }
  }
  Cloud pile; // 1 % of the points beside a pile of invalid returns: not the same
  for (int i = 0; i < 9900; ++i)
    pile.add({0, 0, 0});
  for (int i = 0; i < 100; ++i)
    pile.add(shape.points[static_cast<std::size_t>(i)]);
  EXPECT_EQ(denoise(pile.input(), {}).x.size(), 10000u);
}

TEST(Denoise, survivesARadiusBeyondEverything)
{
  for (const std::size_t count : {20u, 2000u})
    for (const double radius : {1e3, 1e15, 1e20, 1e300}) {
      const Cloud cloud(cube(count, 0.01, 3));
      DenoiseParameters parameters;
      parameters.normals.radius = parameters.bilateral.radius = parameters.gpf.support_radius = radius;
      const DenoiseResult result = denoise(cloud.input(), parameters);
      for (std::size_t i = 0; i < cloud.size(); ++i)
        ASSERT_TRUE(std::isfinite(result.x[i]) && std::abs(result.x[i]) < 2.0) << radius;
    }
}

TEST(Denoise, normalisesForeignNormalsAndEstimatesTheMissing)
{
  const Shape shape = turned(cube(2000, 0.01, 10));
  const DenoiseResult expected = denoise(Cloud(shape, true).input(), {});
  EXPECT_EQ(expected.estimated_normals, 0u);

  Cloud longer(shape, true);
  for (auto* axis : {&longer.normal_x, &longer.normal_y, &longer.normal_z})
    for (float& n : *axis)
      n *= 50;
  EXPECT_LT(largestDistance(denoise(longer.input(), {}), expected), 1e-5);

  Cloud spoiled(shape, true);
  for (std::size_t i = 0; i < shape.size(); i += 10) {
    spoiled.normal_x[i] = i % 20 == 0 ? 0.0f : std::numeric_limits<float>::quiet_NaN();
    spoiled.normal_y[i] = spoiled.normal_z[i] = 0.0f;
  }
  spoiled.normal_x[1] = std::numeric_limits<float>::infinity();
  const DenoiseResult found = denoise(spoiled.input(), {});
  EXPECT_EQ(found.estimated_normals, 201u);
  for (std::size_t i = 0; i < shape.size(); ++i) {
    ASSERT_NEAR(distance(normalAt(found, i), {0, 0, 0}), 1.0, 1e-5);
    ASSERT_LT(distance(at(found, i), at(expected, i)), 0.1);
  }
}

TEST(Denoise, refusesDataThatCannotBeFiltered)
{
  EXPECT_THROW(denoise({}, {}), UnsuitableData);
  Cloud cloud;
  cloud.add({kNaN, 1, 2});
  EXPECT_THROW(denoise(cloud.input(), {}), UnsuitableData);
  EXPECT_THROW(denoiseNormals(cloud.input(), {}), UnsuitableData);
  cloud.add({5e5, 4e6, 2});
  EXPECT_THROW(denoise(cloud.input(), {}), UnsuitableData) << "one finite point";
  for (int i = 0; i < 50; ++i)
    cloud.add({5e5, 4e6, 2});
  EXPECT_THROW(denoise(cloud.input(), {}), UnsuitableData) << "one place";
  Cloud endless;
  endless.add({-1.7e308, 0, 0});
  endless.add({1.7e308, 0, 0});
  EXPECT_THROW(denoise(endless.input(), {}), UnsuitableData);
}

TEST(Denoise, takesDegenerateClouds)
{
  std::vector<Cloud> clouds(5);
  clouds[0].add({0, 0, 0});
  clouds[0].add({1, 1, 1});
  clouds[1] = clouds[0];
  clouds[1].add({1, 0, 0});
  for (int i = 0; i < 200; ++i) {
    clouds[2].add({0.1 * i, 0.2 * i, -0.3 * i});                   // a line
    clouds[3].add(i % 2 == 0 ? Vector3{0, 0, 0} : Vector3{1, 2, 3}); // two piles
    clouds[4].add({1e300 * i, -1e300 * (i % 7), 0});               // far apart
  }
  for (std::size_t c = 0; c < clouds.size(); ++c)
    for (const DenoiseParameters& p : modes()) {
      const DenoiseResult result = denoise(clouds[c].input(), p);
      ASSERT_FALSE(result.x.empty());
      for (std::size_t i = 0; i < result.x.size(); ++i)
        ASSERT_TRUE(std::isfinite(result.x[i]) && std::isfinite(result.y[i]) && std::isfinite(result.z[i])) << "cloud " << c;
    }
}

TEST(Denoise, refusesParametersOutsideTheirRange)
{
  const Cloud cloud(cube(100));
  const auto refused = [&](auto change) {
    DenoiseParameters p;
    change(p);
    EXPECT_THROW(denoise(cloud.input(), p), InvalidParameter);
  };
  for (const double bad : {-1.0, kNaN, std::numeric_limits<double>::infinity()}) {
    refused([bad](DenoiseParameters& p) { p.normals.radius = bad; });
    refused([bad](DenoiseParameters& p) { p.bilateral.radius = bad; });
    refused([bad](DenoiseParameters& p) { p.gpf.support_radius = bad; });
  }
}

TEST(Denoise, canBeCancelledAtEveryReportOfEveryStage)
{
  const Cloud cloud(cube(500, 0.01, 1));
  std::vector<std::string> stages;
  denoise(cloud.input(), {}, [&](const std::string& stage, double fraction) {
    EXPECT_TRUE(fraction >= 0 && fraction <= 1);
    stages.push_back(stage);
    return true;
  });
  for (const char* stage : {"normals", "bilateral", "filter"})
    EXPECT_GT(std::count(stages.begin(), stages.end(), stage), 0) << stage;
  for (std::size_t stop = 0; stop < stages.size(); ++stop) {
    std::size_t calls = 0;
    EXPECT_THROW(denoise(cloud.input(), {}, [&](const std::string&, double) { return calls++ < stop; }), Cancelled) << stages[stop];
  }
}

TEST(DenoiseNormals, givesAUnitNormalForEveryFiniteRow)
{
  const Shape shape = turned(cube(10000, 0.01, 2));
  Cloud cloud(shape);
  cloud.x[5] = kNaN;
  const DenoiseResult result = denoiseNormals(cloud.input(), {});
  ASSERT_EQ(result.normal_x.size(), cloud.size());
  EXPECT_TRUE(std::isnan(result.normal_x[5]) && std::isnan(result.normal_y[5]) && std::isnan(result.normal_z[5]));
  DenoiseParameters planes_only;
  planes_only.bilateral.iterations = 0;
  const DenoiseResult planes = denoiseNormals(cloud.input(), planes_only);
  double angles = 0, angles_of_planes = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (i != 5) {
      ASSERT_NEAR(distance(normalAt(result, i), {0, 0, 0}), 1.0, 1e-5);
      angles += lineAngle(normalAt(result, i), shape.normals[i]);
      angles_of_planes += lineAngle(normalAt(planes, i), shape.normals[i]);
    }
  EXPECT_LT(angles, 0.75 * angles_of_planes);
}

} // namespace
} // namespace pcl_gpf::test
