// SPDX-License-Identifier: BSD-3-Clause
#include "support/literal_rimls.h"

#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/operators/rimls.h>

#include <gtest/gtest.h>

#include <limits>
#include <numeric>

namespace pcl_gpf::test {
namespace {

/** f and grad f of many positions. */
struct Field {
  explicit Field(const RimlsSurface& surface, const SoaBuffer& x) : value(x.size()), inside(x.size()), gradient(x.size())
  {
    surface.evaluate(x.view(), {value.data(), gradient.view(), inside.data()});
  }
  std::vector<float> value;
  std::vector<std::uint8_t> inside;
  SoaBuffer gradient;
};

RimlsSurface
surfaceOf(const LocalCloud& cloud, const RimlsParameters& p)
{
  return {p, cloud.points.view(), cloud.normals.view()};
}

/** Positions about the cloud: some on it, most near it, some far. */
SoaBuffer
positionsNear(const LocalCloud& cloud, std::size_t count, double distance)
{
  SplitMix64 random(11);
  std::vector<Vector3> positions;
  for (std::size_t k = 0; k < count; ++k) {
    Vector3 x = cloud.v[random.below(cloud.size())];
    for (double& component : x)
      component += k % 20 == 0 ? 0.0 : (k % 20 == 1 ? 8 : 1) * distance * random.normal();
    positions.push_back(x);
  }
  return toBuffer(positions);
}

void
compareWithFormula(const LocalCloud& cloud, const RimlsParameters& p)
{
  const RimlsSurface surface = surfaceOf(cloud, p);
  const SoaBuffer positions = positionsNear(cloud, 400, surface.spacing());
  const std::vector<Vector3> x = toVectors(positions);
  const Field field(surface, positions);
  const std::vector<Vector3> gradient = toVectors(field.gradient);
  const LiteralRimls literal(p, cloud.v, cloud.b);
  std::size_t undecided = 0, inside = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const LiteralRimls::Value expected = literal.evaluate(x[k]);
    if (expected.undecided) {
      ++undecided;
      continue;
    }
    ASSERT_EQ(field.inside[k] != 0, expected.inside) << k;
    if (!expected.inside) {
      EXPECT_TRUE(std::isnan(field.value[k]));
      EXPECT_EQ(gradient[k], (Vector3{0, 0, 0}));
      continue;
    }
    ++inside;
    EXPECT_NEAR(field.value[k], expected.f, 1e-4 * surface.spacing()) << k;
    EXPECT_LE(distance(gradient[k], expected.gradient), 1e-3 * (1 + distance(expected.gradient, {0, 0, 0}))) << k;
  }
  EXPECT_GT(inside, 200u);
  EXPECT_LT(inside, x.size());
  EXPECT_LT(undecided, x.size() / 10);
}

TEST(Rimls, equalsTheFormula)
{
  for (const double scale : {2.0, 4.0})
    for (const double sigma_r : {0.0, 0.5}) {
      RimlsParameters p;
      p.scale = scale;
      p.sigma_r = sigma_r;
      compareWithFormula(toLocalCloud(turned(cube(1500, 0.01, 1))), p);
      compareWithFormula(toLocalCloud(turned(sphere(1500, 0.005, 2))), p);
    }
  RimlsParameters global;
  global.radius = 0.12;
  compareWithFormula(toLocalCloud(turned(edge(1500, 0.01, 3))), global);
  RimlsParameters plain;
  plain.fits = 1;
  compareWithFormula(toLocalCloud(turned(cube(1500, 0.01, 1))), plain);
}

TEST(Rimls, radiiAreThoseOfThe16thNeighborTimesScale)
{
  const LocalCloud cloud = toLocalCloud(turned(edge(800, 0.01, 3)));
  RimlsParameters p;
  p.scale = 3;
  const LiteralRimls literal(p, cloud.v, cloud.b);
  const std::vector<float> radii = surfaceOf(cloud, p).supportRadii();
  for (std::size_t i = 0; i < radii.size(); ++i)
    EXPECT_NEAR(radii[i], 3 * literal.r[i], 1e-5 * literal.r[i]);
}

TEST(Rimls, fIsTheSignedDistanceOfAPlane)
{
  const LocalCloud cloud = toLocalCloud(turned(plane(2000)));
  const RimlsSurface surface = surfaceOf(cloud, {});
  const Vector3 up = cloud.b[0];
  std::vector<Vector3> x;
  std::vector<double> heights;
  for (const double height : {-1.0, -0.3, 0.0, 0.5, 1.0})
    for (std::size_t i = 0; i < 100; ++i) {
      heights.push_back(height);
      x.push_back(cloud.v[i]);
      for (std::size_t axis = 0; axis < 3; ++axis)
        x.back()[axis] += height * surface.spacing() * up[axis];
    }
  const Field field(surface, toBuffer(x));
  const std::vector<Vector3> gradient = toVectors(field.gradient);
  for (std::size_t k = 0; k < x.size(); ++k) {
    EXPECT_NEAR(field.value[k], heights[k] * surface.spacing(), 1e-4 * surface.spacing());
    EXPECT_LE(distance(gradient[k], up), 1e-3);
  }
}

/** MeshLab's projection of every point, beside ours. */
void
compareProjections(const LocalCloud& cloud, double scale)
{
  RimlsParameters p;
  p.scale = scale;
  const RimlsSurface surface = surfaceOf(cloud, p);
  SoaBuffer moved = toBuffer(cloud.v), normals(cloud.size());
  std::vector<RimlsState> states(cloud.size());
  const RimlsProjectionStatistics statistics = surface.project(moved.view(), normals.view(), states.data());
  const std::vector<Vector3> x = toVectors(moved), n = toVectors(normals);
  EXPECT_EQ(statistics.converged + statistics.too_many_steps + statistics.outside, cloud.size());

  const LiteralRimls literal(p, cloud.v, cloud.b);
  std::size_t both = 0, apart = 0;
  for (std::size_t i = 0; i < cloud.size(); i += 5) {
    Vector3 expected = cloud.v[i], normal{0, 0, 0};
    if (!literal.project(expected, normal, surface.spacing()) || states[i] != RimlsState::Converged)
      continue;
    ++both;
    const double move = distance(expected, cloud.v[i]);
    // To 1 % of the move, and to the accuracy at which both stop.
    if (distance(x[i], expected) > 0.01 * move + 2 * p.accuracy * surface.spacing())
      ++apart; // another number of fits on the way, decided by rounding
    else
      EXPECT_LE(distance(n[i], normal), 2e-2) << i;
  }
  EXPECT_GT(both, cloud.size() / 5 * 9 / 10);
  EXPECT_LE(apart, both / 100);
}

TEST(Rimls, projectsAsMeshLabDoes)
{
  compareProjections(toLocalCloud(turned(sphere(2000, 0.01, 4))), 4);
  compareProjections(toLocalCloud(turned(cube(2000, 0.01, 5))), 4);
  compareProjections(toLocalCloud(turned(cube(2000, 0.005, 5))), 2);
}

TEST(Rimls, projectionTakesNoiseAwayAndKeepsTheEdge)
{
  const Shape clean = turned(cube(8000, 0, 6)), noisy = turned(cube(8000, 0.01, 6));
  const LocalCloud cloud = toLocalCloud(noisy);
  const RimlsSurface surface = surfaceOf(cloud, {});
  SoaBuffer x = toBuffer(cloud.v), n(cloud.size());
  surface.project(x.view(), n.view());
  // The cube in the frame of the cloud, undone by the inverse of `turned`: distances from faces through known normals instead.
  BoundingBox box;
  for (const Vector3& p : noisy.points)
    box.add(p[0], p[1], p[2]);
  const LocalFrame frame = localFrame(box);
  double before = 0, after = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    double height_before = 0, height_after = 0;
    const Vector3 moved = {frame.toWorld(x.x[i], 0), frame.toWorld(x.y[i], 1), frame.toWorld(x.z[i], 2)};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      height_before += (noisy.points[i][axis] - clean.points[i][axis]) * clean.normals[i][axis];
      height_after += (moved[axis] - clean.points[i][axis]) * clean.normals[i][axis];
    }
    before += std::abs(height_before);
    after += std::abs(height_after);
  }
  EXPECT_LT(after, before / 3);
}

