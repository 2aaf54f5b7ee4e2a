// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>

#include "pcl_gpf/common/export.h"

namespace pcl_gpf {

/** \brief Which side of the input/output layer failed (a tool maps this to its exit code). */
enum class IoErrorKind { Unreadable, Unwritable };

/** \brief The one exception of the input/output layer (besides std::bad_alloc).
 *
 * what() reads "FILE: PLACE: expected PROMISED, found FOUND"; PLACE is a line ("line 12", counted from 1) or a byte
 * ("byte 300", counted from 0) of the file, and may be missing. Control characters are written as \\xNN.
 */
class PCL_GPF_EXPORT IoError : public std::runtime_error {
public:
  /** \param kind     reading or writing
   *  \param path     the file as the caller named it
   *  \param place    "line 12", "byte 300" or empty
   *  \param promised what was expected there, without the word "expected"
   *  \param found    what was found instead, or the system's reason
   */
  IoError(IoErrorKind kind, const std::string& path, const std::string& place, const std::string& promised,
          const std::string& found);

  IoErrorKind kind() const noexcept { return kind_; }
  const std::string& path() const noexcept { return path_; }
  const std::string& place() const noexcept { return place_; }

private:
  IoErrorKind kind_;
  std::string path_;
  std::string place_;
};

/** \brief Text fit for a message: control characters as \\xNN, at most \a limit bytes, then "...". */
PCL_GPF_EXPORT std::string printable(const std::string& text, std::size_t limit = 60);

} // namespace pcl_gpf
