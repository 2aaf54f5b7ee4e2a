// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "options.h"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace pcl_gpf {

/** \brief What the tool returns to the shell. Death by a signal shows as 128 + its number (130 for Ctrl-C). */
enum ExitCode : int {
  kExitOk = 0,
  kExitInternal = 1,    ///< out of memory, or an error of this program
  kExitUsage = 2,       ///< wrong command line or parameter
  kExitInput = 3,       ///< input unreadable or broken
  kExitOutput = 4,      ///< output cannot be written, standard output included
  kExitUnsuitable = 5   ///< the data cannot be worked on: empty, nothing finite, all identical, quantised
};

/** \brief One line of the examples at the top of a command's help. */
struct Example {
  std::string command_line; ///< to copy and paste, begins with "pcl_gpf_tool"
  std::string meaning;
};

/** \brief A command of the tool: what the help shows and the function that does it. */
struct Command {
  std::string name;
  std::string summary;  ///< one line
  std::string synopsis; ///< what follows the name, for example "IN -o OUT [options]"
  std::array<Example, 3> examples;
  std::size_t least_files = 1; ///< file names without an option
  std::size_t most_files = 1;
  std::vector<OptionSpec> options; ///< its own and those of option_groups.h; --help and --quiet are added to every command
  std::string notes;               ///< text after the options, may be empty
  /** Does the work. Throws UsageError, InputError and OutputError of io, and what the library throws; the caller turns each
   * into its exit code and one sentence. */
  ExitCode (*run)(const Options& options) = nullptr;
};

/** \brief The help of one command: examples first, then every option with unit, range and default. */
std::string
helpText(const Command& command);

/** \brief The options of a command as a Markdown table, for docs/tool.md. */
std::string
markdownTable(const Command& command);

} // namespace pcl_gpf
