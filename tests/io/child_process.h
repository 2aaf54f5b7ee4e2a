// SPDX-License-Identifier: BSD-3-Clause
// Tests that change what a process has only one of: limits, signals, standard streams, the user.
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <functional>

namespace pcl_gpf::test {

/** Runs \a body in a child process and returns how it ended. */
inline int childStatus(const std::function<void()>& body) {
  const pid_t child = ::fork();
  if (child == 0) {
    body();
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return status;
}

} // namespace pcl_gpf::test
