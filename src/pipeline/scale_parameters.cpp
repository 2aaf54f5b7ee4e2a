// SPDX-License-Identifier: BSD-3-Clause
#include "scale_parameters.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

namespace pcl_gpf {

namespace {

/** Rounds and angle of the bilateral normal filter and iterations of GPF at the fine scale, at most. More of them would turn small bosses
 * into slopes; what noise is left, the steered fit takes away. */
constexpr unsigned kFineRounds = 2, kFineIterations = 4;
constexpr double kFineAngle = 25.0;
/** Noise in spacings from which planes are steered. Below, a narrow ball holds a surface, and one that follows edges only holds more. */
constexpr double kSteeredFrom = 0.75;
/** Noise in box diagonals up to which they are: neighbourhoods reach ten noises, and beyond this as far as the shape bends. */
constexpr double kSteeredUpTo = 0.02;

/** Noise in spacings below which there is nothing that wider balls could average. */
constexpr double kNoNoise = 0.02;

} // namespace

double
biasOfFewPoints(double spacing, double points)
{
  return 1800.0 * spacing / (points * std::sqrt(points));
}

DenoiseParameters
parametersAt(FilterScale filter_scale, DenoiseParameters parameters, const CloudScale& scale, const LocalFrame& frame,
             DenoiseResult& result)
{
  const auto note = [&](std::vector<ParameterOrigin> origins) {
    for (ParameterOrigin& origin : origins) {
      origin.value = frame.lengthToWorld(origin.value);
      origin.name.insert(0, filter_scale == FilterScale::Fine ? "fine." : "");
      if (origin.reason.find("noise") != std::string::npos)
        origin.reason += strengthNote(parameters.strength);
      result.parameters.push_back(std::move(origin));
    }
  };
  note(estimateParameters(scale, parameters.normals, parameters.bilateral, parameters.gpf, filter_scale));
  if (filter_scale == FilterScale::Coarse && parameters.quadric.levels > 0) {
    parameters.quadric.noise = scale.noise;
    parameters.quadric.spacing = scale.spacing;
    if (scale.noise < kNoNoise * scale.spacing)
      parameters.quadric.levels = 0;
    else
      note(estimateParameters(scale, parameters.quadric));
  }
  if (filter_scale == FilterScale::Fine) {
    const bool steerable = scale.noise >= kSteeredFrom * scale.spacing && scale.noise <= kSteeredUpTo * scale.diagonal;
    if (parameters.steered.radius == 0.0 && !steerable)
      parameters.steered.passes = 0;
    if (parameters.steered.passes > 0)
      note(estimateParameters(scale, parameters.steered));
    parameters.bilateral.iterations = std::min(parameters.bilateral.iterations, kFineRounds);
    parameters.gpf.maximum_iterations = std::min(parameters.gpf.maximum_iterations, kFineIterations);
    parameters.bilateral.angle = std::min(parameters.bilateral.angle, kFineAngle);
  }
  return parameters;
}

std::string
strengthNote(double strength)
{
  if (strength == 1.0)
    return {};
  char text[32]; // as few digits as tell the number, whatever the locale
  return " x strength " + std::string(text, std::to_chars(text, text + sizeof text, strength).ptr);
}

} // namespace pcl_gpf
