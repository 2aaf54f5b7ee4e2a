// SPDX-License-Identifier: BSD-3-Clause
#include "precision.h"

#include "console.h"

#include <pcl_gpf/core/errors.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_gpf {

namespace {

/** With fewer points a double cloud may hold only round numbers by chance. */
constexpr std::size_t kLeastPointsForDouble = 16;

bool
holdsOnlyFloats(const std::vector<double>& values)
{
  const auto is_float = [](double value) {
    // Out of float's range the cast would be undefined.
    return !std::isfinite(value) || (std::abs(value) <= static_cast<double>(std::numeric_limits<float>::max()) &&
                                     static_cast<double>(static_cast<float>(value)) == value);
  };
  return std::all_of(values.begin(), values.end(), is_float);
}

double
floatStep(double magnitude)
{
  if (!(magnitude < static_cast<double>(std::numeric_limits<float>::max())))
    return 0.0;
  const auto value = static_cast<float>(magnitude);
  return static_cast<double>(std::nextafter(value, std::numeric_limits<float>::infinity()) - value);
}

} // namespace

Precision
judgePrecision(const LoadedCloud& cloud, double spacing)
{
  Precision precision;
  precision.spacing = spacing;
  if (cloud.finite < 2)
    return precision;
  const std::array<const std::vector<double>*, 3> axes{&cloud.coordinates.x, &cloud.coordinates.y, &cloud.coordinates.z};
  const std::array<const char*, 3> names{"x", "y", "z"};
  const BoundingBox box = denseBoxOf(cloud); // one point that strayed far does not make the others coarse
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const int field = cloud.file.findField(names[axis]);
    const bool is_float = field >= 0 && cloud.file.fields[static_cast<std::size_t>(field)].type == FieldType::Float32;
    const double step = floatStep(std::max(std::abs(box.min[axis]), std::abs(box.max[axis])));
    if (step <= precision.step || step <= spacing / 100.0)
      continue;
    const bool is_double = field >= 0 && cloud.file.fields[static_cast<std::size_t>(field)].type == FieldType::Float64;
    const bool was_float = is_double && cloud.finite >= kLeastPointsForDouble && holdsOnlyFloats(*axes[axis]);
    if (!is_float && !was_float)
      continue;
    precision.step = step;
    precision.stored_double = !is_float;
  }
  if (precision.step > 0.0)
    precision.verdict = precision.step > spacing / 2.0 ? Precision::Verdict::Quantized : Precision::Verdict::Coarse;
  return precision;
}

const char*
nameOf(Precision::Verdict verdict)
{
  switch (verdict) {
    case Precision::Verdict::Fine: return "fine";
    case Precision::Verdict::Coarse: return "coarse";
    case Precision::Verdict::Quantized: break;
  }
  return "quantized";
}

std::string
describe(const Precision& precision)
{
  if (precision.verdict == Precision::Verdict::Fine)
    return "coordinates are fine enough for the spacing of the points";
  return std::string("coordinates are quantised: ") +
         (precision.stored_double ? "their doubles hold only floats" : "they are floats") + " in steps of " +
         shortNumber(precision.step) + " so far from the origin, the spacing of the points is " +
         shortNumber(precision.spacing) + "; export them as double, or subtract an offset before storing them as float";
}

void
refuseQuantized(const LoadedCloud& cloud, const CloudScale& scale, bool force, Console& console)
{
  const Precision precision = judgePrecision(cloud, scale.spacing);
  if (precision.verdict == Precision::Verdict::Quantized && !force)
    throw UnsuitableData(describe(precision) + "; --force goes on regardless");
  if (precision.verdict != Precision::Verdict::Fine)
    console.warn(describe(precision));
}

} // namespace pcl_gpf
