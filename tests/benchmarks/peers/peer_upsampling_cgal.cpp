// SPDX-License-Identifier: BSD-3-Clause
// Includes headers of CGAL under the GPL: see peer_methods.h.
#include "peer_checks.h"
#include "peer_upsampling.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/edge_aware_upsample_point_set.h>
#include <CGAL/property_map.h>

#include <iterator>
#include <utility>

namespace pcl_gpf::benchmark_peers {

PeerCloud
cgalUpsample(const PeerCloud& cloud, double edge_sensitivity, std::size_t count)
{
  using Kernel = CGAL::Simple_cartesian<double>;
  using Row = std::pair<Kernel::Point_3, Kernel::Vector_3>;
  require(cloud.hasNormals(), "the cloud has no normals");
  require(count > cloud.size(), "the count must be larger than the cloud");
  std::vector<Row> rows, made;
  for (std::size_t i = 0; i < cloud.size(); ++i)
    rows.emplace_back(Kernel::Point_3(cloud.x[i], cloud.y[i], cloud.z[i]),
                      Kernel::Vector_3(cloud.normal_x[i], cloud.normal_y[i], cloud.normal_z[i]));
  CGAL::edge_aware_upsample_point_set<CGAL::Sequential_tag>(rows, std::back_inserter(made),
                                                            CGAL::parameters::point_map(CGAL::First_of_pair_property_map<Row>())
                                                                .normal_map(CGAL::Second_of_pair_property_map<Row>())
                                                                .sharpness_angle(30.0)
                                                                .edge_sensitivity(edge_sensitivity)
                                                                .neighbor_radius(0.0)
                                                                .number_of_output_points(count));
  PeerCloud result;
  for (const auto& [point, normal] : made) {
    result.x.push_back(point.x());
    result.y.push_back(point.y());
    result.z.push_back(point.z());
    result.normal_x.push_back(normal.x());
    result.normal_y.push_back(normal.y());
    result.normal_z.push_back(normal.z());
  }
  return result;
}

} // namespace pcl_gpf::benchmark_peers
