// SPDX-License-Identifier: BSD-3-Clause
// Every system call of a write, and every allocation of a read or write, is made to fail once. The functions defined
// here stand in for the system's, in the library, too.
#include <dlfcn.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstdlib>
#include <new>

#include "io/test_clouds.h"
#include "pcl_gpf/common/export.h"
#include "pcl_gpf/io/errors.h"
#include "pcl_gpf/io/read_cloud.h"
#include "pcl_gpf/io/write_cloud.h"

namespace {

struct Fault {
  const char* function = nullptr; // nullptr: none
  int calls_until = 0;            // 0: the next one fails
  bool happened = false;
};
Fault fault;
bool writes_are_short = false;

bool failsNow(const char* function) {
  if (!fault.function || fault.happened || std::strcmp(fault.function, function) != 0 || fault.calls_until-- > 0)
    return false;
  fault.happened = true;
  errno = EIO;
  return true;
}

template <typename Function>
Function* original(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

void* allocate(std::size_t size) {
  void* memory = failsNow("new") ? nullptr : std::malloc(size == 0 ? 1 : size);
  if (!memory) throw std::bad_alloc();
  return memory;
}

} // namespace

extern "C" {

PCL_GPF_EXPORT ssize_t write(int file, const void* bytes, std::size_t size) {
  static auto* const next = original<ssize_t(int, const void*, std::size_t)>("write");
  if (failsNow("write")) return -1;
  return next(file, bytes, writes_are_short && size > 7 ? 7 : size);
}

PCL_GPF_EXPORT int fsync(int file) {
  static auto* const next = original<int(int)>("fsync");
  return failsNow("fsync") ? -1 : next(file);
}

PCL_GPF_EXPORT int close(int file) {
  static auto* const next = original<int(int)>("close");
  const bool fails = failsNow("close");
  const int result = next(file);
  if (fails) errno = EIO;
  return fails ? -1 : result;
}

PCL_GPF_EXPORT int rename(const char* from, const char* to) {
  static auto* const next = original<int(const char*, const char*)>("rename");
  return failsNow("rename") ? -1 : next(from, to);
}

PCL_GPF_EXPORT int fchmod(int file, mode_t mode) {
  static auto* const next = original<int(int, mode_t)>("fchmod");
  return failsNow("fchmod") ? -1 : next(file, mode);
}
}

void* operator new(std::size_t size) {
  return allocate(size);
}
void* operator new[](std::size_t size) {
  return allocate(size);
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete[](void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
  std::free(memory);
}

namespace pcl_gpf::test {
namespace {

/** How one run with a fault ended. */
struct Outcome {
  bool happened = false; ///< the fault struck
  bool is_good = false;  ///< no exception
  bool is_io_error = false;
  bool is_bad_alloc = false;
};

/** Runs \a action with call number k of \a function failing, for k = 0, 1, ... until none fails any more; \a prepare
 * before and \a check after each run are free of faults. Returns the number of calls that failed. */
template <typename Prepare, typename Action, typename Check>
int failEachCall(const char* function, Prepare prepare, Action action, Check check) {
  for (int k = 0;; ++k) {
    prepare();
    Outcome outcome;
    fault = {function, k, false};
    try {
      action();
      outcome.is_good = true;
    } catch (const IoError&) {
      outcome.is_io_error = true;
    } catch (const std::bad_alloc&) {
      outcome.is_bad_alloc = true;
    }
    outcome.happened = fault.happened;
    fault = {};
    check(outcome);
    if (!outcome.happened) return k;
  }
}

TEST(FaultInjection, EveryFailingSystemCallIsAnErrorAndTheOldFileStays) {
  const TemporaryFolder folder;
  CloudFile cloud;
  cloud.width = 300000;
  for (const char* name : {"x", "y", "z"})
    cloud.addField(name, FieldType::Float32);
  const std::string path = folder / "a.pcd";
  WriteOptions options;
  options.overwrite = true;
  for (const std::string function : {"write", "fsync", "close", "rename", "fchmod"}) {
    SCOPED_TRACE(function);
    const int failures = failEachCall(
        function.c_str(), [&] { writeBytes(path, "old"); }, [&] { writeCloud(cloud, path, options); },
        [&](const Outcome& outcome) {
          EXPECT_EQ(folder.entries(), 1) << "a temporary file is left";
          const std::string bytes = bytesOf(path);
          const bool is_new = bytes.size() > cloud.data.size();
          EXPECT_TRUE(bytes == "old" || is_new) << bytes.size() << " bytes";
          EXPECT_TRUE(outcome.is_good || outcome.is_io_error);
          // After the rename only the folder is synced and closed: the new file is complete then.
          EXPECT_TRUE(is_new || !outcome.is_good);
          const bool must_refuse = outcome.happened && function != "close";
          EXPECT_TRUE(outcome.is_io_error || !must_refuse);
          EXPECT_TRUE(bytes == "old" || !must_refuse || function == "fsync");
        });
    EXPECT_GE(failures, 1) << "the call was never made";
  }
}

TEST(FaultInjection, ShortWritesAreContinued) {
  const TemporaryFolder folder;
  const CloudFile cloud = mixedCloud(3, 2, 1);
  writes_are_short = true;
  writeCloud(cloud, folder / "a.pcd");
  writes_are_short = false;
  EXPECT_TRUE(readCloud(folder / "a.pcd").data == cloud.data);
}

TEST(FaultInjection, EveryFailingAllocationIsBadAllocAndNothingIsLeft) {
  const TemporaryFolder folder;
  CloudFile cloud = mixedCloud(5, 2, 2);
  limitWideIntegers(cloud);
  for (const CloudFormat format : kAllFormats) {
    SCOPED_TRACE(nameOf(format));
    WriteOptions options;
    options.format = format;
    const std::string path = folder / ("a" + extensionFor(format));
    const int write_failures = failEachCall(
        "new", [&] { std::filesystem::remove(path); }, [&] { writeCloud(cloud, path, options); },
        [&](const Outcome& outcome) {
          EXPECT_EQ(outcome.is_bad_alloc, outcome.happened);
          EXPECT_EQ(folder.entries(), outcome.is_good ? 1 : 0);
        });
    EXPECT_GT(write_failures, 5);
    CloudFile result;
    const int read_failures = failEachCall(
        "new", [&] { result = {}; }, [&] { result = readCloud(path); },
        [&](const Outcome& outcome) {
          // Giving spare memory back may fail without harm.
          EXPECT_NE(outcome.is_bad_alloc, outcome.is_good);
          EXPECT_TRUE(outcome.is_good || outcome.happened);
          EXPECT_EQ(result.size(), outcome.is_good ? cloud.size() : 0U);
        });
    EXPECT_GT(read_failures, 5);
    std::filesystem::remove(path);
  }
}

} // namespace
} // namespace pcl_gpf::test
