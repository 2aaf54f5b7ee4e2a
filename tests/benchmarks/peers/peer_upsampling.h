// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "peer_methods.h"

namespace pcl_gpf::benchmark_peers {

/** \brief CGAL::edge_aware_upsample_point_set (one thread), sharpness angle 30 degrees, CGAL's choice of radius.
 * \param[in] cloud with consistently oriented normals
 * \param[in] edge_sensitivity 0 .. 1, a tenth of the exponent rho
 * \param[in] count points in all, more than the cloud has
 * \return the new points alone, with normals */
PeerCloud
cgalUpsample(const PeerCloud& cloud, double edge_sensitivity, std::size_t count);

} // namespace pcl_gpf::benchmark_peers
