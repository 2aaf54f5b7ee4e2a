// SPDX-License-Identifier: BSD-3-Clause
#include "filter_presets.h"

namespace pcl_gpf {

OptionSpec
presetOption()
{
  OptionSpec preset{"preset", OptionKind::Choice, "", "default",
                    "freeform: smooth shapes; prismatic: flat faces and sharp edges; paper: Algorithm 1 with its literal values"};
  preset.choices = {"default", "freeform", "prismatic", "paper"};
  return preset;
}

DenoiseParameters
presetNamed(const std::string& name)
{
  return name == "paper" ? paperPreset() : name == "prismatic" ? prismaticPreset() : name == "freeform" ? freeformPreset() : DenoiseParameters();
}

} // namespace pcl_gpf