TEST(Rimls, positionsOutsideStayAndAreSaidToBe)
{
  const LocalCloud cloud = toLocalCloud(turned(sphere(1000)));
  const RimlsSurface surface = surfaceOf(cloud, {});
  SoaBuffer x = toBuffer({{0, 0, 0}, cloud.v[0], {5, 5, 5}}), n(3);
  RimlsState states[3];
  const RimlsProjectionStatistics statistics = surface.project(x.view(), n.view(), states);
  EXPECT_EQ(states[0], RimlsState::Outside);
  EXPECT_EQ(states[1], RimlsState::Converged);
  EXPECT_EQ(states[2], RimlsState::Outside);
  EXPECT_EQ(statistics.outside, 2u);
  EXPECT_EQ(toVectors(x)[0], (Vector3{0, 0, 0}));
  EXPECT_EQ(toVectors(x)[2], (Vector3{5, 5, 5}));
  EXPECT_EQ(toVectors(n)[2], (Vector3{0, 0, 0}));
}

TEST(Rimls, oppositeNormalsGiveTheOppositeFunction)
{
  const LocalCloud cloud = toLocalCloud(turned(cube(1500, 0.01, 7)));
  std::vector<Vector3> flipped = cloud.b;
  for (Vector3& normal : flipped)
    for (double& component : normal)
      component = -component;
  const SoaBuffer flipped_normals = toBuffer(flipped);
  const RimlsSurface surface = surfaceOf(cloud, {}), other({}, cloud.points.view(), flipped_normals.view());
  const SoaBuffer x = positionsNear(cloud, 500, surface.spacing());
  const Field a(surface, x), b(other, x);
  for (std::size_t k = 0; k < x.size(); ++k)
    EXPECT_TRUE(!a.inside[k] || a.value[k] == -b.value[k]) << k;
}

