// SPDX-License-Identifier: BSD-3-Clause
// Faults of input files: the documented exit code, a bounded time, and no output left behind.
#include "tool_faults.h"

#include <algorithm>
#include <filesystem>
#include <sys/stat.h>
#include <unistd.h>

namespace pcl_gpf::test {
namespace {

TEST_F(ToolFaults, DirectoriesPipesAndDevicesAreNoInput) // R01 R02 R04 R05
{
  ::mkfifo((folder_ / "pipe.pcd").c_str(), 0600);
  for (const std::string& path : {folder_.path(), folder_ / "pipe.pcd", std::string("/dev/null"), std::string("/dev/zero"),
                                  std::string("/dev/urandom")})
    expectUnreadable(path);
}

TEST_F(ToolFaults, MissingFilesAndLoopsAreNoInput) // R06
{
  std::filesystem::create_symlink(folder_ / "loop", folder_ / "loop");
  std::filesystem::create_symlink(folder_ / "nowhere", folder_ / "dangling");
  for (const std::string& path : {folder_ / "missing.pcd", folder_ / "loop", folder_ / "dangling", std::string(),
                                  folder_ / std::string(300, 'a')})
    expectUnreadable(path);
}

TEST_F(ToolFaults, StandardInputMayBeAPipeButNotEmpty) // R03
{
  const std::string bytes = readBytes(saveNoisyCube(folder_ / "in.pcd", 20000));
  RunSetup setup;
  setup.limit_seconds = 30.0;
  setup.in_child = [&bytes] {
    int ends[2];
    if (::pipe(ends) != 0)
      ::_exit(126);
    if (::fork() == 0) { // a slow writer, more than a pipe holds
      ::close(ends[0]);
      for (std::size_t done = 0; done < bytes.size();) {
        const ssize_t written = ::write(ends[1], bytes.data() + done, std::min<std::size_t>(50000, bytes.size() - done));
        if (written <= 0)
          break;
        done += static_cast<std::size_t>(written);
        ::usleep(20000);
      }
      ::_exit(0);
    }
    ::dup2(ends[0], 0);
    ::close(ends[0]);
    ::close(ends[1]);
  };
  const ToolRun run = runTool({"info", "-"}, setup);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find("20000 finite"), std::string::npos) << run.out;
  RunSetup empty;
  expectUnreadable("-", empty);
}

TEST_F(ToolFaults, NoPermissionIsNoInput) // R07
{
  std::filesystem::permissions(folder_.path(), std::filesystem::perms(0755));
  saveNoisyCube(folder_ / "locked.pcd", 50);
  ::chmod((folder_ / "locked.pcd").c_str(), 0);
  std::filesystem::create_directory(folder_ / "closed");
  saveNoisyCube(folder_ / "closed/cloud.pcd", 50);
  ::chmod((folder_ / "closed").c_str(), 0);
  RunSetup setup;
  setup.in_child = becomeNobody;
  if (runTool({"--version"}, setup).exit_code != 0)
    GTEST_SKIP() << "another user may not run the tool here";
  EXPECT_EQ(runTool({"info", folder_ / "locked.pcd"}, setup).exit_code, 3);
  EXPECT_EQ(runTool({"info", folder_ / "closed/cloud.pcd"}, setup).exit_code, 3);
  ::chmod((folder_ / "closed").c_str(), 0700);
}

TEST_F(ToolFaults, OddNamesWork) // R08
{
  for (const std::string& name : {std::string("\xe9\xff\xf0.pcd"), std::string("two\nlines.pcd"), std::string("with spaces.pcd"),
                                  std::string("-dash.pcd")}) {
    saveNoisyCube(folder_ / name, 200);
    RunSetup setup;
    setup.folder = folder_.path();
    const ToolRun run = runTool({"filter", "-o", "./out " + name, "--json", "-q", "--", name}, setup);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(readCloud(folder_ / ("out " + name)).size(), 200u);
  }
}

TEST_F(ToolFaults, ContentDecidesTheFormatNotTheName) // R10
{
  saveNoisyCube(folder_ / "a.ply", 200);
  saveNoisyCube(folder_ / "b.pcd", 200);
  std::filesystem::copy(folder_ / "a.ply", folder_ / "ply.pcd");
  std::filesystem::copy(folder_ / "b.pcd", folder_ / "pcd.PLY");
  std::filesystem::copy(folder_ / "b.pcd", folder_ / "bare");
  for (const char* name : {"ply.pcd", "pcd.PLY", "bare"})
    EXPECT_EQ(runTool({"info", folder_ / name}).exit_code, 0) << name;
}

} // namespace
} // namespace pcl_gpf::test
