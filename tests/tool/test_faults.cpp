// SPDX-License-Identifier: BSD-3-Clause
// Faults of files, folders, limits and the environment: the documented exit code, a bounded time, and no output left behind.
#include "run_tool.h"
#include "tool_clouds.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

namespace pcl_gpf::test {
namespace {

#if defined(__SANITIZE_ADDRESS__)
constexpr bool kMemoryIsInstrumented = true;
#else
constexpr bool kMemoryIsInstrumented = false;
#endif

void
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
  const ToolRun run = runTool({"info", folder_ / "lie.pcd"});
  EXPECT_EQ(run.exit_code, 3) << run.err;
  if (!kMemoryIsInstrumented) {
    EXPECT_LT(run.peak_bytes, std::size_t{50} << 20);
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