TEST(Rimls, sortedPointsAndAnotherOrderOfPointsAreTheSameSurface)
{
  const LocalCloud cloud = toLocalCloud(turned(cube(1500, 0.01, 8)));
  const PointIndex index(cloud.points.view());
  std::vector<Vector3> sorted;
  for (const std::uint32_t i : index.order())
    sorted.push_back(cloud.b[i]);
  const SoaBuffer sorted_normals = toBuffer(sorted);
  const RimlsSurface surface = surfaceOf(cloud, {}), same({}, index, sorted_normals.view());
  const SoaBuffer x = positionsNear(cloud, 500, surface.spacing());
  const Field a(surface, x), b(same, x);
  EXPECT_EQ(std::memcmp(a.value.data(), b.value.data(), a.value.size() * sizeof(float)), 0);
}

TEST(Rimls, hasTheSameBitsForAnyNumberOfThreadsAndGrouping)
{
  const LocalCloud cloud = toLocalCloud(turned(cube(3000, 0.01, 9)));
  RimlsParameters p;
  p.number_of_threads = 1;
  const RimlsSurface surface = surfaceOf(cloud, p);
  const SoaBuffer x = positionsNear(cloud, 3000, surface.spacing());
  const Field expected(surface, x);
  SoaBuffer expected_x = toBuffer(cloud.v), expected_n(cloud.size());
  surface.project(expected_x.view(), expected_n.view());
  for (const unsigned threads : {2u, 5u}) {
    p.number_of_threads = threads;
    const RimlsSurface other = surfaceOf(cloud, p);
    const Field field(other, x);
    EXPECT_EQ(std::memcmp(field.value.data(), expected.value.data(), field.value.size() * sizeof(float)), 0);
    EXPECT_TRUE(sameBits(field.gradient, expected.gradient));
    SoaBuffer moved = toBuffer(cloud.v), n(cloud.size());
    other.project(moved.view(), n.view());
    EXPECT_TRUE(sameBits(moved, expected_x));
    EXPECT_TRUE(sameBits(n, expected_n));
  }
  for (std::size_t k = 0; k < x.size(); k += 97) { // a position alone
    float value = 0;
    surface.evaluate({x.x.data() + k, x.y.data() + k, x.z.data() + k, 1}, {&value, {}, nullptr});
    EXPECT_EQ(std::memcmp(&value, &expected.value[k], sizeof value), 0) << k;
  }
}

TEST(Rimls, aForeignSearchChangesNothing)
{
  const LocalCloud cloud = toLocalCloud(turned(edge(1200, 0.005, 10)));
  const RimlsSurface surface = surfaceOf(cloud, {});
  SoaBuffer x = toBuffer(cloud.v), n(cloud.size()), foreign_x = toBuffer(cloud.v), foreign_n(cloud.size());
  surface.project(x.view(), n.view());
  surface.project(foreign_x.view(), foreign_n.view(), nullptr, bruteForceSearch);
  const auto a = toVectors(x), b = toVectors(foreign_x);
  std::size_t apart = 0; // sums in another order, another number of fits
  for (std::size_t i = 0; i < a.size(); ++i)
    apart += distance(a[i], b[i]) > 1e-3 * surface.spacing();
  EXPECT_LE(apart, a.size() / 200);
}

