// SPDX-License-Identifier: BSD-3-Clause
#include "mesh_surface.h"
#include "models.h"

#include <pcl_gpf/core/analysis/point_distance.h>
#include <pcl_gpf/core/sampling.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace pcl_gpf::quality {
namespace {

constexpr std::size_t kSheetCount = 10000;

/** The unit cube, or what is left of it with its first triangles only. */
TriangleMesh
cubeMesh(std::size_t triangles)
{
  TriangleMesh mesh;
  for (int corner = 0; corner < 8; ++corner)
    for (const int bit : {1, 2, 4})
      mesh.vertices.push_back((corner & bit) != 0 ? 1 : 0);
  mesh.triangles = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                    2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
  mesh.triangles.resize(3 * triangles);
  return mesh;
}

Model
modelOf(const std::string& name)
{
  if (name == "mesh of a cube" || name == "mesh with an opening")
    return {name, meshSurface(cubeMesh(name == "mesh of a cube" ? 12 : 10)), 0, 0};
  return makeModel(name, kSheetCount);
}

class EveryModel : public ::testing::TestWithParam<const char*> {
protected:
  const Model model = modelOf(GetParam());
  const Surface& surface = *model.surface;

  /** Points anywhere in the box, enlarged by a fifth of the diagonal. */
  std::vector<Position>
  queries(std::size_t count) const
  {
    const BoundingBox box = surface.box();
    SplitMix64 random(7);
    std::vector<Position> points(count);
    for (Position& p : points)
      for (std::size_t axis = 0; axis < 3; ++axis)
        p[axis] = box.min[axis] + (random.uniform() * 1.4 - 0.2) * (box.max[axis] - box.min[axis]) +
                  (random.uniform() - 0.5) * 0.2 * box.diagonal();
    return points;
  }
};

TEST_P(EveryModel, SamplesLieOnTheSurfaceWithUnitNormals)
{
  for (const SurfaceSample& s : sampleModel(model, 3000, 3)) {
    EXPECT_LT(std::abs(surface.nearest(s.point).signed_distance), 1e-12);
    EXPECT_NEAR(length(s.normal), 1, 1e-12);
  }
}

TEST_P(EveryModel, SamplesAreRepeatableAndDependOnTheSeed)
{
  const auto a = sampleModel(model, 50, 3), b = sampleModel(model, 50, 3), c = sampleModel(model, 50, 4);
  for (std::size_t i = 0; i < a.size(); ++i)
    EXPECT_EQ(a[i].point, b[i].point);
  EXPECT_NE(a[0].point, c[0].point);
}

/** The distance to dense samples is never below the true one, and above it by no more than their gaps allow. */
TEST_P(EveryModel, DistancesEqualThoseToDenseSamples)
{
  constexpr std::size_t kDense = 400000;
  std::vector<Position> dense;
  for (const SurfaceSample& s : surface.sample(kDense, 5))
    dense.push_back(s.point);
  const PointDistance brute_force(dense);
  const double gap =
      5 * std::sqrt(surface.area() / kDense); // a circle of it holds 80 samples, its quarter at a corner 20
  for (const Position& p : queries(2000)) {
    const double exact = std::abs(surface.nearest(p).signed_distance), sampled = brute_force.nearest(p).distance;
    EXPECT_LE(exact, sampled + 1e-12);
    EXPECT_LE(sampled, exact + gap) << p[0] << " " << p[1] << " " << p[2];
  }
}

/** A distance changes by no more than the way gone, along its gradient by exactly that, and only a zero changes its
 * sign. */
TEST_P(EveryModel, SignedDistancesChangeAsFastAsTheQueryMoves)
{
  SplitMix64 random(9);
  const double step = 1e-3 * surface.diagonal();
  for (const Position& p : queries(2000)) {
    const double here = surface.nearest(p).signed_distance;
    const Position q = addScaled(p, step, normalized({random.normal(), random.normal(), random.normal()}));
    const double there = surface.nearest(q).signed_distance;
    EXPECT_LE(std::abs(std::abs(there) - std::abs(here)), step * (1 + 1e-9));
    if (here * there < 0 && surface.closed()) {
      EXPECT_LE(std::abs(here) + std::abs(there), step * (1 + 1e-9));
    }
  }
}

TEST_P(EveryModel, NormalsPointOutwards)
{
  const double step = 1e-5 * surface.diagonal();
  for (const SurfaceSample& s : surface.sample(2000, 11)) {
    if (std::min(surface.edgeDistance(s.point), surface.boundaryDistance(s.point)) < 10 * step)
      continue;
    for (const double side : {-1.0, 1.0}) {
      const SurfaceHit hit = surface.nearest(addScaled(s.point, side * step, s.normal));
      EXPECT_NEAR(hit.signed_distance, side * step, 1e-12);
      EXPECT_NEAR(dot(hit.normal, s.normal), 1, 1e-9);
    }
  }
}

TEST_P(EveryModel, BoxHoldsTheSamplesClosely)
{
  const BoundingBox box = surface.box();
  BoundingBox found;
  for (const SurfaceSample& s : surface.sample(100000, 13))
    found.add(s.point[0], s.point[1], s.point[2]);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_GE(found.min[axis], box.min[axis] - 1e-12);
    EXPECT_LE(found.max[axis], box.max[axis] + 1e-12);
    EXPECT_LT(found.min[axis] - box.min[axis] + box.max[axis] - found.max[axis], 0.01 * box.diagonal());
  }
}

