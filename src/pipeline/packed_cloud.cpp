// SPDX-License-Identifier: BSD-3-Clause
#include "packed_cloud.h"

#include <pcl_gpf/core/dense_box.h>
#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/parallel.h>
#include <pcl_gpf/core/sampling.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace pcl_gpf {

namespace {

constexpr std::size_t kPointsPerTask = 16384;

/** Ascending finite rows and the frame of their box. \throws UnsuitableData */
std::vector<std::uint32_t>
finiteRows(const DenoiseInput& input, LocalFrame& frame)
{
  if (input.size > std::numeric_limits<std::uint32_t>::max())
    throw ExcessiveWork(std::to_string(input.size) + " rows; the limit of one cloud is 2^32 - 1");
  std::vector<std::uint32_t> rows;
  rows.reserve(input.size);
  BoundingBox box;
  for (std::size_t i = 0; i < input.size; ++i)
    if (std::isfinite(input.x[i]) && std::isfinite(input.y[i]) && std::isfinite(input.z[i])) {
      rows.push_back(static_cast<std::uint32_t>(i));
      box.add(input.x[i], input.y[i], input.z[i]);
    }
  if (rows.empty())
    throw UnsuitableData("no point has finite coordinates");
  if (!(box.diagonal() > 0.0))
    throw UnsuitableData("all points are identical");
  if (!std::isfinite(box.diagonal()))
    throw UnsuitableData("the extent of the points is beyond the range of double");
  const double* columns[3] = {input.x, input.y, input.z};
  const auto coordinate = [&](std::size_t k, std::size_t axis) { return columns[axis][rows[k]]; };
  const BoundingBox dense = denseBox(box, rows.size(), coordinate);
  refuseFarPoint(box, dense, rows.size(), coordinate,
                 [&rows](std::size_t k) { return "row " + std::to_string(rows[k]) + " (counted from 0)"; });
  frame = localFrame(box, dense);
  return rows;
}

} // namespace

Packed
packPositions(const DenoiseInput& input, bool with_remainders, unsigned number_of_threads)
{
  Packed packed;
  const std::size_t threads = resolveThreads(number_of_threads);
  std::vector<std::uint32_t> rows = finiteRows(input, packed.frame);
  const double* columns[3] = {input.x, input.y, input.z};
  const auto local = [&](std::size_t axis, std::uint32_t row) {
    return (columns[axis][row] - packed.frame.origin[axis]) / packed.frame.scale;
  };
  {
    SoaBuffer points(rows.size());
    AlignedArray<float>* axes[3] = {&points.x, &points.y, &points.z};
    parallelBlocks(rows.size(), kPointsPerTask, threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t axis = 0; axis < 3; ++axis)
        for (std::size_t k = begin; k < end; ++k)
          (*axes[axis])[k] = static_cast<float>(local(axis, rows[k]));
    });
    packed.index = std::make_unique<PointIndex>(points.view(), number_of_threads);
  }
  packed.rows.resize(rows.size());
  for (std::size_t k = 0; k < rows.size(); ++k)
    packed.rows[k] = rows[packed.index->order()[k]];
  if (!with_remainders)
    return packed;
  packed.remainders = SoaBuffer(rows.size());
  AlignedArray<float>* rests[3] = {&packed.remainders.x, &packed.remainders.y, &packed.remainders.z};
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const double exact = local(axis, packed.rows[k]);
      (*rests[axis])[k] = static_cast<float>(exact - static_cast<double>(static_cast<float>(exact)));
    }
  return packed;
}

void
packNormals(const DenoiseInput& input, Packed& packed)
{
  packed.normals = SoaBuffer(packed.rows.size());
  packed.missing_normals.reserve(input.normal_x ? 0 : packed.rows.size());
  for (std::size_t k = 0; k < packed.rows.size(); ++k) {
    const std::size_t row = packed.rows[k];
    const double x = input.normal_x ? input.normal_x[row] : 0.0, y = input.normal_x ? input.normal_y[row] : 0.0,
                 z = input.normal_x ? input.normal_z[row] : 0.0;
    const double length = std::sqrt(x * x + y * y + z * z);
    if (!(length > 1e-6) || !std::isfinite(length)) {
      packed.missing_normals.push_back(static_cast<std::uint32_t>(k));
      continue;
    }
    packed.normals.x[k] = static_cast<float>(x / length);
    packed.normals.y[k] = static_cast<float>(y / length);
    packed.normals.z[k] = static_cast<float>(z / length);
  }
}

