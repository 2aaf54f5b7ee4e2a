// SPDX-License-Identifier: BSD-3-Clause
#include "io/output_bytes.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "pcl_gpf/io/errors.h"

namespace pcl_gpf {

namespace {

void writeAll(int file, const char* bytes, std::size_t size) {
  while (size > 0) {
    const ssize_t count = ::write(file, bytes, size);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0)
      throw IoError(IoErrorKind::Unwritable, "standard output", "", "to write it", std::strerror(errno));
    bytes += count;
    size -= static_cast<std::size_t>(count);
  }
}

} // namespace

ByteSink standardOutputSink() {
  return [](const void* bytes, std::size_t size) { writeAll(STDOUT_FILENO, static_cast<const char*>(bytes), size); };
}

} // namespace pcl_gpf
