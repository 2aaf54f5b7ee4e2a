// SPDX-License-Identifier: BSD-3-Clause
#include "orient_options.h"

#include "option_groups.h"
#include "option_values.h"

#include <string>

namespace pcl_gpf {

Viewpoint
chosenViewpoint(const Options& options, const CloudFile& file)
{
  const std::string& text = options.text("viewpoint");
  const std::array<double, 3> sensor{file.viewpoint[0], file.viewpoint[1], file.viewpoint[2]};
  if (text == "none" || (text == "auto" && sensor == std::array<double, 3>{}))
    return std::nullopt;
  if (text == "auto")
    return sensor;
  const std::optional<std::vector<double>> given = parseVector(text);
  if (!given)
    throw UsageError("--viewpoint " + text + ": expected auto, none or three numbers, for example 0,0,1.5");
  return std::array<double, 3>{(*given)[0], (*given)[1], (*given)[2]};
}

NormalOrientationParameters
readOrientationParameters(const Options& options, const LoadedCloud& cloud)
{
  const Length noise = options.length("noise");
  const bool measured = noise.unit == Length::Unit::Spacing || noise.unit == Length::Unit::Diagonal;
  NormalOrientationParameters parameters;
  parameters.neighbors = static_cast<unsigned>(options.count("neighbors"));
  parameters.noise = noise.resolve(measured ? measureCloud(cloud, threadCount(options)) : CloudScale());
  parameters.gap = options.number("gap");
  parameters.number_of_threads = threadCount(options);
  return parameters;
}

std::vector<OptionSpec>
orientOptions()
{
  const NormalOrientationParameters defaults;
  OptionSpec neighbors{"neighbors", OptionKind::Count, "N", std::to_string(defaults.neighbors),
                       "nearest neighbours that each point votes with; more for strong noise, fewer for thin sheets"};
  neighbors.least = 3;
  neighbors.most = 100;
  OptionSpec gap{"gap", OptionKind::Number, "X", "6",
                 "spacings across which separate parts still vote; 0 = each for itself"};
  gap.least = 0;
  gap.most = 100;
  return {{"viewpoint", OptionKind::Text, "X,Y,Z", "auto",
           "turn parts toward this point; auto: the viewpoint of the file unless it is 0,0,0; none: closed parts "
           "outward, others up"},
          neighbors,
          {"noise", OptionKind::Length, "LENGTH", "auto",
           "standard deviation along the normals; shorter offsets tell nothing"},
          gap};
}

} // namespace pcl_gpf