TEST_P(EveryModel, EdgesAndBoundariesLieOnTheSurface)
{
  const double step = 0.01 * surface.diagonal();
  for (const Position& p : surface.edgeSamples(step)) {
    EXPECT_LT(std::abs(surface.nearest(p).signed_distance), 1e-12);
    EXPECT_LT(surface.edgeDistance(p), 1e-12);
  }
  for (const BoundarySample& b : surface.boundarySamples(step)) {
    EXPECT_LT(std::abs(surface.nearest(b.point).signed_distance), 1e-12);
    EXPECT_LT(surface.boundaryDistance(b.point), 1e-12);
  }
}

/** Off the boundary the nearest point is the boundary itself; inwards lies the surface. */
TEST_P(EveryModel, BoundaryDirectionsLeadOff)
{
  const double step = 1e-4 * surface.diagonal();
  for (const BoundarySample& b : surface.boundarySamples(0.0137 * surface.diagonal())) {
    EXPECT_NEAR(length(b.outward), 1, 1e-12);
    EXPECT_NEAR(dot(b.outward, b.along), 0, 1e-12);
    EXPECT_NEAR(std::abs(surface.nearest(addScaled(b.point, step, b.outward)).signed_distance), step, 1e-3 * step);
    EXPECT_LT(std::abs(surface.nearest(addScaled(b.point, -step, b.outward)).signed_distance), 1e-3 * step);
  }
  EXPECT_EQ(surface.closed(), surface.boundarySamples(step).empty());
}

INSTANTIATE_TEST_SUITE_P(Models, EveryModel,
                         ::testing::Values("cube", "block", "sphere", "relief", "cylinder", "torus", "sheets", "plane",
                                           "cap", "star", "cube-graded", "block-graded:-3", "mesh of a cube",
                                           "mesh with an opening"));

TEST(Models, AreasAndDiagonals)
{
  EXPECT_DOUBLE_EQ(makeModel("cube", 1).surface->area(), 6);
  EXPECT_DOUBLE_EQ(makeModel("cube", 1).surface->diagonal(), std::sqrt(3));
  const double hole = std::acos(-1) * 0.28 * (2 * 0.6 - 2 * 0.28);
  EXPECT_NEAR(makeModel("block", 1).surface->area(), 2 * 0.6 * 2 + 2 * 0.6 * 0.8 + 6.8 + hole,
              1e-12); // profile twice, its rim, hole
  EXPECT_NEAR(makeModel("sphere", 1).surface->area(), 4 * std::acos(-1), 1e-12);
}

TEST(Models, SheetsAreAsFarApartAsSaid)
{
  const Model model = makeModel("sheets:6", kSheetCount);
  EXPECT_DOUBLE_EQ(model.sheet_gap, 6 * spacingOf(model, kSheetCount));
  EXPECT_DOUBLE_EQ(model.surface->nearest({0.5, 0.5, 0}).signed_distance, -0.5 * model.sheet_gap);
}

TEST(Models, GradedDensityFollowsItsExponential)
{
  const Model model = makeModel("cube-graded:2", 1);
  std::size_t low = 0, high = 0; // on the four sides along x, whose area is the same everywhere
  for (const SurfaceSample& s : sampleModel(model, 200000, 1))
    if (s.normal[0] == 0)
      ++(s.point[0] < 0.5 ? low : high);
  const double expected = std::exp(2 * 0.5 / std::sqrt(3)); // the same exponential half a side further
  EXPECT_NEAR(static_cast<double>(high) / static_cast<double>(low), expected, 0.02 * expected);
}

TEST(Models, UnknownNamesAreRefused)
{
  for (const char* name : {"", "cone", "cube:2", "sheets:wide", "mesh:"})
    EXPECT_ANY_THROW(makeModel(name, 10)) << name;
}

TEST(MeshSurface, FindsSharpEdgesAndBoundaries)
{
  const auto closed = meshSurface(cubeMesh(12)), open = meshSurface(cubeMesh(10));
  EXPECT_NEAR(closed->edgeDistance({0.5, 0.5, 1}), 0.5, 1e-12) << "the diagonal of a flat face is no edge";
  EXPECT_NEAR(open->boundaryDistance({1, 0.5, 0.5}), 0.5, 1e-12) << "the opening at x = 1 has four sides";
  EXPECT_NEAR(open->edgeDistance({1, 0.5, 0.5}), std::sqrt(0.5), 1e-12) << "whose sides are no edges";
}

} // namespace
} // namespace pcl_gpf::quality
