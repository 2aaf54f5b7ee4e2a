// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/analysis/synthetic_noise.h>
#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/local_frame.h>
#include <pcl_gpf/core/sampling.h>

#include <string>

namespace pcl_gpf {
namespace {

constexpr double kOutlierBoxFactor = 1.2;

/** \brief Independent sequences of one seed. */
enum class Stream : std::uint64_t { Gaussian = 1, Uniform, AlongNormal, OutlierRows, OutlierPositions };

std::uint64_t
seedOf(Stream stream, std::uint64_t seed)
{
  return SplitMix64(SplitMix64(seed).next() + static_cast<std::uint64_t>(stream)).next();
}

bool
isFinite(const Position& p)
{
  return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
}

void
requireRange(const char* name, double value, double most)
{
  if (!(value >= 0 && value <= most))
    throw InvalidParameter(std::string("SyntheticNoise: ") + name + " is " + std::to_string(value) + "; allowed is 0 .. " +
                           std::to_string(most));
}

void
validate(const SyntheticNoise& noise, std::size_t points, std::size_t normals)
{
  constexpr double kLargest = 1e150;
  requireRange("gaussian", noise.gaussian, kLargest);
  requireRange("uniform", noise.uniform, kLargest);
  requireRange("along_normal", noise.along_normal, kLargest);
  requireRange("outliers", noise.outliers, 1.0);
  if (noise.along_normal > 0 && normals != points)
    throw InvalidParameter("SyntheticNoise: along_normal needs a normal for each of the " + std::to_string(points) +
                           " points; there are " + std::to_string(normals));
}

/** \brief Replaces a random share of the finite points. \return their number */
std::size_t
replaceByOutliers(const SyntheticNoise& noise, const std::vector<std::size_t>& finite_rows, const BoundingBox& box,
                  std::vector<Position>& points)
{
  if (noise.outliers <= 0)
    return 0;
  if (finite_rows.empty())
    throw UnsuitableData("outliers need a bounding box, and no point is finite");
  const auto count = static_cast<std::size_t>(std::llround(noise.outliers * static_cast<double>(finite_rows.size())));
  SplitMix64 random(seedOf(Stream::OutlierPositions, noise.seed));
  for (const std::uint32_t chosen : randomSubset(finite_rows.size(), count, seedOf(Stream::OutlierRows, noise.seed)))
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double centre = 0.5 * box.min[axis] + 0.5 * box.max[axis];
      points[finite_rows[chosen]][axis] = centre + kOutlierBoxFactor * (random.uniform() - 0.5) * (box.max[axis] - box.min[axis]);
    }
  return count;
}

/** \brief Adds Gaussian noise along the normals. \return number of points without a usable one */
std::size_t
addAlongNormals(const SyntheticNoise& noise, const std::vector<std::size_t>& finite_rows,
                const std::vector<Position>& normals, std::vector<Position>& points)
{
  if (noise.along_normal <= 0)
    return 0;
  SplitMix64 random(seedOf(Stream::AlongNormal, noise.seed));
  std::size_t without_normal = 0;
  for (const std::size_t row : finite_rows) {
    const double step = noise.along_normal * random.normal(); // drawn for every point, usable normal or not
    if (!isFinite(normals[row]) || length(normals[row]) <= 0)
      ++without_normal;
    else
      points[row] = addScaled(points[row], step, normalized(normals[row]));
  }
  return without_normal;
}

} // namespace

NoiseReport
addNoise(const SyntheticNoise& noise, std::vector<Position>& points, const std::vector<Position>& normals)
{
  validate(noise, points.size(), normals.size());
  std::vector<std::size_t> finite_rows;
  BoundingBox box;
  for (std::size_t row = 0; row < points.size(); ++row)
    if (isFinite(points[row])) {
      finite_rows.push_back(row);
      box.add(points[row][0], points[row][1], points[row][2]);
    }

  NoiseReport report;
  SplitMix64 gaussian(seedOf(Stream::Gaussian, noise.seed));
  SplitMix64 uniform(seedOf(Stream::Uniform, noise.seed));
  for (const std::size_t row : finite_rows)
    for (double& coordinate : points[row]) {
      if (noise.gaussian > 0)
        coordinate += noise.gaussian * gaussian.normal();
      if (noise.uniform > 0)
        coordinate += noise.uniform * (2 * uniform.uniform() - 1);
    }
  report.without_normal = addAlongNormals(noise, finite_rows, normals, points);
  report.outliers = replaceByOutliers(noise, finite_rows, box, points);
  if (noise.gaussian > 0 || noise.uniform > 0)
    report.moved = finite_rows.size();
  else if (noise.along_normal > 0)
    report.moved = finite_rows.size() - report.without_normal;
  return report;
}

} // namespace pcl_gpf
