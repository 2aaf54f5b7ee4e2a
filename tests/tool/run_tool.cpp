// SPDX-License-Identifier: BSD-3-Clause
#include "run_tool.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace pcl_gpf::test {

namespace {

using Clock = std::chrono::steady_clock;

void
redirect(const std::string& path, int flags, int descriptor)
{
  const int file = ::open(path.c_str(), flags, 0600);
  if (file < 0 || ::dup2(file, descriptor) < 0)
    ::_exit(126);
  if (file != descriptor)
    ::close(file);
}

[[noreturn]] void
becomeTool(const std::vector<std::string>& words, const RunSetup& setup, const TemporaryFolder& files)
{
  redirect(setup.standard_input, O_RDONLY | O_NONBLOCK, 0);
  ::fcntl(0, F_SETFL, ::fcntl(0, F_GETFL) & ~O_NONBLOCK);
  redirect(files / "out", O_WRONLY | O_CREAT, 1);
  redirect(files / "err", O_WRONLY | O_CREAT, 2);
  if (!setup.folder.empty() && ::chdir(setup.folder.c_str()) != 0)
    ::_exit(126);
  std::vector<char*> arguments{const_cast<char*>("pcl_gpf_tool")};
  for (const std::string& word : words)
    arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  if (setup.in_child)
    setup.in_child();
  ::execv(PCL_GPF_TOOL_PATH, arguments.data());
  ::_exit(127);
}

} // namespace

ToolRun
runTool(const std::vector<std::string>& words, const RunSetup& setup)
{
  const TemporaryFolder files;
  const Clock::time_point begin = Clock::now();
  const auto elapsed = [begin] { return std::chrono::duration<double>(Clock::now() - begin).count(); };
  const pid_t process = ::fork();
  if (process < 0)
    throw std::runtime_error("fork failed");
  if (process == 0)
    becomeTool(words, setup, files);
  if (setup.running)
    setup.running(process);

  ToolRun run;
  int status = 0;
  rusage usage{};
  while (::wait4(process, &status, WNOHANG, &usage) == 0) {
    if (!run.timed_out && elapsed() > setup.limit_seconds) {
      run.timed_out = true;
      ::kill(process, SIGKILL);
    }
    ::usleep(1000);
  }
  run.seconds = elapsed();
  run.peak_bytes = static_cast<std::size_t>(usage.ru_maxrss) * 1024;
  run.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  run.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  run.out = readBytes(files / "out");
  run.err = readBytes(files / "err");
  return run;
}

TemporaryFolder::TemporaryFolder()
{
  std::string name = (std::filesystem::temp_directory_path() / "pcl_gpf_test_XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr)
    throw std::runtime_error("no temporary folder");
  path_ = name;
}

TemporaryFolder::~TemporaryFolder()
{
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::vector<std::string>
TemporaryFolder::entries() const
{
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(path_))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

std::string
readBytes(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  std::ostringstream bytes;
  bytes << file.rdbuf();
  return bytes.str();
}

void
writeBytes(const std::string& path, const std::string& bytes)
{
  std::ofstream(path, std::ios::binary) << bytes;
}

} // namespace pcl_gpf::test
