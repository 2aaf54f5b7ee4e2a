// SPDX-License-Identifier: BSD-3-Clause
#include "apply_result.h"

#include "console.h"
#include "field_types.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace pcl_gpf {

namespace {

const std::vector<std::string> kAxes{"x", "y", "z"};
const std::vector<std::string> kNormals{"normal_x", "normal_y", "normal_z"};

Movement
summarize(std::vector<double> distances)
{
  Movement movement;
  if (distances.empty())
    return movement;
  const auto count = static_cast<double>(distances.size());
  for (const double distance : distances) {
    movement.mean += distance / count;
    movement.rms += distance * distance / count;
    movement.max = std::max(movement.max, distance);
  }
  movement.rms = std::sqrt(movement.rms);
  const std::size_t rank = (distances.size() * 95 + 99) / 100 - 1;
  std::nth_element(distances.begin(), distances.begin() + static_cast<std::ptrdiff_t>(rank), distances.end());
  movement.p95 = distances[rank];
  return movement;
}

using Place = std::array<double, 3>;

/** Moves above this share of the limit were cut. */
constexpr double kAtLimit = 1.0 - 1e-5;

/** Stores a point; \return how far it is from `before` in the numbers stored. */
double
write(CloudFile& cloud, std::size_t row, const std::array<int, 3>& fields, const Place& before, const Place& after)
{
  Place moved{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (cloud.value(row, fields[axis]) != after[axis]) // -0 stays -0
      cloud.setValue(row, fields[axis], after[axis]);
    moved[axis] = cloud.value(row, fields[axis]) - before[axis];
  }
  return std::hypot(moved[0], moved[1], moved[2]);
}

/** Stores a point no further from `before` than `limit`, whatever the rounding of the fields; as it was when nothing else will do. */
double
writeWithin(CloudFile& cloud, std::size_t row, const std::array<int, 3>& fields, const Place& before, const Place& after, double limit)
{
  double distance = write(cloud, row, fields, before, after);
  double share = 1.0;
  for (int tries = 0; distance > limit && tries < 20; ++tries) {
    share *= std::min(limit / distance, 0.999);
    Place nearer = before;
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (after[axis] != before[axis])
        nearer[axis] += share * (after[axis] - before[axis]);
    distance = write(cloud, row, fields, before, nearer);
  }
  return distance > limit ? write(cloud, row, fields, before, before) : distance;
}

std::vector<float>
toFloats(const CloudFile& cloud, const std::string& field)
{
  const int index = cloud.findField(field);
  std::vector<float> values(cloud.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = static_cast<float>(cloud.value(i, index));
  return values;
}

} // namespace

Movement
applyPositions(LoadedCloud& cloud, const DenoiseResult& result, Console& console)
{
  const std::vector<std::string> promoted = promoteIntegerFields(cloud.file, kAxes, FieldType::Float64);
  if (!promoted.empty())
    console.say("integer coordinates are written as double, because filtered points lie between whole numbers");
  const bool all = result.sample_indices.size() == cloud.finite;
  if (!all)
    cloud.file = cloud.file.select(result.sample_indices);
  widenCoordinates(cloud.file, result.x, result.y, result.z);
  std::array<int, 3> fields{};
  std::transform(kAxes.begin(), kAxes.end(), fields.begin(),
                 [&cloud](const std::string& axis) { return cloud.file.findField(axis); });
  const std::vector<std::uint32_t> rows = rowsOf(cloud, result);
  std::vector<double> distances(rows.size());
  std::size_t limited = 0;
  for (std::size_t k = 0; k < distances.size(); ++k) {
    const std::size_t from = result.sample_indices[k];
    const Place before{cloud.coordinates.x[from], cloud.coordinates.y[from], cloud.coordinates.z[from]};
    distances[k] = writeWithin(cloud.file, rows[k], fields, before, {result.x[k], result.y[k], result.z[k]}, result.max_move);
    limited += distances[k] > result.max_move * kAtLimit;
  }
  Movement movement = summarize(distances);
  movement.limited = limited;
  movement.of_points = std::move(distances);
  return movement;
}

std::vector<std::uint32_t>
rowsOf(const LoadedCloud& cloud, const DenoiseResult& result)
{
  std::vector<std::uint32_t> rows = result.sample_indices;
  if (rows.size() < cloud.finite)
    std::iota(rows.begin(), rows.end(), 0u);
  return rows;
}

void
applyNormals(CloudFile& cloud, const DenoiseResult& result, const std::vector<std::uint32_t>& rows)
{
  promoteIntegerFields(cloud, kNormals, FieldType::Float32);
  const std::array<const std::vector<float>*, 3> values{&result.normal_x, &result.normal_y, &result.normal_z};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    int field = cloud.findField(kNormals[axis]);
    if (field < 0) {
      field = cloud.addField(kNormals[axis], FieldType::Float32);
      for (std::size_t i = 0; i < cloud.size() && !rows.empty(); ++i)
        cloud.setValue(i, field, std::numeric_limits<double>::quiet_NaN());
    }
    for (std::size_t k = 0; k < values[axis]->size(); ++k)
      cloud.setValue(rows.empty() ? k : rows[k], field, static_cast<double>((*values[axis])[k]));
  }
}

FilterInput
filterInput(const LoadedCloud& cloud, bool with_normals)
{
  FilterInput input;
  input.view.x = cloud.coordinates.x.data();
  input.view.y = cloud.coordinates.y.data();
  input.view.z = cloud.coordinates.z.data();
  input.view.size = cloud.file.size();
  if (!with_normals)
    return input;
  input.normal_x = toFloats(cloud.file, kNormals[0]);
  input.normal_y = toFloats(cloud.file, kNormals[1]);
  input.normal_z = toFloats(cloud.file, kNormals[2]);
  input.view.normal_x = input.normal_x.data();
  input.view.normal_y = input.normal_y.data();
  input.view.normal_z = input.normal_z.data();
  return input;
}

} // namespace pcl_gpf
