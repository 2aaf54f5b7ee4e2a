// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "../command.h"

namespace pcl_gpf {

// Each is defined in the file of its name.
Command
infoCommand();
Command
filterCommand();
Command
normalsCommand();
Command
orientCommand();
Command
upsampleCommand();
Command
meshCommand();
Command
runCommand();
Command
convertCommand();
Command
noiseCommand();
Command
compareCommand();
Command
renderCommand();

/** \brief All commands, in the order of the help. */
const std::vector<Command>&
allCommands();

} // namespace pcl_gpf
