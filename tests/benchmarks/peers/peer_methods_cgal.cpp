// SPDX-License-Identifier: BSD-3-Clause
// Includes headers of CGAL under the GPL: see peer_methods.h.
#include "peer_checks.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/bilateral_smooth_point_set.h>
#include <CGAL/jet_smooth_point_set.h>
#include <CGAL/mst_orient_normals.h>
#include <CGAL/pca_estimate_normals.h>
#include <CGAL/property_map.h>
#include <CGAL/wlop_simplify_and_regularize_point_set.h>

#include <tbb/global_control.h>

#include <iterator>
#include <tuple>

namespace pcl_gpf::benchmark_peers {

namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;
using Vector = Kernel::Vector_3;

/** A row of a PeerCloud: position, normal, index; CGAL may reorder rows. */
using Row = std::tuple<Point, Vector, std::size_t>;
using PointMap = CGAL::Nth_of_tuple_property_map<0, Row>;
using NormalMap = CGAL::Nth_of_tuple_property_map<1, Row>;

std::vector<Row>
rowsOf(const PeerCloud& cloud)
{
  std::vector<Row> rows;
  rows.reserve(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i)
    rows.emplace_back(Point(cloud.x[i], cloud.y[i], cloud.z[i]),
                      cloud.hasNormals() ? Vector(cloud.normal_x[i], cloud.normal_y[i], cloud.normal_z[i]) : Vector(0, 0, 0), i);
  return rows;
}

void
writePositions(const std::vector<Row>& rows, PeerCloud& cloud)
{
  for (const auto& [point, normal, index] : rows) {
    cloud.x[index] = point.x();
    cloud.y[index] = point.y();
    cloud.z[index] = point.z();
  }
}

void
writeNormals(const std::vector<Row>& rows, PeerCloud& cloud)
{
  for (std::vector<double>* values : {&cloud.normal_x, &cloud.normal_y, &cloud.normal_z})
    values->resize(rows.size());
  for (const auto& [point, normal, index] : rows) {
    cloud.normal_x[index] = normal.x();
    cloud.normal_y[index] = normal.y();
    cloud.normal_z[index] = normal.z();
  }
}

/** Calls work(tag) with CGAL's tag of concurrency for that number of threads. */
template <typename Work>
void
withThreads(unsigned threads, const Work& work)
{
  if (threads == 1)
    return work(CGAL::Sequential_tag());
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  work(CGAL::Parallel_tag());
}

} // namespace

PeerCloud
cgalWlop(const PeerCloud& cloud, const CgalWlopParameters& parameters, unsigned threads)
{
  require(cloud.size() >= 7, "WLOP needs at least seven points");
  require(parameters.radius >= 0.0, "the radius must not be negative");
  require(parameters.iterations >= 1, "WLOP needs at least one iteration");
  require(parameters.retain_percent > 0.0 && parameters.retain_percent <= 100.0, "the share of points must be in (0, 100] percent");
  requireThreads(threads);
  std::vector<Point> points, sampled; // CGAL shuffles the first, in the same way every time
  for (std::size_t i = 0; i < cloud.size(); ++i)
    points.emplace_back(cloud.x[i], cloud.y[i], cloud.z[i]);
  withThreads(threads, [&](auto tag) {
    CGAL::wlop_simplify_and_regularize_point_set<decltype(tag)>(
        points, std::back_inserter(sampled),
        CGAL::parameters::select_percentage(parameters.retain_percent)
            .neighbor_radius(parameters.radius > 0.0 ? parameters.radius : -1.0)
            .number_of_iterations(parameters.iterations)
            .require_uniform_sampling(parameters.uniform_sampling));
  });
  PeerCloud result;
  for (const Point& p : sampled) {
    result.x.push_back(p.x());
    result.y.push_back(p.y());
    result.z.push_back(p.z());
  }
  return result;
}

void
cgalBilateralSmooth(PeerCloud& cloud, const CgalBilateralParameters& parameters, unsigned threads)
{
  requireNeighbors(cloud, parameters.neighbors, 2);
  require(cloud.hasNormals(), "bilateral smoothing needs a normal for each point");
  require(parameters.sharpness_angle >= 0.0 && parameters.sharpness_angle <= 90.0, "the sharpness angle must be in [0, 90] degrees");
  requireThreads(threads);
  std::vector<Row> rows = rowsOf(cloud);
  withThreads(threads, [&](auto tag) {
    for (unsigned pass = 0; pass < parameters.passes; ++pass)
      CGAL::bilateral_smooth_point_set<decltype(tag)>(
          rows, parameters.neighbors,
          CGAL::parameters::point_map(PointMap()).normal_map(NormalMap()).sharpness_angle(parameters.sharpness_angle));
  });
  writePositions(rows, cloud);
  writeNormals(rows, cloud);
}

void
cgalJetSmooth(PeerCloud& cloud, unsigned neighbors, unsigned passes, unsigned threads)
{
  requireNeighbors(cloud, neighbors, 6);
  requireThreads(threads);
  std::vector<Row> rows = rowsOf(cloud);
  withThreads(threads, [&](auto tag) {
    for (unsigned pass = 0; pass < passes; ++pass)
      CGAL::jet_smooth_point_set<decltype(tag)>(rows, neighbors, CGAL::parameters::point_map(PointMap()));
  });
  writePositions(rows, cloud);
}

void
cgalPcaNormals(PeerCloud& cloud, unsigned neighbors, unsigned threads)
{
  requireNeighbors(cloud, neighbors, 3);
  requireThreads(threads);
  std::vector<Row> rows = rowsOf(cloud);
  withThreads(threads, [&](auto tag) {
    CGAL::pca_estimate_normals<decltype(tag)>(rows, neighbors, CGAL::parameters::point_map(PointMap()).normal_map(NormalMap()));
  });
  writeNormals(rows, cloud);
}

std::size_t
cgalMstOrientNormals(PeerCloud& cloud, unsigned neighbors)
{
  requireNeighbors(cloud, neighbors, 2);
  require(cloud.hasNormals(), "orientation needs a normal for each point");
  std::vector<Row> rows = rowsOf(cloud);
  const auto unoriented =
      CGAL::mst_orient_normals(rows, neighbors, CGAL::parameters::point_map(PointMap()).normal_map(NormalMap()));
  const auto count = static_cast<std::size_t>(std::distance(unoriented, rows.end()));
  writeNormals(rows, cloud);
  return count;
}

} // namespace pcl_gpf::benchmark_peers
