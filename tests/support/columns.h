// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "shapes.h"

#include <pcl_gpf/pipeline/denoise.h>

#include <vector>

namespace pcl_gpf::test {

/** \brief Points as the pipeline takes them. */
struct Columns {
  std::vector<double> x, y, z;

  Columns() = default;
  explicit Columns(const std::vector<Vector3>& points)
  {
    for (const Vector3& p : points)
      add(p);
  }

  void
  add(const Vector3& p)
  {
    x.push_back(p[0]);
    y.push_back(p[1]);
    z.push_back(p[2]);
  }

  std::size_t size() const { return x.size(); }

  DenoiseInput
  input() const
  {
    DenoiseInput in;
    in.x = x.data();
    in.y = y.data();
    in.z = z.data();
    in.size = size();
    return in;
  }
};

} // namespace pcl_gpf::test
