// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/pipeline/presets.h>

namespace pcl_gpf {

DenoiseParameters
prismaticPreset()
{
  DenoiseParameters parameters;
  parameters.bilateral.iterations = 10;
  return parameters;
}

DenoiseParameters
freeformPreset()
{
  DenoiseParameters parameters;
  parameters.bilateral.angle = 60.0;
  return parameters;
}

DenoiseParameters
paperPreset()
{
  DenoiseParameters parameters;
  parameters.gpf = GPFParameters::paper();
  return parameters;
}

} // namespace pcl_gpf