void
spreadNormals(const Packed& packed, std::size_t size, std::vector<float>& x, std::vector<float>& y, std::vector<float>& z)
{
  const auto spread = [&](const AlignedArray<float>& from, std::vector<float>& to) {
    to.assign(size, std::numeric_limits<float>::quiet_NaN());
    for (std::size_t k = 0; k < packed.rows.size(); ++k)
      to[packed.rows[k]] = from[k];
  };
  spread(packed.normals.x, x);
  spread(packed.normals.y, y);
  spread(packed.normals.z, z);
}

SoaBuffer
movedPoints(PointsView points, const std::vector<std::uint32_t>& samples, const SoaBuffer& displacements)
{
  SoaBuffer moved(displacements.size());
  for (std::size_t k = 0; k < moved.size(); ++k) {
    const std::size_t from = samples.empty() ? k : samples[k];
    moved.x[k] = points.x[from] + displacements.x[k];
    moved.y[k] = points.y[from] + displacements.y[k];
    moved.z[k] = points.z[from] + displacements.z[k];
  }
  return moved;
}

std::vector<std::uint32_t>
drawSamples(const GPFParameters& gpf, const Packed& packed)
{
  std::vector<std::uint32_t> samples;
  if (!(gpf.sample_ratio < 1.0))
    return samples;
  const std::size_t size = packed.rows.size();
  const auto count = static_cast<std::size_t>(std::llround(gpf.sample_ratio * static_cast<double>(size)));
  // Drawn among the finite rows in input order, so that the choice does not depend on the sorting.
  std::vector<std::uint32_t> place(size);
  for (std::size_t k = 0; k < size; ++k)
    place[packed.index->order()[k]] = static_cast<std::uint32_t>(k);
  samples = randomSubset(size, std::max<std::size_t>(1, count), gpf.seed);
  for (std::uint32_t& sample : samples)
    sample = place[sample];
  return samples;
}

void
unpack(const DenoiseInput& input, Packed packed, FilteredCloud cloud, const std::vector<std::uint32_t>& samples, std::size_t threads,
       DenoiseResult& result)
{
  const std::size_t count = cloud.displacements.size();
  const auto forEach = [&](const auto& body) {
    parallelBlocks(count, kPointsPerTask, threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k)
        body(k);
    });
  };
  // Place of each of the recursion's results in the output: samples are ascending already; all points follow the index.
  const std::vector<std::uint32_t> order = samples.empty() ? packed.index->order() : std::vector<std::uint32_t>();
  packed.index.reset();
  packed.normals = SoaBuffer();
  const auto placeOf = [&](std::size_t k) { return order.empty() ? k : order[k]; };
  result.sample_indices.resize(count);
  forEach([&](std::size_t k) { result.sample_indices[placeOf(k)] = packed.rows[samples.empty() ? k : samples[k]]; });
  std::vector<std::uint32_t>().swap(packed.rows);
  const auto take = [&](auto& values, auto& to) { // and gives their room to the next
    to.resize(count);
    forEach([&](std::size_t k) { to[placeOf(k)] = values[k]; });
    values = {};
  };
  take(cloud.isolated, result.isolated);
  const auto take_if_there = [&](auto& values, auto& to) {
    if (!values.empty())
      take(values, to);
  };
  take_if_there(cloud.outlier, result.outlier);
  take_if_there(cloud.sigma, result.sigma);
  take_if_there(cloud.edge, result.edge);
  take_if_there(cloud.fine, result.fine);
  take(cloud.normals.x, result.normal_x);
  take(cloud.normals.y, result.normal_y);
  take(cloud.normals.z, result.normal_z);

  const auto move = [&](const double* start, AlignedArray<float>& moves, std::vector<double>& to) {
    to.resize(count);
    forEach([&](std::size_t k) {
      const std::size_t place = placeOf(k);
      to[place] = start[result.sample_indices[place]];
      if (moves[k] != 0.0f) // adding 0 would turn -0 into 0
        to[place] += packed.frame.lengthToWorld(static_cast<double>(moves[k]));
    });
    moves = AlignedArray<float>();
  };
  move(input.x, cloud.displacements.x, result.x);
  move(input.y, cloud.displacements.y, result.y);
  move(input.z, cloud.displacements.z, result.z);
}

} // namespace pcl_gpf
