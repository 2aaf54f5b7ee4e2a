// SPDX-License-Identifier: BSD-3-Clause
#include "scale_parameters.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

namespace pcl_gpf {

namespace {

/** Rounds and angle of the bilateral normal filter and iterations of GPF at the finer scales, at most. More of them would turn small bosses
 * into slopes; what noise is left, the steered fit takes away. */
constexpr unsigned kFineRounds = 2, kFineIterations = 4;
constexpr double kFineAngle = 25.0;
/** Rounds where noise is so strong that no plane is steered: nothing else takes the rest away. */
constexpr unsigned kFineRoundsAlone = 3;
/** Points in a ball from which on means stand for them in the fine bilateral filter. Its layer of noise is as thick as the ball is
 * wide, so few can be merged, and those lie close together. */
constexpr unsigned kFineMergeAbove = 60;
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
toLocal(DenoiseParameters p, const LocalFrame& frame)
{
  p.normals.radius = frame.lengthToLocal(p.normals.radius);
  p.bilateral.radius = frame.lengthToLocal(p.bilateral.radius);
  p.gpf.support_radius = frame.lengthToLocal(p.gpf.support_radius);
  p.steered.radius = frame.lengthToLocal(p.steered.radius);
  p.quadric.radius = frame.lengthToLocal(p.quadric.radius);
  p.steered.direction_radius = frame.lengthToLocal(p.steered.direction_radius);
  p.normals.number_of_threads = p.bilateral.number_of_threads = p.gpf.number_of_threads = p.steered.number_of_threads =
      p.quadric.number_of_threads = p.number_of_threads;
  return p;
}

DenoiseParameters
parametersAt(FilterScale filter_scale, DenoiseParameters parameters, const CloudScale& scale, const LocalFrame& frame,
             DenoiseResult& result)
{
  const auto note = [&](std::vector<ParameterOrigin> origins) {
    for (ParameterOrigin& origin : origins) {
      origin.value = frame.lengthToWorld(origin.value);
      origin.name.insert(0, filter_scale == FilterScale::Finest ? "finest." : filter_scale == FilterScale::Fine ? "fine." : "");
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
  }
  if (filter_scale == FilterScale::Fine || filter_scale == FilterScale::Finest) {
    const bool strong = scale.noise > kSteeredUpTo * scale.diagonal;
    parameters.bilateral.iterations = std::min(parameters.bilateral.iterations, strong ? kFineRoundsAlone : kFineRounds);
    parameters.bilateral.merge_above = std::min(parameters.bilateral.merge_above, kFineMergeAbove);
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
