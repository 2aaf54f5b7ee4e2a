// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/shapes.h"

#include <pcl_gpf/core/local_frame.h>
#include <pcl_gpf/core/neighbor_lists.h>
#include <pcl_gpf/core/soa_buffer.h>

#include <cmath>
#include <cstring>
#include <ostream>
#include <vector>

namespace pcl_gpf::test {

/** \brief A shape as the core takes it: float arrays in the frame whose box diagonal is 1, and the same values in double. */
struct LocalCloud {
  SoaBuffer points, normals;
  std::vector<Vector3> v, b; ///< exactly the floats of `points` and `normals`

  std::size_t size() const { return v.size(); }
};

inline void
append(Shape& shape, const Vector3& point, const Vector3& normal)
{
  shape.points.push_back(point);
  shape.normals.push_back(normal);
}

/** \brief Turns a vector about a fixed oblique axis, so that nothing is parallel to the coordinate axes. */
inline Vector3
turned(const Vector3& p)
{
  // Rows of the rotation by 40 degrees about (2, -1, 2) / 3.
  constexpr double cosine = 0.766044443118978, sine = 0.642787609686539;
  constexpr double a[3] = {2.0 / 3, -1.0 / 3, 2.0 / 3};
  const double along = (1 - cosine) * (a[0] * p[0] + a[1] * p[1] + a[2] * p[2]);
  return {cosine * p[0] + sine * (a[1] * p[2] - a[2] * p[1]) + along * a[0],
          cosine * p[1] + sine * (a[2] * p[0] - a[0] * p[2]) + along * a[1],
          cosine * p[2] + sine * (a[0] * p[1] - a[1] * p[0]) + along * a[2]};
}

inline Shape
turned(Shape shape)
{
  for (Vector3& point : shape.points)
    point = turned(point);
  for (Vector3& normal : shape.normals)
    normal = turned(normal);
  return shape;
}

/** \brief Rounds vectors to float. */
inline SoaBuffer
toBuffer(const std::vector<Vector3>& vectors)
{
  SoaBuffer buffer(vectors.size());
  for (std::size_t i = 0; i < vectors.size(); ++i) {
    buffer.x[i] = static_cast<float>(vectors[i][0]);
    buffer.y[i] = static_cast<float>(vectors[i][1]);
    buffer.z[i] = static_cast<float>(vectors[i][2]);
  }
  return buffer;
}

inline std::vector<Vector3>
toVectors(const SoaBuffer& buffer)
{
  std::vector<Vector3> vectors(buffer.size());
  for (std::size_t i = 0; i < buffer.size(); ++i)
    vectors[i] = {buffer.x[i], buffer.y[i], buffer.z[i]};
  return vectors;
}

inline LocalCloud
toLocalCloud(const Shape& shape)
{
  BoundingBox box;
  for (const Vector3& p : shape.points)
    box.add(p[0], p[1], p[2]);
  const LocalFrame frame = localFrame(box);
  LocalCloud cloud;
  cloud.points = SoaBuffer(shape.size());
  for (std::size_t i = 0; i < shape.size(); ++i) {
    cloud.points.x[i] = frame.toLocal(shape.points[i][0], 0);
    cloud.points.y[i] = frame.toLocal(shape.points[i][1], 1);
    cloud.points.z[i] = frame.toLocal(shape.points[i][2], 2);
  }
  cloud.normals = toBuffer(shape.normals);
  cloud.v = toVectors(cloud.points);
  cloud.b = toVectors(cloud.normals);
  return cloud;
}

/** \brief Every second point and so on, not in order of place: sample indices as a user may give them. */
inline std::vector<std::uint32_t>
everySecond(std::size_t size)
{
  std::vector<std::uint32_t> samples;
  for (std::size_t i = 0; i < size; i += 2)
    samples.push_back(static_cast<std::uint32_t>(i));
  return samples;
}

inline double
distance(const Vector3& p, const Vector3& q)
{
  return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}

/** \brief Angle between two unit vectors up to sign, radians. */
inline double
lineAngle(const Vector3& p, const Vector3& q)
{
  const double same = distance(p, q), opposite = distance(p, {-q[0], -q[1], -q[2]});
  return 2 * std::asin(std::fmin(1.0, 0.5 * std::fmin(same, opposite)));
}

inline bool
sameBits(const AlignedArray<float>& a, const AlignedArray<float>& b)
{
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

inline bool
sameBits(const SoaBuffer& a, const SoaBuffer& b)
{
  return sameBits(a.x, b.x) && sameBits(a.y, b.y) && sameBits(a.z, b.z);
}

/** \brief All pairs within the radius, by looking at every pair in double; rows are given in descending order. */
inline NeighborLists
bruteForceSearch(PointsView data, PointsView queries, double radius)
{
  NeighborLists lists;
  lists.offsets.push_back(0);
  for (std::size_t q = 0; q < queries.size; ++q) {
    for (std::size_t j = data.size; j-- > 0;) {
      const double dx = static_cast<double>(data.x[j]) - queries.x[q], dy = static_cast<double>(data.y[j]) - queries.y[q],
                   dz = static_cast<double>(data.z[j]) - queries.z[q];
      if (dx * dx + dy * dy + dz * dz <= radius * radius * (1 + 1e-6))
        lists.indices.push_back(static_cast<std::uint32_t>(j));
    }
    lists.offsets.push_back(lists.indices.size());
  }
  return lists;
}

} // namespace pcl_gpf::test
