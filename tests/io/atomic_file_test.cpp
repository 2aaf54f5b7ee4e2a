// SPDX-License-Identifier: BSD-3-Clause
// Whatever goes wrong while writing, the target is the old file or the complete new one, and nothing else is left.
#include "pcl_gpf/io/atomic_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <functional>
#include <thread>

#include "io/child_process.h"
#include "io/test_clouds.h"
#include "pcl_gpf/io/errors.h"
#include "pcl_gpf/io/read_cloud.h"
#include "pcl_gpf/io/write_cloud.h"

namespace pcl_gpf::test {
namespace {

constexpr const char* kOld = "the old file\n";

void expectUnwritable(const std::function<void()>& write, const std::string& part) {
  try {
    write();
    ADD_FAILURE() << "no error";
  } catch (const IoError& error) {
    EXPECT_EQ(error.kind(), IoErrorKind::Unwritable);
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

CloudFile smallCloud() {
  return cloudOf({{{1, 2, 3}}, {{4, 5, 6}}});
}

mode_t modeOf(const std::string& path) {
  struct stat status {};
  return ::stat(path.c_str(), &status) == 0 ? status.st_mode & 07777 : 0;
}

TEST(AtomicFile, AppearsOnlyWithCommit) {
  const TemporaryFolder folder;
  const std::string path = folder / "a";
  {
    AtomicFile file(path, false);
    file.write("abc", 3);
    EXPECT_FALSE(std::filesystem::exists(path));
    EXPECT_EQ(folder.entries(), 1) << "the temporary file lies beside the target";
  }
  EXPECT_EQ(folder.entries(), 0) << "without commit nothing stays";
  AtomicFile file(path, false);
  file.write("abc", 3);
  file.write("", 0);
  file.write("def", 3);
  file.commit();
  EXPECT_EQ(bytesOf(path), "abcdef");
  EXPECT_EQ(folder.entries(), 1);
}

TEST(AtomicFile, AnExistingFileNeedsThePermission) {
  const TemporaryFolder folder;
  const std::string path = folder / "a.pcd";
  writeBytes(path, kOld);
  expectUnwritable([&] { checkWritable(path, false); }, "overwrite");
  expectUnwritable([&] { writeCloud(smallCloud(), path); }, "overwrite");
  EXPECT_EQ(bytesOf(path), kOld);
  EXPECT_NO_THROW(checkWritable(path, true));
  WriteOptions options;
  options.overwrite = true;
  writeCloud(smallCloud(), path, options);
  EXPECT_EQ(readCloud(path).size(), 2U);
  EXPECT_EQ(folder.entries(), 1);
}

TEST(AtomicFile, AFileThatAppearsInBetweenIsNotReplaced) {
  const TemporaryFolder folder;
  const std::string path = folder / "a";
  expectUnwritable(
      [&] {
        AtomicFile file(path, false);
        file.write("new", 3);
        writeBytes(path, kOld);
        file.commit();
      },
      "name");
  EXPECT_EQ(bytesOf(path), kOld);
  EXPECT_EQ(folder.entries(), 1);
}

TEST(AtomicFile, PlacesThatCannotBeWrittenAreRefusedAtOnce) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "sub");
  std::filesystem::create_symlink("nowhere", folder / "dangling");
  std::filesystem::create_symlink("loop", folder / "loop");
  ::mkfifo((folder / "fifo").c_str(), 0600);
  writeBytes(folder / "file", kOld);
  const std::ptrdiff_t before = folder.entries();
  const std::pair<std::string, const char*> places[] = {{folder / "missing/a", "a folder that exists"},
                                                        {folder / "sub", "a folder"},
                                                        {folder / "sub/", "the name of a file"},
                                                        {"", "the name of a file"},
                                                        {"/", "the name of a file"},
                                                        {folder / "dangling", "leads nowhere"},
                                                        {folder / "loop", "leads nowhere"},
                                                        {folder / "fifo", "a device"},
                                                        {"/dev/full", "a device"},
                                                        {folder / "file/a", "Not a directory"},
                                                        {folder / std::string(300, 'n'), "too long"}};
  for (const auto& [path, part] : places) {
    SCOPED_TRACE(path);
    for (const bool overwrite : {false, true}) {
      expectUnwritable([&, &name = path] { checkWritable(name, overwrite); }, part);
      expectUnwritable([&, &name = path] { AtomicFile file(name, overwrite); }, part);
    }
  }
  EXPECT_EQ(folder.entries(), before);
  EXPECT_NO_THROW(checkWritable("-", false));
}

TEST(AtomicFile, WithoutTheRightToWriteItIsRefusedAtOnce) {
  if (::geteuid() == 0) {
    // Root may write everywhere, so a child becomes somebody else first.
    const TemporaryFolder folder;
    ::chmod(folder.path().c_str(), 0755);
    writeBytes(folder / "file", kOld);
    const int status = childStatus([&] {
      if (::setgid(65534) != 0 || ::setuid(65534) != 0) ::_exit(9);
      int refused = 0;
      for (const char* name : {"new", "file"}) {
        try {
          checkWritable(folder / name, true);
        } catch (const IoError& error) {
          refused += error.kind() == IoErrorKind::Unwritable;
        }
      }
      ::_exit(refused);
    });
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 2);
  } else {
    const TemporaryFolder folder;
    ::chmod(folder.path().c_str(), 0555);
    expectUnwritable([&] { checkWritable(folder / "a", true); }, "right to write");
    ::chmod(folder.path().c_str(), 0755);
  }
}

TEST(AtomicFile, ModeFollowsUmaskOrTheOldFile) {
  const TemporaryFolder folder;
  const auto write = [&](const char* name, mode_t mask) {
    const mode_t old_mask = ::umask(mask);
    WriteOptions options;
    options.overwrite = true;
    writeCloud(smallCloud(), folder / name, options);
    ::umask(old_mask);
  };
  write("a.pcd", 022);
  EXPECT_EQ(modeOf(folder / "a.pcd"), 0644U);
  write("b.pcd", 077);
  EXPECT_EQ(modeOf(folder / "b.pcd"), 0600U);
  ::chmod((folder / "a.pcd").c_str(), 0640);
  write("a.pcd", 077);
  EXPECT_EQ(modeOf(folder / "a.pcd"), 0640U);
}

TEST(AtomicFile, ALinkStaysALinkAndItsTargetIsReplaced) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "sub");
  writeBytes(folder / "sub/real.pcd", kOld);
  std::filesystem::create_symlink("sub/real.pcd", folder / "link.pcd");
  WriteOptions options;
  options.overwrite = true;
  writeCloud(smallCloud(), folder / "link.pcd", options);
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.pcd"));
  EXPECT_FALSE(std::filesystem::is_symlink(folder / "sub/real.pcd"));
  EXPECT_EQ(readCloud(folder / "sub/real.pcd").size(), 2U);
  EXPECT_EQ(folder.entries(), 2);
}

