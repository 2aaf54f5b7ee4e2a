// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

#include "pcl_gpf/common/export.h"

namespace pcl_gpf {

/** \brief Tells before any computation whether \a path can be written: the folder exists and is writable, the target is
 * absent, or is a regular file that may be replaced.
 * \param path a file, or "-" (standard output, always accepted)
 * \throws IoError (kind Unwritable)
 */
PCL_GPF_EXPORT void checkWritable(const std::string& path, bool overwrite);

/** \brief A file that appears under its name only when it is complete and on the disk.
 *
 * Bytes go to a temporary file (`.pcl_gpf-<random>.tmp`) in the target's folder; commit() syncs it, renames it over the
 * target and syncs the folder. Without commit(), or on any error, the destructor removes it and the target is
 * untouched.
 * - A new file's mode follows umask; a replaced file's mode is kept (its owner where the system allows).
 * - A target that is a symbolic link stays a link: the file that it points to is replaced. A dangling link is refused.
 * - With overwrite false the rename refuses a file that appeared in between (where the system supports that).
 * After SIGKILL or a power cut at most one temporary file is left, never a partial target.
 * Thread safety: different objects may be used in different threads.
 */
class PCL_GPF_EXPORT AtomicFile {
public:
  /** \throws IoError (kind Unwritable), as all members here */
  AtomicFile(const std::string& path, bool overwrite);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(const void* bytes, std::size_t size);
  /** \brief Makes the file appear. Call once; write() is over then. */
  void commit();

private:
  void openTemporary();
  void discard() noexcept;
  [[noreturn]] void fail(const std::string& step, int error) const;

  std::string path_;   // as the caller named it, for messages
  std::string target_; // links resolved, absolute
  std::string folder_;
  std::string temporary_;
  bool overwrite_;
  int file_ = -1;
  int cleanup_slot_ = -1;
};

/** \brief For a program's main(): on SIGINT, SIGTERM and SIGHUP the temporary files of all open AtomicFile objects are
 * removed, then the signal takes its default course (exit by signal). A signal that was ignored stays ignored.
 * SIGXFSZ is ignored, so that a file size limit is an IoError. At most 64 files are open at a time.
 */
PCL_GPF_EXPORT void installSignalCleanup();

} // namespace pcl_gpf
