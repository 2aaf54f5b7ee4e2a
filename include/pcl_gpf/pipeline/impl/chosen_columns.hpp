// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/common/pack.h>
#include <pcl_gpf/pipeline/denoise.h>

#include <pcl/point_cloud.h>

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

namespace pcl_gpf {

namespace detail {

/** \brief Chosen points in double, with their normals; NaN where a normal is not usable. */
struct ChosenColumns {
  template <typename PointT>
  ChosenColumns(const pcl::PointCloud<PointT>& cloud, const PackedCloud& chosen)
  {
    for (std::size_t i = 0; i < chosen.chosen.size(); ++i) {
      const PointT& point = cloud[static_cast<std::size_t>(chosen.chosen[i])];
      const bool usable = chosen.states[i] == PointState::Usable;
      const float position[3] = {point.x, point.y, point.z}, normal[3] = {point.normal_x, point.normal_y, point.normal_z};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        positions[axis].push_back(static_cast<double>(position[axis]));
        normals[axis].push_back(usable ? normal[axis] : std::numeric_limits<float>::quiet_NaN());
      }
      any_normal = any_normal || usable;
    }
  }

  DenoiseInput
  view() const
  {
    DenoiseInput input{positions[0].data(), positions[1].data(), positions[2].data(), positions[0].size()};
    if (any_normal) {
      input.normal_x = normals[0].data();
      input.normal_y = normals[1].data();
      input.normal_z = normals[2].data();
    }
    return input;
  }

  std::array<std::vector<double>, 3> positions;
  std::array<std::vector<float>, 3> normals;
  bool any_normal = false;
};

} // namespace detail

} // namespace pcl_gpf
