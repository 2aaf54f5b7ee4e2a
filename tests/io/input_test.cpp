// SPDX-License-Identifier: BSD-3-Clause
// What is no regular file is refused at once, and standard input is read to its end.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <chrono>

#include "io/test_clouds.h"
#include "pcl_gpf/io/errors.h"
#include "pcl_gpf/io/mesh_file.h"
#include "pcl_gpf/io/read_cloud.h"
#include "pcl_gpf/io/write_cloud.h"

namespace pcl_gpf::test {
namespace {

void expectUnreadable(const std::string& path, const std::string& part) {
  SCOPED_TRACE(path);
  const auto start = std::chrono::steady_clock::now();
  for (const bool as_mesh : {false, true}) {
    try {
      if (as_mesh)
        readMesh(path);
      else
        readCloud(path);
      ADD_FAILURE() << "no error";
    } catch (const IoError& error) {
      EXPECT_EQ(error.kind(), IoErrorKind::Unreadable);
      EXPECT_EQ(error.path(), path);
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  }
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 1.0);
}

TEST(Input, WhatIsNoRegularFileIsRefusedAtOnce) {
  const TemporaryFolder folder;
  std::filesystem::create_symlink("loop", folder / "loop");
  std::filesystem::create_symlink("nowhere", folder / "dangling");
  ::mkfifo((folder / "fifo").c_str(), 0600);
  expectUnreadable(folder.path(), "a folder");
  expectUnreadable(folder / "fifo", "pipe");
  for (const char* device : {"/dev/null", "/dev/zero", "/dev/urandom"})
    expectUnreadable(device, "a device");
  expectUnreadable(folder / "loop", "symbolic links");
  expectUnreadable(folder / "dangling", "No such file");
  expectUnreadable(folder / "missing.pcd", "No such file");
  expectUnreadable("", "No such file");
  expectUnreadable(folder / std::string(300, 'n'), "too long");
  writeBytes(folder / "empty.pcd", "");
  expectUnreadable(folder / "empty.pcd", "an empty file");
}

TEST(Input, AnyNameWorks) {
  const TemporaryFolder folder;
  const CloudFile cloud = cloudOf({{{1, 2, 3}}});
  for (const char* name : {"\xe9\xff\xf0.pcd", "new\nline.ply", "-dash.xyz", "two words.pcd", "UPPER.PCD", "a.b.ply"}) {
    writeCloud(cloud, folder / name);
    EXPECT_EQ(readCloud(folder / name).size(), 1U) << name;
  }
  try {
    readCloud(folder / "no\nsuch\x7f.pcd");
    FAIL();
  } catch (const IoError& error) {
    EXPECT_NE(std::string(error.what()).find("no\\x0asuch\\x7f.pcd"), std::string::npos) << error.what();
  }
}

/** Reads a cloud of \a size points from standard input in a child that gets \a bytes in two parts. */
int pointsFromStandardInput(const std::string& bytes) {
  int ends[2] = {};
  if (::pipe(ends) != 0) throw std::runtime_error("no pipe");
  const pid_t child = ::fork();
  if (child == 0) {
    ::close(ends[1]);
    ::dup2(ends[0], 0);
    ::fcntl(0, F_SETFL, O_NONBLOCK); // as a shell may leave it
    try {
      ::_exit(static_cast<int>(readCloud("-").size()));
    } catch (const IoError& error) {
      ::_exit(error.path() == "standard input" ? 100 : 101);
    }
  }
  ::close(ends[0]);
  const std::size_t half = bytes.size() / 2;
  EXPECT_EQ(::write(ends[1], bytes.data(), half), static_cast<ssize_t>(half));
  ::usleep(20000);
  EXPECT_EQ(::write(ends[1], bytes.data() + half, bytes.size() - half), static_cast<ssize_t>(bytes.size() - half));
  ::close(ends[1]);
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(Input, StandardInputIsReadToItsEnd) {
  const TemporaryFolder folder;
  const CloudFile cloud = cloudOf({{{1, 2, 3}}, {{4, 5, 6}}});
  for (const CloudFormat format : kAllFormats) {
    const std::string path = folder / ("a" + extensionFor(format));
    WriteOptions options;
    options.format = format;
    options.overwrite = true;
    writeCloud(cloud, path, options);
    EXPECT_EQ(pointsFromStandardInput(bytesOf(path)), 2) << nameOf(format);
  }
  EXPECT_EQ(pointsFromStandardInput(""), 100);
  EXPECT_EQ(pointsFromStandardInput("a word"), 100);
}

TEST(Input, ALargeFileThatIsNoCloudIsRefusedBeforeItIsRead) {
  const TemporaryFolder folder;
  const std::string path = folder / "sparse.pcd";
  writeBytes(path, "");
  std::error_code error;
  std::filesystem::resize_file(path, std::uintmax_t{1} << 40, error);
  if (error) GTEST_SKIP() << "no sparse files here";
  const auto start = std::chrono::steady_clock::now();
  EXPECT_THROW(readCloud(path), IoError);
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 1.0);
}

TEST(Input, MemoryIsBoundedByTheFile) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "the sanitizer needs more address space than the limit";
#endif
  // 64 MiB above what the process has are plenty for files of a kilobyte, whatever they promise.
  const std::string promises[] = {
      "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 2000000000\nHEIGHT 1\nDATA binary\n",
      "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 2000000000\nHEIGHT 1\nDATA ascii\n1 2 3\n",
      "FIELDS x y z a\nSIZE 8 8 8 8\nTYPE F F F F\nCOUNT 1 1 1 200000000\nWIDTH 1\nHEIGHT 1\nDATA ascii\n1 2 3\n",
      std::string("FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 300000000\nHEIGHT 1\nDATA binary_compressed\n") +
          std::string("\x04\0\0\0\x00\xa4\x93\xd6????", 12),
      "ply\nformat binary_little_endian 1.0\nelement vertex 2000000000\nproperty float x\nproperty float y\nproperty "
      "float z\nend_header\n",
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty list uint float a\nproperty float x\nproperty float "
      "y\nproperty float z\n"
      "end_header\n4000000000 1 2 3\n"};
  for (const std::string& text : promises) {
    const pid_t child = ::fork();
    if (child == 0) {
      std::size_t pages = 0;
      std::ifstream("/proc/self/statm") >> pages;
      const rlim_t limit = pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE)) + (64U << 20);
      const rlimit address_space{limit, limit};
      ::setrlimit(RLIMIT_AS, &address_space);
      try {
        readCloudBuffer(reinterpret_cast<const unsigned char*>(text.data()), text.size(), "a.pcd");
      } catch (const IoError&) {
        ::_exit(3);
      } catch (const std::bad_alloc&) {
        ::_exit(4);
      }
      ::_exit(0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    ASSERT_TRUE(WIFEXITED(status)) << text;
    EXPECT_EQ(WEXITSTATUS(status), 3) << text;
  }
}

} // namespace
} // namespace pcl_gpf::test
