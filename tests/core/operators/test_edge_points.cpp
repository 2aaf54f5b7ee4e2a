// SPDX-License-Identifier: BSD-3-Clause
#include "support/local_cloud.h"

#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/operators/edge_points.h>
#include <pcl_gpf/core/soa_buffer.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_gpf::test {
namespace {

struct Buffers {
  explicit Buffers(const Shape& shape) : points(toBuffer(shape.points)), normals(toBuffer(shape.normals)) {}
  std::vector<std::uint8_t>
  edges(const EdgePointsParameters& p) const
  {
    return edgePoints(p, points.view(), normals.view());
  }
  SoaBuffer points, normals;
};

EdgePointsParameters
parameters(double h, double spacing)
{
  EdgePointsParameters p;
  p.support_radius = h;
  p.spacing = spacing;
  return p;
}

/** The unit cube with normals turned by up to a few degrees and signs at random. */
Shape
cubeWithRoughNormals(std::size_t count)
{
  Shape shape = cube(count, 0, 3);
  SplitMix64 random(4);
  for (Vector3& n : shape.normals) {
    for (double& c : n)
      c += 0.04 * random.normal();
    const double length = (random.below(2) == 1 ? -1 : 1) * std::hypot(n[0], n[1], n[2]);
    for (double& c : n)
      c /= length;
  }
  return shape;
}

double
dotOf(const Vector3& a, const Vector3& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/** Distances to the lines in which the faces about point i meet, in double and by brute force: every neighbour belongs to the face of
 * the axis that its normal is nearest to. The largest face but the point's own comes first. */
double
literalDistance(const Shape& shape, std::size_t i, double radius)
{
  struct Face {
    Vector3 through{0, 0, 0}, normal{0, 0, 0};
    std::size_t members = 0;
  } faces[3];
  std::size_t all = 0;
  const auto axisOf = [&](std::size_t j) {
    std::size_t axis = 0;
    for (std::size_t a = 1; a < 3; ++a)
      if (std::abs(shape.normals[j][a]) > std::abs(shape.normals[j][axis]))
        axis = a;
    return axis;
  };
  for (std::size_t j = 0; j < shape.size(); ++j) {
    if (distance(shape.points[i], shape.points[j]) >= radius)
      continue;
    Face& face = faces[axisOf(j)];
    ++all;
    ++face.members;
    for (std::size_t a = 0; a < 3; ++a) {
      face.through[a] += shape.points[j][a] - shape.points[i][a];
      face.normal[a] += (shape.normals[j][axisOf(j)] < 0 ? -1 : 1) * shape.normals[j][a];
    }
  }
  double least = std::numeric_limits<double>::infinity();
  for (int f = 0; f < 3; ++f)
    for (int g = 0; g < f; ++g) {
      const double needed = std::max(3.0, 0.05 * static_cast<double>(all));
      if (static_cast<double>(faces[f].members) < needed || static_cast<double>(faces[g].members) < needed)
        continue;
      const auto height = [](const Face& face) {
        return dotOf(face.through, face.normal) / (static_cast<double>(face.members) * std::sqrt(dotOf(face.normal, face.normal)));
      };
      const double c = dotOf(faces[f].normal, faces[g].normal) /
                       std::sqrt(dotOf(faces[f].normal, faces[f].normal) * dotOf(faces[g].normal, faces[g].normal));
      const double a = height(faces[f]), b = height(faces[g]);
      least = std::min(least, std::sqrt((a * a + b * b - 2 * a * b * c) / (1 - c * c)));
    }
  return least;
}

TEST(EdgePoints, agreesWithALiteralEvaluation)
{
  const Shape shape = cubeWithRoughNormals(4000);
  const double h = 0.3;
  const std::vector<std::uint8_t> edge = Buffers(shape).edges(parameters(h, 0.04));
  std::size_t compared = 0, marked = 0;
  for (std::size_t i = 0; i < shape.size(); ++i) {
    const double d = literalDistance(shape, i, h / 2);
    if (std::abs(d - h / 4) < 1e-5)
      continue;
    ++compared;
    marked += edge[i];
    ASSERT_EQ(edge[i] != 0, d <= h / 4) << i << " at " << d;
  }
  EXPECT_GT(compared, 3990u);
  EXPECT_GT(marked, 400u);
}

TEST(EdgePoints, onACubeAreThoseWithinAQuarterOfTheSupportRadius)
{
  const Shape shape = cube(20000, 0, 5);
  const double h = 0.2;
  const std::vector<std::uint8_t> edge = Buffers(shape).edges(parameters(h, 0.017));
  for (std::size_t i = 0; i < shape.size(); ++i) {
    Vector3 depth;
    for (std::size_t a = 0; a < 3; ++a)
      depth[a] = std::min(shape.points[i][a], 1 - shape.points[i][a]);
    std::sort(depth.begin(), depth.end());
    const double d = std::hypot(depth[0], depth[1]); // to the nearest edge
    if (std::abs(d - h / 4) > 1e-5) {
      ASSERT_EQ(edge[i] != 0, d < h / 4) << d;
    }
  }
}

TEST(EdgePoints, areNoneOnPlanesAndWideSpheresAndParallelSheets)
{
  for (const Shape& shape : {plane(5000), sphere(20000), sheets(8000, 0.05)}) {
    const std::vector<std::uint8_t> edge = Buffers(shape).edges(parameters(0.2, 0.015));
    EXPECT_EQ(std::count(edge.begin(), edge.end(), 1), 0);
  }
}

TEST(EdgePoints, ofADenseCloudAreThoseOfAThinnerOne)
{
  const Shape shape = cube(60000, 0, 5); // about 2,000 in a ball
  const double h = 0.4;
  const std::vector<std::uint8_t> edge = Buffers(shape).edges(parameters(h, 0.01));
  for (std::size_t i = 0; i < shape.size(); ++i) {
    Vector3 depth;
    for (std::size_t a = 0; a < 3; ++a)
      depth[a] = std::min(shape.points[i][a], 1 - shape.points[i][a]);
    std::sort(depth.begin(), depth.end());
    const double d = std::hypot(depth[0], depth[1]);
    if (std::abs(d - h / 4) > 1e-5) {
      ASSERT_EQ(edge[i] != 0, d < h / 4) << d;
    }
  }
}

TEST(EdgePoints, takesFewPointsDuplicatesAndRefusesBadParameters)
{
  for (const std::size_t count : {0u, 1u, 2u, 3u}) {
    const Shape shape = plane(count);
    EXPECT_EQ(Buffers(shape).edges(parameters(0.5, 0.1)), std::vector<std::uint8_t>(count, 0));
  }
  Shape same = cube(500, 0, 1);
  for (Vector3& p : same.points)
    p = {0.25, 0.5, 0.75};
  EXPECT_EQ(Buffers(same).edges(parameters(0.5, 0.1)).size(), 500u);
  const Buffers some(plane(10));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {0.0, -1.0, nan}) {
    EXPECT_THROW(some.edges(parameters(bad, 0.1)), InvalidParameter);
    EXPECT_THROW(some.edges(parameters(0.5, bad)), InvalidParameter);
  }
  EdgePointsParameters p = parameters(0.5, 0.1);
  p.angle = 90;
  EXPECT_THROW(some.edges(p), InvalidParameter);
}

TEST(EdgePoints, doNotDependOnThreadsOrOrder)
{
  const Shape shape = cubeWithRoughNormals(6000);
  EdgePointsParameters p = parameters(0.2, 0.03);
  p.number_of_threads = 1;
  const std::vector<std::uint8_t> one = Buffers(shape).edges(p);
  p.number_of_threads = 3;
  EXPECT_EQ(Buffers(shape).edges(p), one);
  Shape reversed = shape;
  std::reverse(reversed.points.begin(), reversed.points.end());
  std::reverse(reversed.normals.begin(), reversed.normals.end());
  std::vector<std::uint8_t> other = Buffers(reversed).edges(p);
  std::reverse(other.begin(), other.end());
  EXPECT_EQ(other, one);
}

} // namespace
} // namespace pcl_gpf::test
