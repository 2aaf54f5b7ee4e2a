// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "experiment.h"

#include <string>
#include <vector>

namespace pcl_gpf::quality {

/** \brief The filter on one cloud beside the tuned peer with the least mean error there. */
struct PeerComparison {
  const Record* ours;
  const Record* peer;

  bool
  holds() const
  {
    return ours->figures.mean <= peer->figures.mean;
  }
};

/** \brief Compares the first method that begins with "ours" with all that end in "-best", cloud by cloud.
 *
 * Clouds without either are left out. The mean error decides; the edges of the same peer are printed beside ours, not
 * judged. \param[in] records must outlive the result */
std::vector<PeerComparison>
compareWithPeers(const std::vector<Record>& records);

/** \brief A table of the comparisons with a verdict for each. */
std::string
peerTable(const std::vector<PeerComparison>& comparisons);

} // namespace pcl_gpf::quality
