// SPDX-License-Identifier: BSD-3-Clause
#include "foresight.h"

#include <pcl_gpf/core/analysis/work_estimate.h>

namespace pcl_gpf {

void
refuseExcessiveStages(const DenoiseParameters& p, const Packed& packed, std::size_t samples)
{
  refuseExcessiveWork(estimateWork(p.normals, *packed.index));
  refuseExcessiveWork(estimateWork(p.bilateral, *packed.index));
  if (samples > 0)
    refuseExcessiveWork(estimateWork(p.gpf, *packed.index, samples));
}

} // namespace pcl_gpf
