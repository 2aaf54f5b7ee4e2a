// SPDX-License-Identifier: BSD-3-Clause
// What the writers refuse, and that the locale changes nothing.
#include "pcl_gpf/io/write_cloud.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <clocale>
#include <locale>

#include "io/child_process.h"
#include "io/test_clouds.h"
#include "pcl_gpf/io/errors.h"
#include "pcl_gpf/io/read_cloud.h"

namespace pcl_gpf::test {
namespace {

/** A locale with decimal comma and thousands points, as de_DE has. */
struct CommaNumbers : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

TEST(Locale, TheLocaleChangesNothing) {
  CloudFile cloud;
  cloud.width = 3000;
  for (const char* name : {"x", "y", "z"})
    cloud.addField(name, FieldType::Float32);
  fillRandom(cloud, 7);
  const TemporaryFolder folder;
  for (const CloudFormat format : kAllFormats) {
    SCOPED_TRACE(nameOf(format));
    WriteOptions options;
    options.format = format;
    const std::string before = folder / ("before" + extensionFor(format));
    const std::string after = folder / ("after" + extensionFor(format));
    options.overwrite = true;
    writeCloud(cloud, before, options);
    const std::locale old = std::locale::global(std::locale(std::locale(), new CommaNumbers));
    for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "de_DE"})
      if (std::setlocale(LC_ALL, name)) break;
    writeCloud(cloud, after, options);
    const CloudFile read = readCloud(after);
    std::locale::global(old);
    std::setlocale(LC_ALL, "C");
    EXPECT_EQ(bytesOf(before), bytesOf(after));
    EXPECT_EQ(read.size(), cloud.size());
    EXPECT_EQ(static_cast<float>(read.value(1, 0)), static_cast<float>(cloud.value(1, 0)));
  }
}

TEST(WriteCloud, WhatAFormatCannotHoldIsRefusedBeforeTheFileExists) {
  const TemporaryFolder folder;
  CloudFile cloud = cloudOf({{{1, 2, 3}}});
  const int time = cloud.addField("time", FieldType::UInt64);
  const std::uint64_t exact = std::uint64_t{1} << 53;
  std::memcpy(cloud.data.data() + 12, &exact, sizeof exact);
  EXPECT_NO_THROW(checkFits(cloud, CloudFormat::PlyAscii, "a.ply"));
  const std::uint64_t too_large = exact + 1;
  std::memcpy(cloud.data.data() + 12, &too_large, sizeof too_large);
  EXPECT_THROW(writeCloud(cloud, folder / "a.ply"), IoError);
  EXPECT_EQ(folder.entries(), 0);
  EXPECT_NO_THROW(writeCloud(cloud, folder / "a.pcd"));
  EXPECT_TRUE(readCloud(folder / "a.pcd").data == cloud.data);
  // The same for negative numbers.
  cloud.fields[static_cast<std::size_t>(time)].type = FieldType::Int64;
  const std::int64_t lowest = -static_cast<std::int64_t>(exact);
  std::memcpy(cloud.data.data() + 12, &lowest, sizeof lowest);
  EXPECT_NO_THROW(checkFits(cloud, CloudFormat::PlyAscii, "a.ply"));
  const std::int64_t too_low = lowest - 1;
  std::memcpy(cloud.data.data() + 12, &too_low, sizeof too_low);
  EXPECT_THROW(checkFits(cloud, CloudFormat::PlyAscii, "a.ply"), IoError);
  cloud.addField("wide", FieldType::UInt8, 1000);
  EXPECT_THROW(checkFits(cloud, CloudFormat::Xyz, "a.xyz"), IoError);
  EXPECT_NO_THROW(checkFits(cloud, CloudFormat::PcdAscii, "a.pcd"));
}

TEST(WriteCloud, InconsistentCloudsAreTheCallersError) {
  const TemporaryFolder folder;
  const CloudFile good = cloudOf({{{1, 2, 3}}});
  CloudFile cloud = good;
  cloud.width = 2;
  EXPECT_THROW(writeCloud(cloud, folder / "a.pcd"), std::invalid_argument);
  cloud = good;
  cloud.fields[1].name = "x";
  EXPECT_THROW(writeCloud(cloud, folder / "a.pcd"), std::invalid_argument);
  cloud = good;
  cloud.fields[2].name = "z ";
  EXPECT_THROW(writeCloud(cloud, folder / "a.pcd"), std::invalid_argument);
  cloud = good;
  cloud.fields[2].name = "w";
  EXPECT_THROW(writeCloud(cloud, folder / "a.pcd"), std::invalid_argument);
  cloud = good;
  cloud.fields[2].offset = 4;
  EXPECT_THROW(writeCloud(cloud, folder / "a.pcd"), std::invalid_argument);
  EXPECT_EQ(folder.entries(), 0);
}

TEST(WriteCloud, AFileSizeLimitIsAnErrorAndTheOldFileStays) {
  const TemporaryFolder folder;
  CloudFile cloud;
  cloud.width = 100000;
  for (const char* name : {"x", "y", "z"})
    cloud.addField(name, FieldType::Float64);
  fillRandom(cloud, 1);
  for (const CloudFormat format : kAllFormats) {
    SCOPED_TRACE(nameOf(format));
    const std::string path = folder / ("a" + extensionFor(format));
    writeBytes(path, "the old file\n");
    const std::ptrdiff_t before = folder.entries();
    const int status = childStatus([&] {
      installSignalCleanup(); // or SIGXFSZ ends the process
      const rlimit limit{100 << 10, 100 << 10};
      ::setrlimit(RLIMIT_FSIZE, &limit);
      WriteOptions options;
      options.format = format;
      options.overwrite = true;
      try {
        writeCloud(cloud, path, options);
      } catch (const IoError& error) {
        ::_exit(error.kind() == IoErrorKind::Unwritable ? 5 : 1);
      }
    });
    ASSERT_TRUE(WIFEXITED(status)) << "signal " << WTERMSIG(status);
    EXPECT_EQ(WEXITSTATUS(status), 5);
    EXPECT_EQ(bytesOf(path), "the old file\n");
    EXPECT_EQ(folder.entries(), before);
  }
}

TEST(WriteCloud, AFullStandardOutputIsAnError) {
  const int status = childStatus([] {
    const int full = ::open("/dev/full", O_WRONLY);
    ::dup2(full, 1);
    try {
      writeCloud(cloudOf({{{1, 2, 3}}, {{4, 5, 6}}}), "-");
    } catch (const IoError& error) {
      ::_exit(error.kind() == IoErrorKind::Unwritable ? 5 : 1);
    }
  });
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 5);
}

TEST(WriteCloud, StandardOutputGetsTheSameBytes) {
  const TemporaryFolder folder;
  const std::string path = folder / "stdout";
  childStatus([&] {
    ::dup2(::open(path.c_str(), O_WRONLY | O_CREAT, 0600), 1);
    writeCloud(cloudOf({{{1, 2, 3}}, {{4, 5, 6}}}), "-");
  });
  writeCloud(cloudOf({{{1, 2, 3}}, {{4, 5, 6}}}), folder / "a.pcd");
  EXPECT_EQ(bytesOf(path), bytesOf(folder / "a.pcd"));
}

} // namespace
} // namespace pcl_gpf::test