TEST(Rimls, takesHostileClouds)
{
  for (const std::size_t size : {0u, 1u, 2u, 3u, 5u, 40u}) {
    for (const bool same_place : {false, true}) {
      std::vector<Vector3> points, normals;
      for (std::size_t i = 0; i < size; ++i) {
        points.push_back({0.1 * static_cast<double>(same_place ? 0 : i), 0, 0});
        normals.push_back({0, 0, 1});
      }
      const SoaBuffer p = toBuffer(points), b = toBuffer(normals);
      const RimlsSurface surface({}, p.view(), b.view());
      SoaBuffer x = toBuffer(points), n(size);
      surface.project(x.view(), n.view());
      for (const Vector3& moved : toVectors(x))
        EXPECT_TRUE(std::isfinite(moved[0]) && std::abs(moved[2]) < 1e-6) << size;
      const Field field(surface, toBuffer({{0, 0, 1e-3}, {3, 3, 3}}));
      EXPECT_EQ(field.inside[1], 0);
      EXPECT_TRUE(std::isnan(field.value[1]));
    }
  }
}

TEST(Rimls, anOutlierDoesNotReachTheCloud)
{
  Shape shape = turned(sphere(2000));
  append(shape, {3, 0, 0}, {0, 1, 0});
  const LocalCloud cloud = toLocalCloud(shape);
  const RimlsSurface surface = surfaceOf(cloud, {});
  EXPECT_LE(surface.supportRadii().back(), 4 * 16 * 1.2 * surface.spacing());
  SoaBuffer x = toBuffer(cloud.v), n(cloud.size());
  const RimlsProjectionStatistics statistics = surface.project(x.view(), n.view());
  EXPECT_GE(statistics.converged, 2000u);
  EXPECT_LT(statistics.max_movement, surface.spacing());
}

TEST(Rimls, refusesParametersOutOfRange)
{
  const auto refused = [](const auto& change) {
    RimlsParameters p;
    change(p);
    EXPECT_THROW(validate(p), InvalidParameter);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {-1.0, 0.0, 101.0, nan})
    refused([&](RimlsParameters& p) { p.scale = bad; });
  for (const double bad : {-1.0, nan}) {
    refused([&](RimlsParameters& p) { p.radius = bad; });
    refused([&](RimlsParameters& p) { p.minimum_radius = bad; });
    refused([&](RimlsParameters& p) { p.sigma_n = bad; });
    refused([&](RimlsParameters& p) { p.sigma_r = bad; });
    refused([&](RimlsParameters& p) { p.accuracy = bad; });
    refused([&](RimlsParameters& p) { p.domain = bad; });
  }
  refused([](RimlsParameters& p) { p.fits = 0; });
  refused([](RimlsParameters& p) { p.maximum_iterations = 0; });
  refused([](RimlsParameters& p) { p.minimum_samples = 0; });
  validate(RimlsParameters());
}

TEST(Rimls, refusesToProjectWithARadiusThatHoldsEverything)
{
  const std::size_t count = 120000;
  SoaBuffer points(count), normals(count);
  SplitMix64 random(1);
  for (std::size_t i = 0; i < count; ++i) {
    points.x[i] = static_cast<float>(random.uniform()), points.y[i] = static_cast<float>(random.uniform());
    normals.z[i] = 1.0f;
  }
  RimlsParameters parameters;
  parameters.radius = 2.0;
  const RimlsSurface surface(parameters, points.view(), normals.view());
  EXPECT_THROW(surface.project(points.view(), normals.view(), nullptr, {}, [](double) { return false; }), ExcessiveWork);
}

TEST(Rimls, canBeCancelled)
{
  const LocalCloud cloud = toLocalCloud(turned(sphere(1000, 0.01, 3)));
  const RimlsSurface surface = surfaceOf(cloud, {});
  SoaBuffer x = toBuffer(cloud.v), n(cloud.size());
  EXPECT_THROW(surface.project(x.view(), n.view(), nullptr, {}, [](double fraction) { return fraction < 0.1; }), Cancelled);
}

} // namespace
} // namespace pcl_gpf::test
