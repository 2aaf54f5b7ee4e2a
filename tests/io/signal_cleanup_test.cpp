// SPDX-License-Identifier: BSD-3-Clause
// A signal at any moment of a write leaves the old file or the complete new one.
#include <gtest/gtest.h>
#include <signal.h>

#include "io/child_process.h"
#include "io/test_clouds.h"
#include "pcl_gpf/io/atomic_file.h"
#include "pcl_gpf/io/read_cloud.h"
#include "pcl_gpf/io/write_cloud.h"

namespace pcl_gpf::test {
namespace {

/** A child writes a large cloud over and over until \a signal_number ends it after \a microseconds. */
int killedWriter(const std::string& path, int signal_number, useconds_t microseconds) {
  int ready[2] = {};
  if (::pipe(ready) != 0) throw std::runtime_error("no pipe");
  const pid_t child = ::fork();
  if (child == 0) {
    installSignalCleanup();
    CloudFile cloud;
    cloud.width = 200000;
    for (const char* name : {"x", "y", "z"})
      cloud.addField(name, FieldType::Float32);
    WriteOptions options;
    options.overwrite = true;
    if (::write(ready[1], "!", 1) != 1) ::_exit(1);
    for (;;)
      writeCloud(cloud, path, options);
  }
  char mark = 0;
  const ssize_t count = ::read(ready[0], &mark, 1);
  ::close(ready[0]);
  ::close(ready[1]);
  ::usleep(microseconds);
  ::kill(child, count == 1 ? signal_number : SIGKILL);
  int status = 0;
  ::waitpid(child, &status, 0);
  return status;
}

TEST(SignalCleanup, SignalsLeaveTheOldOrACompleteFileAndNothingElse) {
  const TemporaryFolder folder;
  std::mt19937 generator(11);
  const std::string path = folder / "a.pcd";
  for (const int signal_number : {SIGINT, SIGTERM, SIGHUP}) {
    for (int round = 0; round < 12; ++round) {
      const int status = killedWriter(path, signal_number, static_cast<useconds_t>(generator() % 20000));
      ASSERT_TRUE(WIFSIGNALED(status));
      EXPECT_EQ(WTERMSIG(status), signal_number);
      const bool exists = std::filesystem::exists(path);
      EXPECT_EQ(folder.entries(), exists ? 1 : 0) << "a temporary file is left";
      EXPECT_TRUE(!exists || readCloud(path).size() == 200000);
    }
  }
}

TEST(SignalCleanup, SigkillLeavesTheOldOrACompleteFile) {
  const TemporaryFolder folder;
  std::mt19937 generator(12);
  const std::string path = folder / "a.pcd";
  for (int round = 0; round < 12; ++round) {
    const std::ptrdiff_t before = folder.entries();
    killedWriter(path, SIGKILL, static_cast<useconds_t>(generator() % 20000));
    EXPECT_TRUE(!std::filesystem::exists(path) || readCloud(path).size() == 200000);
    EXPECT_LE(folder.entries(), before + 2) << "at most the target and one temporary file are new";
  }
}

TEST(SignalCleanup, IgnoredSignalsStayIgnored) {
  const int status = childStatus([] {
    ::signal(SIGHUP, SIG_IGN);
    installSignalCleanup();
    ::raise(SIGHUP);
    ::_exit(7);
  });
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 7);
}

} // namespace
} // namespace pcl_gpf::test
