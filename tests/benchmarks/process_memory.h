// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdio>
#include <exception>
#include <fstream>
#include <stdexcept>
#include <string>
#include <type_traits>

#include <malloc.h>
#include <sys/wait.h>
#include <unistd.h>

/** \file
 * \brief Memory of this process as Linux counts it, and a fresh process to measure in.
 */
namespace pcl_gpf::benchmark_memory {

/** \brief A line of /proc/self/status in bytes, for example "VmHWM". */
inline double
statusBytes(const std::string& name)
{
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (word == name + ":") {
      double kibibytes = 0;
      status >> kibibytes;
      return 1024 * kibibytes;
    }
  throw std::runtime_error("/proc/self/status has no " + name);
}

/** \brief Forgets the peak so far. \return resident bytes now */
inline double
resetPeak()
{
  malloc_trim(0);
  std::ofstream clear("/proc/self/clear_refs");
  clear << 5 << std::flush;
  if (!clear)
    throw std::runtime_error("/proc/self/clear_refs cannot be written: the peak of memory cannot be reset");
  return statusBytes("VmRSS");
}

/** \brief Largest number of resident bytes since resetPeak(). */
inline double
peak()
{
  return statusBytes("VmHWM");
}

/** \brief Runs `work` in a child process, so that memory of earlier runs does not count, and returns its result. */
template <typename Result, typename Work>
Result
inChildProcess(const Work& work)
{
  static_assert(std::is_trivially_copyable<Result>::value, "goes through a pipe");
  int ends[2];
  if (pipe(ends) != 0)
    throw std::runtime_error("no pipe");
  const pid_t child = fork();
  if (child < 0)
    throw std::runtime_error("no process");
  if (child == 0) {
    int code = 1;
    try {
      const Result result = work();
      code = write(ends[1], &result, sizeof result) == static_cast<ssize_t>(sizeof result) ? 0 : 1;
    } catch (const std::exception& e) {
      std::fprintf(stderr, "%s\n", e.what());
    }
    _exit(code);
  }
  close(ends[1]);
  Result result{};
  const bool complete = read(ends[0], &result, sizeof result) == static_cast<ssize_t>(sizeof result);
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (!complete || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw std::runtime_error("the measurement failed");
  return result;
}

} // namespace pcl_gpf::benchmark_memory
