// SPDX-License-Identifier: BSD-3-Clause
#include "support/clouds.h"
#include "support/literal_gpf.h"

#include <pcl_gpf/core/local_frame.h>
#include <pcl_gpf/filters/gpf.h>

#include <gtest/gtest.h>

#include <pcl/exceptions.h>
#include <pcl/search/kdtree.h>

#include <algorithm>
#include <limits>
#include <string>

namespace pcl_gpf::test {
namespace {

using PointT = pcl::PointNormal;
using Cloud = pcl::PointCloud<PointT>;

constexpr double kRadius = 0.15; // h on shapes of size 1

Cloud
run(GPF<PointT>& gpf, const Cloud::Ptr& cloud)
{
  Cloud output;
  gpf.setInputCloud(cloud);
  gpf.filter(output);
  return output;
}

Cloud
runDefault(const Cloud::Ptr& cloud, double radius = kRadius)
{
  GPF<PointT> gpf;
  gpf.setSupportRadius(radius);
  return run(gpf, cloud);
}

/** \brief Distance to the surface of the unit cube. */
double
distanceToCube(const Vector3& p)
{
  double outside_sq = 0, inside = std::numeric_limits<double>::infinity();
  for (const double c : p) {
    const double beyond = std::max({-c, c - 1, 0.0});
    outside_sq += beyond * beyond;
    inside = std::min({inside, std::abs(c), std::abs(c - 1)});
  }
  return outside_sq > 0 ? std::sqrt(outside_sq) : inside;
}

double
meanDistanceToCube(const Cloud& cloud)
{
  double sum = 0;
  for (const PointT& point : cloud)
    sum += distanceToCube(position(point));
  return sum / static_cast<double>(cloud.size());
}

// ---------------------------------------------------------------- the default filters

TEST(GPF, DefaultRemovesNoiseAndKeepsEdges)
{
  const Cloud::Ptr cloud = toCloud<PointT>(cube(20000, 0.01));
  const double before = meanDistanceToCube(*cloud);
  EXPECT_LT(meanDistanceToCube(runDefault(cloud)), 0.35 * before);

  GPF<PointT> estimated;
  EXPECT_LT(meanDistanceToCube(run(estimated, cloud)), 0.35 * before);
  EXPECT_TRUE(estimated.getStatistics().support_radius_estimated);
  EXPECT_GT(estimated.getStatistics().support_radius, 0.02);
  EXPECT_LT(estimated.getStatistics().support_radius, 0.4);
}

TEST(GPF, StatisticsTellWhatHappened)
{
  const Cloud::Ptr cloud = toCloud<PointT>(cube(2000, 0.01), 10);
  GPF<PointT> gpf;
  gpf.setSupportRadius(10 * kRadius);
  gpf.setConvergenceThreshold(0);
  gpf.setMaximumIterations(4);
  const Cloud output = run(gpf, cloud);
  const GPFStatistics& statistics = gpf.getStatistics();
  EXPECT_EQ(statistics.points, 2000u);
  EXPECT_DOUBLE_EQ(statistics.support_radius, 10 * kRadius);
  EXPECT_FALSE(statistics.support_radius_estimated);
  ASSERT_EQ(statistics.iterations.size(), 4u);
  EXPECT_GT(statistics.seconds, 0);
  double reach = 0;
  for (const IterationStats& iteration : statistics.iterations) {
    EXPECT_GT(iteration.mean_movement, 0);
    EXPECT_GE(iteration.max_movement, iteration.mean_movement);
    EXPECT_GT(iteration.posterior_sum, 0);
    EXPECT_EQ(iteration.variance, statistics.iterations[0].variance) << "fixed by default";
    reach += iteration.max_movement;
  }
  // In cloud units: the path is at least the way from the input to the output.
  EXPECT_GE(reach * 1.0001, largestDistance(output, *cloud));
  EXPECT_GT(statistics.iterations[0].max_movement, 0.02);
}

TEST(GPF, ConvergenceStopsAndZeroIterationsCopy)
{
  const Cloud::Ptr cloud = toCloud<PointT>(cube(2000, 0.01));
  GPF<PointT> gpf;
  gpf.setSupportRadius(kRadius);
  gpf.setMaximumIterations(50);
  gpf.setConvergenceThreshold(0.01);
  run(gpf, cloud);
  const std::size_t iterations = gpf.getStatistics().iterations.size();
  EXPECT_LT(iterations, 50u);
  EXPECT_LT(gpf.getStatistics().iterations.back().mean_movement, 0.01 * kRadius);
  gpf.setMaximumIterations(0);
  EXPECT_TRUE(sameBits(run(gpf, cloud), *cloud));
}

TEST(GPF, SettersAndParametersAreOne)
{
  GPF<PointT> gpf;
  GPFParameters p;
  p.support_radius = 1;
  p.repulsion_weight = 0.1;
  p.outlier_weight = 0.2;
  p.initial_variance = 0.3;
  p.variance_update = VarianceUpdate::OneDegreeOfFreedom;
  p.data_term = DataTerm::PointToPlane;
  p.posterior_normalization = true;
  p.density_weights = true;
  p.normal_angle = 30;
  p.normal_weight_floor = 0.4;
  p.own_tangent_repulsion = false;
  p.sample_ratio = 0.5;
  p.seed = 6;
  p.maximum_iterations = 7;
  p.convergence_threshold = 0.8;
  p.gap_iterations = 2;
  p.gap_radius_factor = 1.5;
  p.number_of_threads = 9;
  gpf.setParameters(p);
  EXPECT_EQ(gpf.getSupportRadius(), 1);
  EXPECT_EQ(gpf.getRepulsionWeight(), 0.1);
  EXPECT_EQ(gpf.getOutlierWeight(), 0.2);
  EXPECT_EQ(gpf.getInitialVariance(), 0.3);
  EXPECT_EQ(gpf.getVarianceUpdate(), VarianceUpdate::OneDegreeOfFreedom);
  EXPECT_EQ(gpf.getDataTerm(), DataTerm::PointToPlane);
  EXPECT_TRUE(gpf.getPosteriorNormalization());
  EXPECT_TRUE(gpf.getDensityWeights());
  EXPECT_EQ(gpf.getNormalAngle(), 30);
  EXPECT_EQ(gpf.getNormalWeightFloor(), 0.4);
  EXPECT_FALSE(gpf.getOwnTangentRepulsion());
  EXPECT_EQ(gpf.getSampleRatio(), 0.5);
  EXPECT_EQ(gpf.getSeed(), 6u);
  EXPECT_EQ(gpf.getMaximumIterations(), 7u);
  EXPECT_EQ(gpf.getConvergenceThreshold(), 0.8);
  EXPECT_EQ(gpf.getGapIterations(), 2u);
  EXPECT_EQ(gpf.getGapRadiusFactor(), 1.5);
  EXPECT_EQ(gpf.getNumberOfThreads(), 9u);

  GPF<PointT> other;
  other.setSupportRadius(1);
  other.setRepulsionWeight(0.1);
  other.setOutlierWeight(0.2);
  other.setInitialVariance(0.3);
  other.setVarianceUpdate(VarianceUpdate::OneDegreeOfFreedom);
  other.setDataTerm(DataTerm::PointToPlane);
  other.setPosteriorNormalization(true);
  other.setDensityWeights(true);
  other.setNormalAngle(30);
  other.setNormalWeightFloor(0.4);
  other.setOwnTangentRepulsion(false);
  other.setSampleRatio(0.5);
  other.setSeed(6);
  other.setMaximumIterations(7);
  other.setConvergenceThreshold(0.8);
  other.setGapIterations(2);
  other.setGapRadiusFactor(1.5);
  other.setNumberOfThreads(9);
  const Cloud::Ptr cloud = toCloud<PointT>(cube(500, 0.01));
  EXPECT_TRUE(sameBits(run(gpf, cloud), run(other, cloud)));
}

TEST(GPF, RadiusThatExplodesIsRefusedBeforeTheWork)
{
  GPF<PointT> gpf;
  gpf.setParameters(GPFParameters::paper());
  gpf.setSupportRadius(1000.0);
  bool begun = false;
  gpf.setProgressCallback([&](double) { return begun = true; });
  EXPECT_THROW(run(gpf, toCloud<PointT>(cube(100000))), pcl::ComputeFailedException);
  EXPECT_FALSE(begun);
}

TEST(GPF, EveryParameterOutOfRangeThrows)
{
  const Cloud::Ptr cloud = toCloud<PointT>(cube(100, 0.01));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::pair<std::string, std::function<void(GPFParameters&)>>> mistakes = {
      {"support_radius", [&](GPFParameters& p) { p.support_radius = nan; }},
      {"support_radius", [&](GPFParameters& p) { p.support_radius = -1; }},
      {"repulsion_weight", [&](GPFParameters& p) { p.repulsion_weight = 0.6; }},
      {"outlier_weight", [&](GPFParameters& p) { p.outlier_weight = 1; }},
      {"initial_variance", [&](GPFParameters& p) { p.initial_variance = -0.1; }},
      {"normal_angle", [&](GPFParameters& p) { p.normal_angle = 0; }},
      {"normal_weight_floor", [&](GPFParameters& p) { p.normal_weight_floor = 1.1; }},
      {"sample_ratio", [&](GPFParameters& p) { p.sample_ratio = 0; }},
      {"sample_ratio", [&](GPFParameters& p) { p.sample_ratio = nan; }},
      {"maximum_iterations", [&](GPFParameters& p) { p.maximum_iterations = 10001; }},
      {"gap_iterations", [&](GPFParameters& p) { p.gap_iterations = 101; }},
      {"gap_radius_factor", [&](GPFParameters& p) { p.gap_radius_factor = 9; }},
      {"convergence_threshold", [&](GPFParameters& p) { p.convergence_threshold = -1; }}};
  for (const auto& mistake : mistakes) {
    GPFParameters parameters;
    mistake.second(parameters);
    GPF<PointT> gpf;
    gpf.setParameters(parameters);
    try {
      run(gpf, cloud);
      ADD_FAILURE() << mistake.first << " was accepted";
    }
    catch (const pcl::BadArgumentException& error) {
      EXPECT_NE(std::string(error.what()).find(mistake.first), std::string::npos) << error.what();
    }
  }
}

TEST(GPF, FillsGapsAndTellsWhatItDid)
{
  const Cloud::Ptr cloud = toCloud<PointT>(cube(4000, 0.01));
  GPF<PointT> gpf;
  gpf.setSupportRadius(0.2);
  gpf.setNormalWeightFloor(1);
  gpf.setConvergenceThreshold(0);
  const Cloud before = run(gpf, cloud);
  EXPECT_TRUE(gpf.getStatistics().gap_iterations.empty());
  gpf.setGapIterations(1);
  std::vector<double> fractions;
  gpf.setProgressCallback([&](double fraction) { fractions.push_back(fraction); return true; });
  const Cloud after = run(gpf, cloud);
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_EQ(fractions.back(), 1.0);
  ASSERT_EQ(gpf.getStatistics().gap_iterations.size(), 1u);
  double furthest = 0; // cloud units, as in the statistics; points that were not moved keep every bit
  std::size_t same = 0;
  for (std::size_t i = 0; i < cloud->size(); ++i) {
    furthest = std::max(furthest, distance(position(before[i]), position(after[i])));
    same += distance(position(before[i]), position(after[i])) == 0;
  }
  EXPECT_NEAR(furthest, gpf.getStatistics().gap_iterations[0].max_movement, 1e-4);
  EXPECT_GT(furthest, 0.02);
  EXPECT_GT(same, cloud->size() / 3);
}

// ---------------------------------------------------------------- laws

TEST(GPFLaws, RigidMotionCommutes)
{
  const Shape shape = cube(3000, 0.01);
  const Cloud::Ptr cloud = toCloud<PointT>(shape);
  const Eigen::Isometry3d motion =
      Eigen::Translation3d(3, -2, 1) * Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized());
  Shape moved = shape;
  for (std::size_t i = 0; i < shape.size(); ++i) {
    Eigen::Map<Eigen::Vector3d> point(moved.points[i].data()), normal(moved.normals[i].data());
    point = (motion * point).eval();
    normal = (motion.linear() * normal).eval();
  }
  const Cloud output = runDefault(cloud);
  const Cloud output_moved = runDefault(toCloud<PointT>(moved));
  for (std::size_t i = 0; i < output.size(); ++i) {
    const Eigen::Vector3d expected = motion * output[i].getVector3fMap().cast<double>();
    EXPECT_LT((output_moved[i].getVector3fMap().cast<double>() - expected).norm(), 1e-5) << i;
  }
}

TEST(GPFLaws, ScaleCommutes)
{
  const Shape shape = cube(2000, 0.01);
  const Cloud expected = runDefault(toCloud<PointT>(shape));
  const Cloud estimated = runDefault(toCloud<PointT>(shape), 0);
  for (const double scale : {1e-30, 1e-6, 1e-3, 1e3, 1e6, 1e30}) {
    const Cloud output = runDefault(toCloud<PointT>(shape, scale), kRadius * scale);
    const Cloud output_estimated = runDefault(toCloud<PointT>(shape, scale), 0);
    double largest = 0, largest_estimated = 0;
    std::size_t beyond = 0;
    for (std::size_t i = 0; i < output.size(); ++i) {
      const auto descaled = [&](const PointT& p) { return Vector3{p.x / scale, p.y / scale, p.z / scale}; };
      largest = std::fmax(largest, distance(descaled(output[i]), position(expected[i])));
      const double estimated_off = distance(descaled(output_estimated[i]), position(estimated[i]));
      largest_estimated = std::fmax(largest_estimated, estimated_off);
      beyond += estimated_off >= 1e-5;
    }
    EXPECT_LT(largest, 1e-5) << scale;
    // Rounding of the coordinates moves the estimated radius in its seventh digit, and a datum at the edge of a ball in or out.
    EXPECT_LE(beyond, 3u) << scale;
    EXPECT_LT(largest_estimated, 1e-3) << scale;
  }
}

TEST(GPFLaws, PermutationCommutes)
{
  const Cloud::Ptr cloud = toCloud<PointT>(cube(3000, 0.01));
  const std::size_t count = cloud->size();
  const Cloud::Ptr permuted(new Cloud);
  for (std::size_t i = 0; i < count; ++i)
    permuted->push_back((*cloud)[(7 * i + 5) % count]);
  const Cloud expected = runDefault(cloud);
  const Cloud output = runDefault(permuted);
  for (std::size_t i = 0; i < count; ++i)
    EXPECT_LT(distance(position(output[i]), position(expected[(7 * i + 5) % count])), 1e-6) << i;
}

TEST(GPFLaws, SignsOfNormalsDoNotMatter)
{
  const Cloud::Ptr cloud = toCloud<PointT>(cube(3000, 0.01));
  const Cloud::Ptr flipped(new Cloud(*cloud));
  for (std::size_t i = 0; i < flipped->size(); i += 1 + i % 3)
    (*flipped)[i].getNormalVector3fMap() *= -1;
  EXPECT_LT(largestDistance(runDefault(cloud), runDefault(flipped)), 1e-6);

  GPF<PointT> paper;
  paper.setParameters(GPFParameters::paper());
  EXPECT_LT(largestDistance(run(paper, cloud), run(paper, flipped)), 1e-6);
}

TEST(GPFLaws, IsolatedPointsStayWhereTheyAre)
{
  Shape shape = cube(1000, 0.01);
  shape.points[500] = {5, 5, 5};
  const Cloud::Ptr cloud = toCloud<PointT>(shape);
  for (const double repulsion : {0.0, 0.3}) {
    GPF<PointT> gpf;
    gpf.setSupportRadius(kRadius);
    gpf.setRepulsionWeight(repulsion);
    const Cloud output = run(gpf, cloud);
    EXPECT_TRUE(sameBits(output[500], (*cloud)[500]));
    EXPECT_FALSE(sameBits(output[499], (*cloud)[499]));
  }
}

TEST(GPFLaws, CleanPlaneStaysWhereItIs)
{
  const Cloud::Ptr flat = toCloud<PointT>(plane(2000));
  EXPECT_TRUE(sameBits(runDefault(flat), *flat));

  Shape tilted = plane(2000);
  const Eigen::Matrix3d rotation = Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  for (std::size_t i = 0; i < tilted.size(); ++i) {
    Eigen::Map<Eigen::Vector3d> point(tilted.points[i].data()), normal(tilted.normals[i].data());
    point = (rotation * point).eval();
    normal = (rotation * normal).eval();
  }
  const Cloud::Ptr cloud = toCloud<PointT>(tilted);
  EXPECT_LT(largestDistance(runDefault(cloud), *cloud), 1e-6);
}

TEST(GPFLaws, WithoutRepulsionNoisyPlaneMovesAlongItsNormalOnly)
{
  const Cloud::Ptr cloud = toCloud<PointT>(plane(3000, 0.01));
  const Cloud output = runDefault(cloud);
  double before = 0, after = 0;
  for (std::size_t i = 0; i < output.size(); ++i) {
    EXPECT_EQ(output[i].x, (*cloud)[i].x);
    EXPECT_EQ(output[i].y, (*cloud)[i].y);
    before += (*cloud)[i].z * (*cloud)[i].z;
    after += output[i].z * output[i].z;
  }
  EXPECT_LT(after, 0.15 * before);
}

TEST(GPFLaws, LargeCoordinatesKeepTheirDetail)
{
  // Multiples of 1 / 64 are exact in float near 100 and near 100 000, so that only the output can be rounded.
  Shape shape = cube(3000, 0.01);
  for (Vector3& point : shape.points)
    for (double& coordinate : point)
      coordinate = std::round(100 * coordinate * 64) / 64;
  const Vector3 offset = {100000, 120000, 1000};
  const Cloud output = runDefault(toCloud<PointT>(shape), 100 * kRadius);
  const Cloud far = runDefault(toCloud<PointT>(shape, 1, offset), 100 * kRadius);
  constexpr double kHalfStep = 1.0 / 256; // of floats between 65 536 and 131 072
  for (std::size_t i = 0; i < output.size(); ++i) {
    EXPECT_NEAR(output[i].x, far[i].x - offset[0], kHalfStep + 1e-4) << i;
    EXPECT_NEAR(output[i].y, far[i].y - offset[1], kHalfStep + 1e-4) << i;
    EXPECT_NEAR(output[i].z, far[i].z - offset[2], kHalfStep + 1e-4) << i;
  }
}

// ---------------------------------------------------------------- the paper's recursion

struct PaperCase {
  std::string name;
  Shape shape;
};

class GPFPaper : public ::testing::TestWithParam<PaperCase> {};

/** \brief The oracle, with X^0 as the filter chose it. */
LiteralGPF
literal(const Cloud& cloud,
        const pcl::Indices& samples,
        double support_radius,
        const GPFParameters& parameters,
        LocalFrame& frame)
{
  BoundingBox box;
  for (const PointT& point : cloud)
    box.add(point.x, point.y, point.z);
  frame = localFrame(box);
  LiteralGPF oracle;
  for (const PointT& point : cloud) {
    const Vector3 p = position(point), n = normal(point);
    oracle.v.push_back({(p[0] - frame.origin[0]) / frame.scale, (p[1] - frame.origin[1]) / frame.scale,
                        (p[2] - frame.origin[2]) / frame.scale});
    const double length = distance(n, {0, 0, 0});
    oracle.b.push_back({n[0] / length, n[1] / length, n[2] / length});
  }
  for (const int sample : samples) {
    oracle.x.push_back(oracle.v[static_cast<std::size_t>(sample)]);
    oracle.b_x.push_back(oracle.b[static_cast<std::size_t>(sample)]);
  }
  oracle.h = frame.lengthToLocal(support_radius);
  oracle.omega = parameters.outlier_weight;
  oracle.mu = parameters.repulsion_weight;
  oracle.variance = parameters.initial_variance;
  return oracle;
}

TEST_P(GPFPaper, OneAndFiveStepsEqualTheLiteralEquations)
{
  const Cloud::Ptr cloud = toCloud<PointT>(GetParam().shape, 3, {10, 20, -5});
  for (const bool kd_tree : {false, true}) {
    for (const unsigned steps : {1u, 5u}) {
      GPF<PointT> gpf;
      gpf.setParameters(GPFParameters::paper());
      gpf.setMaximumIterations(steps);
      if (kd_tree)
        gpf.setSearchMethod(pcl::make_shared<pcl::search::KdTree<PointT>>(false));
      const Cloud output = run(gpf, cloud);
      ASSERT_EQ(output.size(), cloud->size() / 2);
      ASSERT_EQ(gpf.getStatistics().iterations.size(), steps);

      LocalFrame frame;
      const double h = gpf.getStatistics().support_radius;
      LiteralGPF oracle = literal(*cloud, gpf.getSampleIndices(), h, gpf.getParameters(), frame);
      for (const IterationStats& iteration : gpf.getStatistics().iterations) {
        EXPECT_NEAR(iteration.variance, oracle.variance, 1e-6 * oracle.variance);
        oracle.step();
        EXPECT_NEAR(iteration.posterior_sum, oracle.n_p, 1e-6 * oracle.n_p);
        EXPECT_NEAR(iteration.next_variance, oracle.variance, 1e-6 * oracle.variance);
      }
      double largest = 0;
      for (std::size_t m = 0; m < output.size(); ++m) {
        const Vector3& x = oracle.x[m];
        const Vector3 expected = {x[0] * frame.scale + frame.origin[0], x[1] * frame.scale + frame.origin[1],
                                  x[2] * frame.scale + frame.origin[2]};
        largest = std::fmax(largest, distance(position(output[m]), expected));
      }
      EXPECT_LT(largest, 1e-4 * h) << steps << " steps, " << (kd_tree ? "KdTree" : "built-in search");
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes,
                         GPFPaper,
                         ::testing::Values(PaperCase{"cube", cube(4000, 0.01)},
                                           PaperCase{"sphere", sphere(3000, 0.005)},
                                           PaperCase{"plane", plane(2000, 0.01)}),
                         [](const auto& test) { return test.param.name; });

TEST(GPFPaperMode, EstimatesTheSupportRadiusAsThePaperDoes)
{
  const Cloud::Ptr cloud = toCloud<PointT>(cube(4000));
  GPF<PointT> gpf;
  gpf.setParameters(GPFParameters::paper());
  gpf.setMaximumIterations(1);
  run(gpf, cloud);
  const double diagonal = std::sqrt(3.0);
  EXPECT_NEAR(gpf.getStatistics().support_radius, 8 * diagonal / std::sqrt(4000.0), 0.01);
}

} // namespace
} // namespace pcl_gpf::test
