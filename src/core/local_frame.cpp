// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/local_frame.h>

#include <cmath>

namespace pcl_gpf {

double
BoundingBox::diagonal() const
{
  return count == 0 ? 0.0 : std::hypot(max[0] - min[0], max[1] - min[1], max[2] - min[2]);
}

LocalFrame
localFrame(const BoundingBox& box)
{
  return localFrame(box, box);
}

LocalFrame
localFrame(const BoundingBox& box, const BoundingBox& dense)
{
  LocalFrame frame;
  for (std::size_t axis = 0; axis < 3; ++axis)
    frame.origin[axis] = dense.min[axis] + 0.5 * (dense.max[axis] - dense.min[axis]);
  const double diagonal = box.diagonal();
  if (diagonal > 0.0)
    frame.scale = diagonal;
  return frame;
}

} // namespace pcl_gpf
