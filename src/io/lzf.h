// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace pcl_gpf {

/** \brief The most bytes that \a compressed bytes of LZF can hold: three bytes make at most 264. */
constexpr std::size_t lzfCapacity(std::size_t compressed) {
  return 88 * compressed + 32;
}

/** \brief Packs bytes in the LZF format of liblzf, which PCD binary_compressed uses. O(size).
 * Never fails; bytes that cannot shrink grow by 1/32.
 */
std::vector<unsigned char> lzfCompress(const unsigned char* input, std::size_t size);

/** \brief Unpacks exactly \a output_size bytes from exactly \a size bytes.
 * \return false when the stream is broken or does not give that size; nothing is read or written outside
 */
bool lzfDecompress(const unsigned char* input, std::size_t size, unsigned char* output, std::size_t output_size);

} // namespace pcl_gpf
