// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace pcl_gpf::test {

/** \brief How a run of the tool ended. */
struct ToolRun {
  int exit_code = -1; ///< -1 when a signal ended it
  int signal = 0;
  bool timed_out = false; ///< it was killed
  std::string out, err;
  double seconds = 0.0;
  std::size_t peak_bytes = 0;
};

/** \brief What a test may want to be different from a plain run. */
struct RunSetup {
  std::function<void()> in_child;   ///< called between fork and exec: limits, closed descriptors, environment
  std::function<void(int)> running; ///< called with the process number when it has started, to send signals
  std::string standard_input = "/dev/null";
  std::string folder;           ///< working directory, empty = that of the test
  double limit_seconds = 60.0;
};

/** \brief Runs pcl_gpf_tool with these words and waits for it. */
ToolRun
runTool(const std::vector<std::string>& words, const RunSetup& setup = {});

/** \brief A folder that is removed with all that is in it. */
class TemporaryFolder {
public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder&
  operator=(const TemporaryFolder&) = delete;

  /** \brief Path of a file in it. */
  std::string
  operator/(const std::string& name) const { return path_ + "/" + name; }
  const std::string&
  path() const { return path_; }
  /** \brief Names of all entries, hidden ones too, sorted. */
  std::vector<std::string>
  entries() const;

private:
  std::string path_;
};

/** \brief All bytes of a file; empty when it cannot be read. */
std::string
readBytes(const std::string& path);

void
writeBytes(const std::string& path, const std::string& bytes);

} // namespace pcl_gpf::test