TEST(AtomicFile, OutputMayBeTheInput) {
  const TemporaryFolder folder;
  for (const char* name : {"a.pcd", "a.ply", "a.xyz"}) {
    writeCloud(smallCloud(), folder / name);
    std::filesystem::create_symlink(folder / name, folder / (std::string("link_") + name));
    for (const std::string& output : {std::string(name), std::string("link_") + name}) {
      const CloudFile cloud = readCloud(folder / name);
      WriteOptions options;
      options.overwrite = true;
      writeCloud(cloud, folder / output, options);
      EXPECT_TRUE(readCloud(folder / name).data == cloud.data);
    }
  }
}

TEST(AtomicFile, ARelativePathMeansTheFolderOfThatMoment) {
  const TemporaryFolder folder;
  const std::filesystem::path start = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  {
    AtomicFile file("relative", false);
    file.write("a", 1);
    std::filesystem::current_path(start);
    file.commit();
  }
  EXPECT_EQ(bytesOf(folder / "relative"), "a");
}

TEST(AtomicFile, ClosedStandardStreamsNeverBecomeTheOutput) {
  const TemporaryFolder folder;
  const std::string path = folder / "a";
  childStatus([&] {
    for (int stream = 0; stream < 3; ++stream)
      ::close(stream);
    AtomicFile file(path, false);
    if (::write(1, "noise", 5) == 5 || ::write(2, "noise", 5) == 5) ::_exit(1);
    file.write("abc", 3);
    file.commit();
  });
  EXPECT_EQ(bytesOf(path), "abc");
}

TEST(AtomicFile, TheWriterReplacedByTwoGivesOneOfTheTwo) {
  const TemporaryFolder folder;
  const std::string path = folder / "a";
  for (int round = 0; round < 20; ++round) {
    const auto write = [&](char letter) {
      AtomicFile file(path, true);
      for (int part = 0; part < 50; ++part)
        file.write(std::string(1000, letter).data(), 1000);
      file.commit();
    };
    std::thread other(write, 'a');
    write('b');
    other.join();
    const std::string bytes = bytesOf(path);
    EXPECT_TRUE(bytes == std::string(50000, 'a') || bytes == std::string(50000, 'b'));
    EXPECT_EQ(folder.entries(), 1);
  }
}

TEST(AtomicFile, NoMoreThanSixtyFourAtATime) {
  const TemporaryFolder folder;
  std::vector<std::unique_ptr<AtomicFile>> files;
  for (int i = 0; i < 64; ++i)
    files.push_back(std::make_unique<AtomicFile>(folder / std::to_string(i), false));
  expectUnwritable([&] { AtomicFile file(folder / "one more", false); }, "64");
  files.clear();
  EXPECT_EQ(folder.entries(), 0);
  EXPECT_NO_THROW(AtomicFile(folder / "one more", false));
}

} // namespace
} // namespace pcl_gpf::test
