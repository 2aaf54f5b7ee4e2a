// SPDX-License-Identifier: BSD-3-Clause
/** \file
 * \brief pcl_gpf_tool: finds the command, runs it, and turns every way it can end into an exit code and one sentence.
 */
#include "command.h"
#include "commands/commands.h"
#include "console.h"
#include "spelling.h"

#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/io/atomic_file.h>
#include <pcl_gpf/io/errors.h>
#include <pcl_gpf/version.h>

#include <cstdio>
#include <exception>
#include <fcntl.h>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

namespace pcl_gpf {

namespace {

/** A closed descriptor 0, 1 or 2 would be given to the next file opened, which then received what is meant for the terminal.
 * They are opened the wrong way round, so that using them fails as it should. */
void
occupyStandardDescriptors()
{
  for (int descriptor = 0; descriptor <= 2; ++descriptor)
    if (::fcntl(descriptor, F_GETFD) == -1)
      static_cast<void>(::open("/dev/null", descriptor == 0 ? O_WRONLY : O_RDONLY));
}

std::string
overview()
{
  std::string text = "Examples:\n"
                     "  pcl_gpf_tool filter scan.pcd -o clean.pcd   # remove noise, keep edges, points and all fields\n"
                     "  pcl_gpf_tool info scan.ply                  # what is in a file\n"
                     "  pcl_gpf_tool filter --help                  # all options of a command\n\n"
                     "Usage: pcl_gpf_tool COMMAND [options] FILE...\n\nCommands:\n";
  for (const Command& command : allCommands())
    text += "  " + command.name + std::string(10 - command.name.size(), ' ') + command.summary + "\n";
  return text + "\nOther options: --help, --version, --markdown (the tables of options, as in docs/tool.md)\n";
}

std::string
markdown()
{
  std::string text;
  for (const Command& command : allCommands())
    text += "### " + command.name + "\n\n" + command.summary + ". `pcl_gpf_tool " + command.name + " " + command.synopsis +
            "`\n\n" + markdownTable(command) + "\n";
  return text;
}

const Command&
findCommand(const std::string& name)
{
  std::vector<std::string> names;
  for (const Command& command : allCommands()) {
    if (command.name == name)
      return command;
    names.push_back(command.name);
  }
  const std::string nearest = nearestSpelling(name, names);
  throw UsageError("unknown command '" + printable(name) + "'" +
                   (nearest.empty() ? "; see pcl_gpf_tool --help" : "; did you mean '" + nearest + "'?"));
}

ExitCode
runCommand(const Command& command, const std::vector<std::string>& words)
{
  const Options options = Options::parse(command.options, words, command.most_files);
  if (options.given("help")) {
    printToStandardOutput(helpText(command));
    return kExitOk;
  }
  if (options.files().size() < command.least_files)
    throw UsageError(options.files().empty() ? "no input file" : "a file is missing");
  return command.run(options);
}

ExitCode
run(const std::vector<std::string>& words)
{
  if (words.empty()) {
    std::fputs(overview().c_str(), stderr);
    return kExitUsage;
  }
  const std::vector<std::string> rest(words.begin() + 1, words.end());
  if (words[0] == "--help" || words[0] == "-h" || (words[0] == "help" && rest.empty()))
    printToStandardOutput(overview());
  else if (words[0] == "--version")
    printToStandardOutput("pcl_gpf_tool " PCL_GPF_VERSION "\n");
  else if (words[0] == "--markdown")
    printToStandardOutput(markdown());
  else if (words[0] == "help")
    printToStandardOutput(helpText(findCommand(rest[0])));
  else
    return runCommand(findCommand(words[0]), rest);
  return kExitOk;
}

ExitCode
fail(ExitCode code, const std::string& sentence)
{
  std::fputs(("pcl_gpf_tool: " + sentence + "\n").c_str(), stderr);
  return code;
}

/** Must not ask for memory itself. */
ExitCode
failOutOfMemory()
{
  std::fputs("pcl_gpf_tool: out of memory\n", stderr);
  return kExitInternal;
}

ExitCode
runGuarded(const std::vector<std::string>& words)
{
  try {
    return run(words);
  } catch (const UsageError& error) {
    return fail(kExitUsage, error.what());
  } catch (const InvalidParameter& error) {
    return fail(kExitUsage, error.what());
  } catch (const IoError& error) {
    return fail(error.kind() == IoErrorKind::Unreadable ? kExitInput : kExitOutput, error.what());
  } catch (const UnsuitableData& error) {
    return fail(kExitUnsuitable, error.what());
  } catch (const ExcessiveWork& error) {
    return fail(kExitUnsuitable, error.what());
  } catch (const std::bad_alloc&) {
    return failOutOfMemory();
  } catch (const std::length_error&) {
    return failOutOfMemory();
  } catch (const std::exception& error) {
    return fail(kExitInternal, std::string("internal error: ") + error.what());
  } catch (...) {
    return fail(kExitInternal, "internal error of an unknown kind");
  }
}

} // namespace

} // namespace pcl_gpf

int
main(int argc, char** argv)
{
  pcl_gpf::occupyStandardDescriptors();
  pcl_gpf::installSignalCleanup();
  return pcl_gpf::runGuarded(std::vector<std::string>(argv + (argc > 0 ? 1 : 0), argv + argc));
}
