// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/cluster_tree.h>
#include <pcl_gpf/core/point_index.h>
#include <pcl_gpf/core/views.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_gpf {

/** \brief Splits [begin, end) into runs of neighbours whose box is at most `widest` wide, and calls f(first, last, box) for each, so
 * that one search of the tree serves many queries. \param[in] position callable index -> position, near each other in turn */
template <typename Position, typename F>
void
forPatches(std::size_t begin, std::size_t end, float widest, const Position& position, const F& f)
{
  for (std::size_t first = begin; first < end;) {
    FloatBox box{position(first), position(first)};
    std::size_t last = first + 1;
    for (; last < end; ++last) {
      const std::array<float, 3> next = position(last);
      FloatBox wider = box;
      float width = 0.0f;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        wider.min[axis] = std::min(box.min[axis], next[axis]);
        wider.max[axis] = std::max(box.max[axis], next[axis]);
        width = std::max(width, wider.max[axis] - wider.min[axis]);
      }
      if (width > widest)
        break;
      box = wider;
    }
    f(first, last, box);
    first = last;
  }
}

/** \brief Copies of the points near a box, one after another; a thread uses the memory again for each. */
struct NearbyPoints {
  std::vector<float> x, y, z, nx, ny, nz;
  std::vector<std::uint32_t> places; ///< in the sorted order of the index, ascending

  std::size_t size() const { return places.size(); }

  void
  fill(const PointIndex& points, NormalsView normals, const FloatBox& box, float radius)
  {
    runs_.clear();
    points.tree().collectRuns(box, radius, runs_);
    const PointsView p = points.sorted();
    const auto copy = [this](const float* from, std::vector<float>& to) {
      to.clear();
      for (const Run run : runs_)
        to.insert(to.end(), from + run.begin, from + run.end);
    };
    copy(p.x, x);
    copy(p.y, y);
    copy(p.z, z);
    copy(normals.x, nx);
    copy(normals.y, ny);
    copy(normals.z, nz);
    places.clear();
    for (const Run run : runs_)
      for (std::uint32_t j = run.begin; j < run.end; ++j)
        places.push_back(j);
  }

  /** Copies those of `from` whose squared distance is below `limit`; their distances move to the front. \return how many */
  std::size_t
  select(const NearbyPoints& from, std::vector<float>& distance_sq, float limit)
  {
    for (std::vector<float>* values : {&x, &y, &z, &nx, &ny, &nz})
      values->resize(from.size());
    places.resize(from.size());
    std::size_t count = 0;
    for (std::size_t k = 0; k < from.size(); ++k) {
      x[count] = from.x[k];
      y[count] = from.y[k];
      z[count] = from.z[k];
      nx[count] = from.nx[k];
      ny[count] = from.ny[k];
      nz[count] = from.nz[k];
      places[count] = from.places[k];
      distance_sq[count] = distance_sq[k];
      count += distance_sq[k] < limit;
    }
    places.resize(count);
    return count;
  }

private:
  std::vector<Run> runs_;
};

} // namespace pcl_gpf
