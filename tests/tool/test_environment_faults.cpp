// SPDX-License-Identifier: BSD-3-Clause
// Faults of memory and environment: words and a documented exit code, or the same result as ever.
#include "tool_faults.h"

#include <cstdlib>
#include <filesystem>

namespace pcl_gpf::test {
namespace {

TEST_F(ToolFaults, HugeRadiusIsRefusedOrBounded) // M03
{
  // Every point is a neighbour of every other: 4e8 pairs, which must not be stored.
  const std::string input = saveNoisyCube(folder_ / "in.pcd", 20000);
  RunSetup setup;
  setup.limit_seconds = 100.0;
  const ToolRun run = runTool({"filter", input, "-o", folder_ / "out.pcd", "--radius", "1000", "--iterations", "1"}, setup);
  EXPECT_FALSE(run.timed_out);
  EXPECT_TRUE(run.exit_code == 0 || run.exit_code == 5) << run.err;
  EXPECT_EQ(std::filesystem::exists(folder_ / "out.pcd"), run.exit_code == 0);
  if (!kMemoryIsInstrumented) {
    EXPECT_LT(run.peak_bytes, std::size_t{100} << 20);
  }
}

TEST_F(ToolFaults, PromisesOfAHeaderCostNoMemory) // M04
{
  writeBytes(folder_ / "lie.pcd", "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 4000000000\nHEIGHT 1\n"
                                  "POINTS 4000000000\nDATA binary\n0123456789");
  const std::size_t idle = runTool({"--version"}).peak_bytes; // the libraries alone
  const ToolRun run = runTool({"info", folder_ / "lie.pcd"});
  EXPECT_EQ(run.exit_code, 3) << run.err;
  if (!kMemoryIsInstrumented) {
    EXPECT_LT(run.peak_bytes, idle + (std::size_t{10} << 20));
  }
}

TEST_F(ToolFaults, TooLittleMemoryIsSaidInWords) // M01
{
  if (kMemoryIsInstrumented)
    GTEST_SKIP() << "the sanitizer needs the address space";
  const std::string input = saveNoisyCube(folder_ / "in.pcd", 1000000);
  RunSetup setup;
  setup.in_child = [] {
    const rlimit limit{std::size_t{160} << 20, std::size_t{160} << 20};
    ::setrlimit(RLIMIT_AS, &limit);
  };
  const ToolRun run = runTool({"filter", input, "-o", folder_ / "out.pcd", "--threads", "1"}, setup);
  EXPECT_EQ(run.exit_code, 1) << run.err;
  EXPECT_NE(run.err.find("out of memory"), std::string::npos) << run.err;
  EXPECT_EQ(folder_.entries(), (std::vector<std::string>{"in.pcd"}));
}

TEST_F(ToolFaults, ALocaleWithDecimalCommasChangesNoByte) // E01
{
  const std::string input = saveNoisyCube(folder_ / "in.pcd", 1000);
  ASSERT_EQ(runTool({"filter", input, "-o", folder_ / "c.ply", "--format", "ply-ascii", "--radius", "4.5x"}).exit_code, 0);
  RunSetup setup;
  setup.in_child = [] {
    ::setenv("LC_ALL", "de_DE.UTF-8", 1);
    ::setenv("LANG", "de_DE.UTF-8", 1);
  };
  ASSERT_EQ(runTool({"filter", input, "-o", folder_ / "de.ply", "--format", "ply-ascii", "--radius", "4.5x"}, setup).exit_code, 0);
  EXPECT_EQ(readBytes(folder_ / "c.ply"), readBytes(folder_ / "de.ply"));
}

TEST_F(ToolFaults, ClosedStandardStreamsNeverBecomeTheOutputFile) // E03
{
  const std::string input = saveNoisyCube(folder_ / "in.pcd", 1000);
  ASSERT_EQ(runTool({"filter", input, "-o", folder_ / "whole.pcd"}).exit_code, 0);
  for (const int closed : {0, 1, 2, 3}) {
    RunSetup setup;
    setup.in_child = [closed] {
      for (int descriptor = 0; descriptor <= 2; ++descriptor)
        if (closed == descriptor || closed == 3)
          ::close(descriptor);
    };
    const ToolRun run = runTool({"filter", input, "-o", folder_ / "out.pcd", "--overwrite", "--progress", "plain"}, setup);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(readBytes(folder_ / "out.pcd"), readBytes(folder_ / "whole.pcd"));
  }
  RunSetup without_output;
  without_output.in_child = [] { ::close(1); };
  EXPECT_EQ(runTool({"info", input}, without_output).exit_code, 4);
  EXPECT_EQ(runTool({"convert", input, "-o", "-"}, without_output).exit_code, 4);
  RunSetup without_input;
  without_input.in_child = [] { ::close(0); };
  EXPECT_EQ(runTool({"info", "-"}, without_input).exit_code, 3);
}

TEST_F(ToolFaults, TheEnvironmentMayBeEmpty) // E04
{
  const std::string input = saveNoisyCube(folder_ / "in.pcd", 300);
  RunSetup setup;
  setup.in_child = [] {
    ::clearenv();
    ::setenv("TMPDIR", "/no/such/folder", 1);
    ::setenv("TZ", "Nowhere/Atlantis", 1);
  };
  const ToolRun run = runTool({"filter", input, "-o", folder_ / "out.pcd"}, setup);
  EXPECT_EQ(run.exit_code, 0) << run.err;
}

} // namespace
} // namespace pcl_gpf::test
