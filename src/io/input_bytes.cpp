// SPDX-License-Identifier: BSD-3-Clause
#include "io/input_bytes.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <new>

#include "pcl_gpf/io/errors.h"

namespace pcl_gpf {

namespace {

constexpr std::size_t kFirstChunk = std::size_t{1} << 20;
constexpr std::size_t kLargestRead = std::size_t{1} << 30;

[[noreturn]] void refuse(const std::string& path, const std::string& promised, const std::string& found) {
  throw IoError(IoErrorKind::Unreadable, path, "", promised, found);
}

/** An open input; standard input stays open. */
class InputFile {
public:
  explicit InputFile(const std::string& path)
      : path_(path) {
    if (path == "-") {
      path_ = "standard input";
      return;
    }
    file_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (file_ < 0) refuse(path_, "a readable file", std::strerror(errno));
    struct stat status {};
    is_owned_ = true;
    const bool is_regular = ::fstat(file_, &status) == 0 && S_ISREG(status.st_mode);
    if (!is_regular) {
      ::close(file_);
      refuse(path_, "a regular file (or - for standard input)",
             S_ISDIR(status.st_mode) ? "a folder" : "a device, pipe or socket");
    }
    promised_ = static_cast<std::size_t>(status.st_size);
  }
  ~InputFile() {
    if (is_owned_) ::close(file_);
  }
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  /** Reads at least one byte unless the end is reached: then 0. */
  std::size_t read(unsigned char* to, std::size_t size) const {
    for (;;) {
      const ssize_t count = ::read(file_, to, std::min(size, kLargestRead));
      if (count >= 0) return static_cast<std::size_t>(count);
      if (errno == EAGAIN || errno == EWOULDBLOCK)
        waitForInput();
      else if (errno != EINTR)
        refuse(path_, "to read it", std::strerror(errno));
    }
  }

  std::size_t promisedBytes() const noexcept { return promised_; }
  const std::string& path() const noexcept { return path_; }

private:
  void waitForInput() const {
    pollfd wanted{file_, POLLIN, 0};
    ::poll(&wanted, 1, -1);
  }

  std::string path_;
  int file_ = STDIN_FILENO;
  bool is_owned_ = false;
  std::size_t promised_ = 0;
};

void grow(InputBytes& bytes, std::size_t capacity) {
  void* moved = std::realloc(bytes.data.get(), capacity);
  if (!moved) throw std::bad_alloc();
  (void)bytes.data.release(); // realloc has freed it
  bytes.data.reset(static_cast<unsigned char*>(moved));
}

} // namespace

InputBytes readInput(const std::string& path,
                     const std::function<void(const unsigned char*, std::size_t)>& check_start) {
  const InputFile file(path);
  InputBytes bytes;
  std::size_t capacity = kFirstChunk;
  grow(bytes, capacity);
  for (;;) {
    if (bytes.size == capacity) {
      if (capacity == kFirstChunk) check_start(bytes.data.get(), bytes.size);
      // One byte more than promised, so that the end shows in the same read.
      capacity = std::max(file.promisedBytes() + 1, capacity + capacity / 2);
      grow(bytes, capacity);
    }
    const std::size_t count = file.read(bytes.data.get() + bytes.size, capacity - bytes.size);
    if (count == 0) break;
    bytes.size += count;
  }
  if (bytes.size < file.promisedBytes())
    refuse(file.path(), std::to_string(file.promisedBytes()) + " bytes, as when it was opened",
           std::to_string(bytes.size) + ": it was shortened while it was read");
  return bytes;
}

std::string extensionOf(const std::string& path) {
  const std::size_t dot = path.find_last_of("./");
  if (dot == std::string::npos || path[dot] == '/') return {};
  std::string extension = path.substr(dot);
  for (char& c : extension)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return extension;
}

} // namespace pcl_gpf
