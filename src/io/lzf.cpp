// SPDX-License-Identifier: BSD-3-Clause
#include "io/lzf.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace pcl_gpf {

// The format: a control byte c < 32 is followed by c + 1 literal bytes. Otherwise it starts a back reference: its high
// three bits are the length minus 2 (7: one more byte is added), its low five bits and the last byte the distance
// minus 1. So a reference copies 3 to 264 bytes from at most 8192 bytes back.
namespace {

constexpr std::size_t kMaxLiterals = 32;
constexpr std::size_t kMinLength = 3;
constexpr std::size_t kMaxLength = 264;
constexpr std::size_t kMaxDistance = 8192;
constexpr unsigned kHashBits = 15;

std::uint32_t hashOfThree(const unsigned char* bytes) {
  const std::uint32_t three = static_cast<std::uint32_t>(bytes[0] << 16 | bytes[1] << 8 | bytes[2]);
  return (three * 2654435761U) >> (32 - kHashBits);
}

void appendLiterals(const unsigned char* from, const unsigned char* end, std::vector<unsigned char>& output) {
  while (from < end) {
    const std::size_t count = std::min(kMaxLiterals, static_cast<std::size_t>(end - from));
    output.push_back(static_cast<unsigned char>(count - 1));
    output.insert(output.end(), from, from + count);
    from += count;
  }
}

void appendReference(std::size_t length, std::size_t distance, std::vector<unsigned char>& output) {
  const std::size_t code = length - 2;
  const std::size_t high = (distance - 1) >> 8;
  output.push_back(static_cast<unsigned char>(std::min<std::size_t>(code, 7) << 5 | high));
  if (code >= 7) output.push_back(static_cast<unsigned char>(code - 7));
  output.push_back(static_cast<unsigned char>((distance - 1) & 0xff));
}

} // namespace

std::vector<unsigned char> lzfCompress(const unsigned char* input, std::size_t size) {
  std::vector<unsigned char> output;
  output.reserve(size / 2 + 64);
  constexpr std::size_t kNowhere = static_cast<std::size_t>(-1);
  std::vector<std::size_t> last_seen(std::size_t{1} << kHashBits, kNowhere);
  std::size_t literals_begin = 0;
  std::size_t i = 0;
  while (i + kMinLength <= size) {
    std::size_t& seen = last_seen[hashOfThree(input + i)];
    const std::size_t candidate = seen;
    seen = i;
    if (candidate == kNowhere || i - candidate > kMaxDistance ||
        std::memcmp(input + candidate, input + i, kMinLength) != 0) {
      ++i;
      continue;
    }
    const std::size_t limit = std::min(kMaxLength, size - i);
    std::size_t length = kMinLength;
    while (length < limit && input[candidate + length] == input[i + length])
      ++length;
    appendLiterals(input + literals_begin, input + i, output);
    appendReference(length, i - candidate, output);
    i += length;
    literals_begin = i;
  }
  appendLiterals(input + literals_begin, input + size, output);
  return output;
}

bool lzfDecompress(const unsigned char* input, std::size_t size, unsigned char* output, std::size_t output_size) {
  std::size_t in = 0;
  std::size_t out = 0;
  while (in < size) {
    const std::size_t control = input[in++];
    if (control < kMaxLiterals) {
      const std::size_t count = control + 1;
      if (count > size - in || count > output_size - out) return false;
      std::memcpy(output + out, input + in, count);
      in += count;
      out += count;
      continue;
    }
    std::size_t length = (control >> 5) + 2;
    if (length == 9) {
      if (in == size) return false;
      length += input[in++];
    }
    if (in == size) return false;
    const std::size_t distance = ((control & 31) << 8 | input[in++]) + 1;
    if (distance > out || length > output_size - out) return false;
    if (distance >= length) {
      std::memcpy(output + out, output + out - distance, length);
    } else {
      // An overlapping copy repeats its own output, byte after byte.
      for (std::size_t k = 0; k < length; ++k)
        output[out + k] = output[out + k - distance];
    }
    out += length;
  }
  return out == output_size;
}

} // namespace pcl_gpf
