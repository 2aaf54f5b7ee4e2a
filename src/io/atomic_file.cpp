// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_gpf/io/atomic_file.h"

#include <fcntl.h>
#include <stdio.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <random>

#include "io/signal_cleanup.h"
#include "pcl_gpf/io/errors.h"

namespace pcl_gpf {

namespace {

[[noreturn]] void refuse(const std::string& path, const std::string& promised, const std::string& found) {
  throw IoError(IoErrorKind::Unwritable, path, "", promised, found);
}

std::string resolved(const std::string& path, const std::string& named) {
  const std::unique_ptr<char, decltype(&std::free)> result(::realpath(path.c_str(), nullptr), &std::free);
  if (!result) refuse(named, "a folder that exists to write into", std::strerror(errno));
  return result.get();
}

/** The target with its folder and itself resolved, so that neither links nor a change of folder matter later. */
struct Target {
  std::string path;
  std::string folder;
  bool exists = false;
  struct stat status {};
};

Target findTarget(const std::string& path) {
  if (path.empty() || path.back() == '/') refuse(path, "the name of a file to write", "none");
  Target target;
  struct stat link {};
  target.exists = ::stat(path.c_str(), &target.status) == 0;
  const int error = errno;
  if (!target.exists && ::lstat(path.c_str(), &link) == 0)
    refuse(path, "a file to write", std::string("a symbolic link that leads nowhere (") + std::strerror(error) + ")");
  if (!target.exists && error != ENOENT) refuse(path, "a file to write", std::strerror(error));
  if (target.exists) {
    target.path = resolved(path, path);
    target.folder = target.path.substr(0, std::max<std::size_t>(1, target.path.rfind('/')));
    return target;
  }
  const std::size_t slash = path.rfind('/');
  const std::string folder = slash == std::string::npos ? "." : path.substr(0, std::max<std::size_t>(1, slash));
  target.folder = resolved(folder, path);
  target.path = target.folder + '/' + path.substr(slash == std::string::npos ? 0 : slash + 1);
  return target;
}

void checkTarget(const Target& target, const std::string& path, bool overwrite) {
  if (target.exists && S_ISDIR(target.status.st_mode)) refuse(path, "a file to write", "a folder");
  if (target.exists && !S_ISREG(target.status.st_mode))
    refuse(path, "a regular file to write", "a device, pipe or socket");
  if (target.exists && !overwrite) refuse(path, "no file of that name (or the permission to overwrite it)", "one");
  if (target.exists && ::access(target.path.c_str(), W_OK) != 0)
    refuse(path, "the right to write the file", std::strerror(errno));
  if (::access(target.folder.c_str(), W_OK | X_OK) != 0)
    refuse(path, "the right to write into the folder " + printable(target.folder, 4096), std::strerror(errno));
}

std::string randomName() {
  static constexpr char kDigits[] = "0123456789abcdef";
  std::random_device device;
  std::string name = ".pcl_gpf-";
  for (int part = 0; part < 4; ++part)
    for (unsigned bits = device(), digit = 0; digit < 8; ++digit, bits >>= 4)
      name += kDigits[bits & 15];
  return name + ".tmp";
}

/** Descriptors 0 to 2 stay free for the standard streams even when the caller has closed them. */
int openAboveStandardStreams(const char* path, int flags, mode_t mode) {
  const int file = ::open(path, flags, mode);
  if (file < 0 || file > STDERR_FILENO) return file;
  const int moved = ::fcntl(file, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  const int error = errno;
  ::close(file);
  errno = error;
  return moved;
}

/** Renames; with \a overwrite false never over an existing file, where the system can promise that. */
int renameTo(const std::string& from, const std::string& to, bool overwrite) {
  if (overwrite) return ::rename(from.c_str(), to.c_str());
  if (::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return 0;
  if (errno != EINVAL && errno != ENOSYS) return -1;
  if (::access(to.c_str(), F_OK) == 0) {
    errno = EEXIST;
    return -1;
  }
  return ::rename(from.c_str(), to.c_str());
}

/** Makes the rename itself survive a power cut. A folder that cannot be opened or synced by its nature is left. */
int syncFolder(const std::string& folder) {
  const int file = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file < 0) return errno == EACCES ? 0 : -1;
  int result = ::fsync(file);
  if (result != 0 && (errno == EINVAL || errno == ENOTSUP)) result = 0;
  const int error = errno;
  ::close(file);
  errno = error;
  return result;
}

} // namespace

void checkWritable(const std::string& path, bool overwrite) {
  if (path != "-") checkTarget(findTarget(path), path, overwrite);
}

AtomicFile::AtomicFile(const std::string& path, bool overwrite)
    : path_(path)
    , overwrite_(overwrite) {
  const Target target = findTarget(path);
  checkTarget(target, path, overwrite);
  target_ = target.path;
  folder_ = target.folder;
  openTemporary();
  if (!target.exists) return;
  // Only root may give a file away; for others the owner is the same already, or becomes the writer.
  if (::fchown(file_, target.status.st_uid, target.status.st_gid) != 0) errno = 0;
  constexpr mode_t kPermissions = 0777;
  if (::fchmod(file_, target.status.st_mode & kPermissions) != 0) {
    const int error = errno;
    discard();
    fail("to keep the file's mode", error);
  }
}

void AtomicFile::openTemporary() {
  constexpr int kAttempts = 16;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    temporary_ = (folder_ == "/" ? "" : folder_) + '/' + randomName();
    // Noted first: a signal between the two calls must find it.
    cleanup_slot_ = rememberTemporary(temporary_);
    if (cleanup_slot_ < 0) fail("at most 64 files being written, and a path that the system can hold", 0);
    file_ = openAboveStandardStreams(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file_ >= 0) return;
    const int error = errno;
    if (error != EEXIST) ::unlink(temporary_.c_str());
    forgetTemporary(cleanup_slot_);
    cleanup_slot_ = -1;
    if (error != EEXIST) fail("a temporary file in the folder", error);
  }
  fail("a temporary file in the folder", EEXIST);
}

void AtomicFile::discard() noexcept {
  if (file_ >= 0) ::close(file_);
  if (cleanup_slot_ >= 0) ::unlink(temporary_.c_str());
  forgetTemporary(cleanup_slot_);
  file_ = -1;
  cleanup_slot_ = -1;
}

AtomicFile::~AtomicFile() {
  discard();
}

void AtomicFile::fail(const std::string& step, int error) const {
  refuse(path_, step, error == 0 ? "more" : std::strerror(error));
}

void AtomicFile::write(const void* bytes, std::size_t size) {
  constexpr std::size_t kLargestWrite = std::size_t{1} << 30;
  const char* from = static_cast<const char*>(bytes);
  while (size > 0) {
    const ssize_t count = ::write(file_, from, std::min(size, kLargestWrite));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail("to write it", errno);
    from += count;
    size -= static_cast<std::size_t>(count);
  }
}

void AtomicFile::commit() {
  if (::fsync(file_) != 0) fail("to bring it to the disk", errno);
  const int closed = ::close(file_);
  file_ = -1;
  if (closed != 0) fail("to close it", errno);
  if (renameTo(temporary_, target_, overwrite_) != 0) fail("to give it its name", errno);
  forgetTemporary(cleanup_slot_);
  cleanup_slot_ = -1;
  if (syncFolder(folder_) != 0) fail("to bring its folder to the disk", errno);
}

} // namespace pcl_gpf
