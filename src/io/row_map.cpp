// SPDX-License-Identifier: BSD-3-Clause
#include "io/row_map.h"

#include <cstring>

namespace pcl_gpf {

void RowMap::add(std::size_t from, std::size_t to, std::size_t bytes) {
  if (!pieces_.empty()) {
    Piece& last = pieces_.back();
    if (last.from + last.bytes == from && last.to + last.bytes == to) {
      last.bytes += bytes;
      return;
    }
  }
  pieces_.push_back({from, to, bytes});
}

void RowMap::apply(const unsigned char* from, std::size_t from_step, unsigned char* to, std::size_t to_step,
                   std::size_t rows) const {
  if (rows == 0) return;
  const bool same_layout = from_step == to_step && pieces_.size() == 1 && pieces_[0].bytes == from_step;
  if (same_layout) {
    std::memcpy(to, from, rows * from_step);
    return;
  }
  for (std::size_t row = 0; row < rows; ++row, from += from_step, to += to_step)
    for (const Piece& piece : pieces_)
      std::memcpy(to + piece.to, from + piece.from, piece.bytes);
}

} // namespace pcl_gpf
