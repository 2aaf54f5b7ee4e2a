// SPDX-License-Identifier: BSD-3-Clause
// A signal ends the tool at any time; the output is then the old file or the complete new one, and nothing else is left.
#include "run_tool.h"
#include "tool_clouds.h"

#include <pcl_gpf/core/sampling.h>

#include <gtest/gtest.h>

#include <csignal>
#include <unistd.h>

namespace pcl_gpf::test {
namespace {

void
interruptManyTimes(int signal, int times)
{
  TemporaryFolder folder;
  const std::string input = saveNoisyCube(folder / "in.pcd", 20000);
  const std::vector<std::string> words{"filter", input, "-o", folder / "out.pcd", "--overwrite", "-q"};
  const ToolRun whole = runTool(words);
  ASSERT_EQ(whole.exit_code, 0) << whole.err;
  const std::string complete = readBytes(folder / "out.pcd");

  SplitMix64 random(static_cast<std::uint64_t>(signal));
  int interrupted = 0;
  for (int i = 0; i < times; ++i) {
    writeBytes(folder / "out.pcd", "old");
    RunSetup setup;
    const auto delay = static_cast<useconds_t>(random.uniform() * whole.seconds * 1e6);
    setup.running = [signal, delay](int process) {
      ::usleep(20000 + delay); // the handlers need the start of main()
      ::kill(process, signal);
    };
    const ToolRun run = runTool(words, setup);
    const std::string bytes = readBytes(folder / "out.pcd");
    EXPECT_TRUE(run.signal == signal || run.exit_code == 0) << run.exit_code << run.err;
    EXPECT_TRUE(bytes == "old" || bytes == complete);
    if (run.exit_code == 0) {
      EXPECT_EQ(bytes, complete);
    }
    EXPECT_EQ(folder.entries(), (std::vector<std::string>{"in.pcd", "out.pcd"}));
    interrupted += run.signal == signal ? 1 : 0;
  }
  EXPECT_GT(interrupted, 0);
}

TEST(ToolSignals, InterruptLeavesTheOldOrTheCompleteFile)
{
  interruptManyTimes(SIGINT, 12);
}

TEST(ToolSignals, TerminationLeavesTheOldOrTheCompleteFile)
{
  interruptManyTimes(SIGTERM, 12);
}

TEST(ToolSignals, HangUpLeavesTheOldOrTheCompleteFile)
{
  interruptManyTimes(SIGHUP, 6);
}

} // namespace
} // namespace pcl_gpf::test
