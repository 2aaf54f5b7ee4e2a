// SPDX-License-Identifier: BSD-3-Clause
#include "../option_groups.h"
#include "commands.h"

namespace pcl_gpf {

const std::vector<Command>&
allCommands()
{
  static const std::vector<Command> commands = [] {
    std::vector<Command> list{infoCommand(),    filterCommand(),  normalsCommand(), orientCommand(), upsampleCommand(), meshCommand(),
                              runCommand(),     convertCommand(), compareCommand(), noiseCommand(),  renderCommand()};
    for (Command& command : list)
      command.options = command.options + std::vector<OptionSpec>{quietOption(), helpOption()};
    return list;
  }();
  return commands;
}

} // namespace pcl_gpf
