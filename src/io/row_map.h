// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace pcl_gpf {

/** \brief How the bytes of one row move when rows change their layout: fields dropped, moved, packed or unpacked. */
class RowMap {
public:
  /** \brief Adds a copy of \a bytes from offset \a from of the old row to offset \a to of the new one. */
  void add(std::size_t from, std::size_t to, std::size_t bytes);

  /** \brief Copies \a rows rows; bytes of the new rows that no piece covers stay as they are. */
  void apply(const unsigned char* from, std::size_t from_step, unsigned char* to, std::size_t to_step,
             std::size_t rows) const;

private:
  struct Piece {
    std::size_t from, to, bytes;
  };
  std::vector<Piece> pieces_;
};

} // namespace pcl_gpf
