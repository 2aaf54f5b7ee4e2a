// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "run_tool.h"
#include "tool_clouds.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <sys/resource.h>
#include <unistd.h>

namespace pcl_gpf::test {

#if defined(__has_feature)
#if __has_feature(address_sanitizer) // as Clang tells it
#define PCL_GPF_TEST_ADDRESS_SANITIZER
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) // as GCC tells it
#define PCL_GPF_TEST_ADDRESS_SANITIZER
#endif

/** \brief A sanitizer multiplies memory, so that limits on it mean nothing. */
#ifdef PCL_GPF_TEST_ADDRESS_SANITIZER
constexpr bool kMemoryIsInstrumented = true;
#else
constexpr bool kMemoryIsInstrumented = false;
#endif

/** \brief In a child: gives up the rights of root, for which no file is locked. */
inline void
becomeNobody()
{
  if (::getuid() == 0 && (::setgid(65534) != 0 || ::setuid(65534) != 0))
    ::_exit(125);
}

class ToolFaults : public ::testing::Test {
protected:
  /** Every command that reads must refuse the file with exit code 3 within a second and name it. */
  void
  expectUnreadable(const std::string& path, const RunSetup& given = {})
  {
    RunSetup setup = given;
    setup.limit_seconds = 10.0;
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"info", path}, std::vector<std::string>{"filter", path, "-o", folder_ / "result.pcd"}}) {
      const ToolRun run = runTool(words, setup);
      EXPECT_EQ(run.exit_code, 3) << path << ": " << run.err;
      EXPECT_LT(run.seconds, 5.0) << path;
      EXPECT_FALSE(std::filesystem::exists(folder_ / "result.pcd"));
    }
  }

  /** The command must end with exit code 4 and leave nothing but what was there. */
  void
  expectUnwritable(const std::vector<std::string>& words, const RunSetup& setup = {})
  {
    const std::vector<std::string> before = folder_.entries();
    const ToolRun run = runTool(words, setup);
    EXPECT_EQ(run.exit_code, 4) << run.err;
    EXPECT_EQ(folder_.entries(), before);
  }

  TemporaryFolder folder_;
};

} // namespace pcl_gpf::test
