// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "models.h"

#include <pcl_gpf/core/local_frame.h>
#include <pcl_gpf/core/point_index.h>
#include <pcl_gpf/pipeline/denoise.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace pcl_gpf::benchmark_models {

/** \brief Noisy points of a model as the pipeline takes them, and what lies around them. */
struct ModelCloud {
  std::vector<double> x, y, z;

  /** \param[in] percent standard deviation of the noise along each axis, % of the box diagonal */
  ModelCloud(const std::string& model, std::size_t size, double percent)
  {
    for (std::vector<double>* axis : {&x, &y, &z})
      axis->reserve(size);
    for (const test::Vector3& p : makeModel(model, size, percent).points) {
      x.push_back(p[0]);
      y.push_back(p[1]);
      z.push_back(p[2]);
    }
  }

  /** \brief The first `count` points; valid as long as this cloud is. */
  DenoiseInput
  input(std::size_t count) const
  {
    DenoiseInput input;
    input.x = x.data();
    input.y = y.data();
    input.z = z.data();
    input.size = std::min(count, x.size());
    return input;
  }
};

/** \brief A cloud sorted in the normalised frame, for counting. */
class Surroundings {
public:
  explicit Surroundings(const ModelCloud& cloud) : frame_(frameOf(cloud)), index_(toLocal(cloud, frame_).view()) {}

  /** \brief Radius, in cloud units, of the balls that hold `neighbors` points on average, their centres included; from a sample of
   * about a thousand centres. */
  double
  radiusOfNeighbors(double neighbors) const
  {
    const PointsView p = index_.sorted();
    const std::size_t step = std::max<std::size_t>(1, p.size / 1000);
    // Far more than the mean, so that no crowded ball is cut short.
    const auto nearest = static_cast<std::size_t>(4 * neighbors);
    std::vector<float> pooled, distances_sq;
    std::size_t centres = 0;
    for (std::size_t i = 0; i < p.size; i += step, ++centres) {
      index_.tree().nearest(p, {p.x[i], p.y[i], p.z[i]}, nearest, distances_sq);
      pooled.insert(pooled.end(), distances_sq.begin(), distances_sq.end());
    }
    const auto within = static_cast<std::size_t>(neighbors * static_cast<double>(centres));
    if (!(neighbors >= 1) || within >= pooled.size())
      throw std::invalid_argument("a ball of this cloud cannot hold that many neighbours");
    std::nth_element(pooled.begin(), pooled.begin() + static_cast<std::ptrdiff_t>(within), pooled.end());
    return frame_.lengthToWorld(std::sqrt(static_cast<double>(pooled[within])));
  }

  /** \brief Pairs of a point and one of `centres`, as places in the cloud's order, nearer than `radius` (cloud units). */
  double
  pairsWithin(double radius, const std::vector<std::uint32_t>& centres) const
  {
    const PointsView p = index_.sorted();
    const double local = frame_.lengthToLocal(radius);
    std::vector<std::uint32_t> places(p.size);
    for (std::uint32_t k = 0; k < p.size; ++k)
      places[index_.order()[k]] = k;
    std::vector<Run> runs;
    std::size_t pairs = 0;
    for (const std::uint32_t centre : centres) {
      const std::size_t place = places[centre];
      const std::array<float, 3> q = {p.x[place], p.y[place], p.z[place]};
      runs.clear();
      index_.tree().collectRuns({q, q}, static_cast<float>(local), runs);
      for (const Run& run : runs)
        for (std::size_t j = run.begin; j < run.end; ++j) {
          const float dx = p.x[j] - q[0], dy = p.y[j] - q[1], dz = p.z[j] - q[2];
          pairs += static_cast<double>(dx * dx + dy * dy + dz * dz) < local * local;
        }
    }
    return static_cast<double>(pairs);
  }

private:
  static LocalFrame
  frameOf(const ModelCloud& cloud)
  {
    BoundingBox box;
    for (std::size_t i = 0; i < cloud.x.size(); ++i)
      box.add(cloud.x[i], cloud.y[i], cloud.z[i]);
    return localFrame(box);
  }

  static SoaBuffer
  toLocal(const ModelCloud& cloud, const LocalFrame& frame)
  {
    SoaBuffer points(cloud.x.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      points.x[i] = frame.toLocal(cloud.x[i], 0);
      points.y[i] = frame.toLocal(cloud.y[i], 1);
      points.z[i] = frame.toLocal(cloud.z[i], 2);
    }
    return points;
  }

  LocalFrame frame_;
  PointIndex index_;
};

/** \brief Lengths with which every ball of the chain (planes, bilateral filter, data ball of GPF) has the radius `radius`. */
inline void
setBalls(DenoiseParameters& parameters, double radius)
{
  parameters.normals.radius = radius;
  parameters.bilateral.radius = radius;
  parameters.gpf.support_radius = 2 * radius;
}

} // namespace pcl_gpf::benchmark_models
