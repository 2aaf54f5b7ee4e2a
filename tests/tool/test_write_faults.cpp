// SPDX-License-Identifier: BSD-3-Clause
// Faults of output files and folders: exit code 4, nothing left behind, and the old file untouched.
#include "tool_faults.h"

#include <fcntl.h>
#include <filesystem>
#include <sys/mount.h>
#include <sys/stat.h>

namespace pcl_gpf::test {
namespace {

TEST_F(ToolFaults, FullDeviceIsExitCode4) // W01
{
  const std::string input = saveNoisyCube(folder_ / "in.pcd", 500);
  if (!std::filesystem::exists("/dev/full"))
    GTEST_SKIP() << "no /dev/full";
  expectUnwritable({"filter", input, "-o", "/dev/full", "--overwrite"});
  RunSetup setup;
  setup.in_child = [] {
    const int full = ::open("/dev/full", O_WRONLY);
    ::dup2(full, 1);
  };
  expectUnwritable({"info", input, "--json"}, setup);
  expectUnwritable({"info", input}, setup);
  expectUnwritable({"convert", input, "-o", "-"}, setup);
  expectUnwritable({"--help"}, setup);
}

TEST_F(ToolFaults, FullDiskLeavesNoFileAndTheOldOneUntouched) // W02 W03
{
  std::filesystem::create_directory(folder_ / "small");
  if (::mount("tmpfs", (folder_ / "small").c_str(), "tmpfs", 0, "size=1m") != 0)
    GTEST_SKIP() << "may not mount a small disk here";
  const std::string input = saveNoisyCube(folder_ / "in.pcd", 200000);
  const std::string old = folder_ / "small/old.ply";
  writeBytes(old, "a good old file");
  EXPECT_EQ(runTool({"convert", input, "-o", folder_ / "small/out.pcd"}).exit_code, 4);
  EXPECT_EQ(runTool({"convert", input, "-o", old, "--overwrite"}).exit_code, 4);
  EXPECT_EQ(readBytes(old), "a good old file");
  std::size_t entries = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / "small"))
    entries += entry.path().empty() ? 0 : 1;
  EXPECT_EQ(entries, 1u);
  ::umount((folder_ / "small").c_str());
}

TEST_F(ToolFaults, FileSizeLimitIsExitCode4) // W04
{
  const std::string input = saveNoisyCube(folder_ / "in.pcd", 20000);
  RunSetup setup;
  setup.in_child = [] {
    const rlimit limit{100 * 1024, 100 * 1024};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  };
  expectUnwritable({"convert", input, "-o", folder_ / "out.pcd"}, setup);
}

TEST_F(ToolFaults, ImpossibleOutputsAreRefusedBeforeTheInputIsRead) // W05
{
  // A missing input would be exit code 3, so 4 shows the order.
  std::filesystem::create_directory(folder_ / "directory.pcd");
  saveNoisyCube(folder_ / "exists.pcd", 50);
  expectUnwritable({"filter", "missing.pcd", "-o", folder_ / "no/such/folder/out.pcd"});
  expectUnwritable({"filter", "missing.pcd", "-o", folder_ / "directory.pcd", "--overwrite"});
  expectUnwritable({"filter", "missing.pcd", "-o", folder_ / "exists.pcd"});
  expectUnwritable({"filter", "missing.pcd", "-o", folder_ / "cloud.jpeg"});
  expectUnwritable({"filter", "missing.pcd", "-o", folder_ / "new.pcd", "--json=" + (folder_ / "no/report.json")});
  std::filesystem::create_directory(folder_ / "read_only");
  ::chmod((folder_ / "read_only").c_str(), 0555);
  std::filesystem::permissions(folder_.path(), std::filesystem::perms(0755));
  RunSetup setup;
  setup.in_child = becomeNobody;
  if (runTool({"--version"}, setup).exit_code == 0)
    expectUnwritable({"filter", "missing.pcd", "-o", folder_ / "read_only/out.pcd"}, setup);
}

TEST_F(ToolFaults, OutputMayBeTheInput) // W06
{
  for (const char* kind : {"same", "hard link", "symbolic link"}) {
    const std::string input = saveNoisyCube(folder_ / "in.pcd", 1000);
    std::string output = input;
    if (kind != std::string("same"))
      output = folder_ / kind + ".pcd";
    if (kind == std::string("hard link"))
      std::filesystem::create_hard_link(input, output);
    if (kind == std::string("symbolic link"))
      std::filesystem::create_symlink(input, output);
    const double before = distanceToCube(readCloud(input));
    EXPECT_EQ(runTool({"filter", input, "-o", output}).exit_code, 4) << "without --overwrite";
    const ToolRun run = runTool({"filter", input, "-o", output, "--overwrite"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(readCloud(output).size(), 1000u);
    EXPECT_LT(distanceToCube(readCloud(output)), before) << kind;
  }
}

TEST_F(ToolFaults, ALinkStaysALinkAndItsTargetIsReplaced) // W07
{
  const std::string input = saveNoisyCube(folder_ / "in.pcd", 500);
  writeBytes(folder_ / "target.pcd", "old");
  std::filesystem::create_symlink(folder_ / "target.pcd", folder_ / "link.pcd");
  EXPECT_EQ(runTool({"convert", input, "-o", folder_ / "link.pcd", "--overwrite"}).exit_code, 0);
  EXPECT_TRUE(std::filesystem::is_symlink(folder_ / "link.pcd"));
  EXPECT_EQ(readCloud(folder_ / "target.pcd").size(), 500u);
}

TEST_F(ToolFaults, ModeFollowsUmaskOrTheOldFile) // W10
{
  const std::string input = saveNoisyCube(folder_ / "in.pcd", 100);
  for (const mode_t mask : {mode_t{077}, mode_t{022}}) {
    RunSetup setup;
    setup.in_child = [mask] { ::umask(mask); };
    const std::string output = folder_ / ("mask" + std::to_string(mask) + ".pcd");
    ASSERT_EQ(runTool({"convert", input, "-o", output}, setup).exit_code, 0);
    struct stat status {};
    ::stat(output.c_str(), &status);
    EXPECT_EQ(status.st_mode & 0777u, 0666u & ~mask);
    ::chmod(output.c_str(), 0640);
    ASSERT_EQ(runTool({"convert", input, "-o", output, "--overwrite"}, setup).exit_code, 0);
    ::stat(output.c_str(), &status);
    EXPECT_EQ(status.st_mode & 0777u, 0640u);
  }
}

} // namespace
} // namespace pcl_gpf::test
