// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string>

namespace pcl_gpf {

/** \brief The bytes of a whole file. */
struct InputBytes {
  struct Free {
    void operator()(unsigned char* bytes) const noexcept { std::free(bytes); }
  };
  std::unique_ptr<unsigned char[], Free> data;
  std::size_t size = 0;
};

/** \brief Reads a regular file, or standard input for "-", in chunks (no memory map: a file that another process
 * shortens would kill this one). Never blocks on a FIFO or a device. \param check_start is given the first chunk (at
 * least 1 MiB, or all) and throws to refuse the file early \throws IoError, std::bad_alloc
 */
InputBytes readInput(const std::string& path,
                     const std::function<void(const unsigned char* data, std::size_t size)>& check_start);

/** \brief Lower-case extension with its dot, or empty. */
std::string extensionOf(const std::string& path);

} // namespace pcl_gpf
