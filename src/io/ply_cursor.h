// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "io/ply_header.h"

namespace pcl_gpf {

/** \brief Walks over the values of a PLY body, text or binary, in file order. A copy walks on its own. */
class PlyCursor {
public:
  /** \param lines stands at the first byte of the body */
  PlyCursor(const LineReader& lines, CloudFormat format);

  void beginRow();
  /** \brief Reads one value in this machine's byte order to \a to (sizeOf(type) bytes). */
  void readValue(const PlyProperty& property, unsigned char* to);
  /** \brief Reads the length of a list; that many entries can be there. */
  std::uint64_t readLength(const PlyProperty& property);
  void endRow();

  /** \brief Passes over one value or whole list, checking it. */
  void skip(const PlyProperty& property);
  /** \brief Passes over all rows of an element. */
  void skip(const PlyElement& element);
  /** \brief Binary only: passes over \a bytes bytes and returns where they begin. */
  const unsigned char* takeBytes(std::uint64_t bytes);

  bool isText() const noexcept { return is_text_; }
  bool swapsBytes() const noexcept { return swap_; }
  /** \brief The file, and the place reached, for errors. */
  [[noreturn]] void fail(const std::string& promised, const std::string& found) const;
  void reportTrailing(CloudFile& cloud);
  const LineReader& lines() const noexcept { return lines_; }

private:
  LineReader lines_;
  std::string_view row_; // text: what is left of the line
  std::size_t byte_;     // binary: the next byte
  bool is_text_;
  bool swap_;
};

} // namespace pcl_gpf
