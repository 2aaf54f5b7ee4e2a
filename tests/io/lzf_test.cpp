// SPDX-License-Identifier: BSD-3-Clause
// The LZF codec: what is packed unpacks to the same bytes, and broken streams never leave their buffers.
#include "io/lzf.h"

#include <gtest/gtest.h>

#include <random>
#include <string>

namespace pcl_gpf {
namespace {

std::vector<unsigned char> randomBytes(std::size_t size, unsigned alphabet, std::mt19937& generator) {
  std::vector<unsigned char> bytes(size);
  for (unsigned char& byte : bytes)
    byte = static_cast<unsigned char>(generator() % alphabet);
  return bytes;
}

void expectRoundTrip(const std::vector<unsigned char>& bytes) {
  const std::vector<unsigned char> packed = lzfCompress(bytes.data(), bytes.size());
  EXPECT_LE(bytes.size(), lzfCapacity(packed.size()));
  EXPECT_LE(packed.size(), bytes.size() + bytes.size() / 32 + 1);
  std::vector<unsigned char> unpacked(bytes.size());
  EXPECT_TRUE(lzfDecompress(packed.data(), packed.size(), unpacked.data(), unpacked.size()));
  EXPECT_TRUE(unpacked == bytes);
}

TEST(Lzf, PackedBytesUnpack) {
  std::mt19937 generator(1);
  for (const unsigned alphabet : {1U, 2U, 3U, 16U, 256U})
    for (std::size_t size : {0U,   1U,   2U,   3U,   4U,   31U,  32U,   33U,   34U,   64U,   65U,    263U,
                             264U, 265U, 266U, 267U, 528U, 529U, 8191U, 8192U, 8193U, 8200U, 100000U})
      expectRoundTrip(randomBytes(size, alphabet, generator));
}

TEST(Lzf, RepeatsAtTheLargestDistanceUnpack) {
  std::mt19937 generator(2);
  for (const std::size_t distance : {8190U, 8191U, 8192U, 8193U, 8194U}) {
    std::vector<unsigned char> bytes = randomBytes(distance, 256, generator);
    bytes.insert(bytes.end(), bytes.begin(), bytes.begin() + 300);
    expectRoundTrip(bytes);
  }
}

TEST(Lzf, KnownStreams) {
  const auto unpack = [](const std::string& packed, std::size_t size) {
    std::string result(size, '?');
    const bool good = lzfDecompress(reinterpret_cast<const unsigned char*>(packed.data()), packed.size(),
                                    reinterpret_cast<unsigned char*>(result.data()), size);
    return good ? result : std::string("broken");
  };
  EXPECT_EQ(unpack(std::string("\x02"
                               "abc",
                               4),
                   3),
            "abc");
  EXPECT_EQ(unpack(std::string("\x02"
                               "abc\x20\x02",
                               6),
                   6),
            "abcabc");
  EXPECT_EQ(unpack(std::string("\x00"
                               "a\x40\x00",
                               4),
                   5),
            "aaaaa")
      << "an overlapping reference";
  EXPECT_EQ(unpack(std::string("\x00"
                               "a\xe0\x00\x00",
                               5),
                   10),
            "aaaaaaaaaa")
      << "a long reference";
  EXPECT_EQ(unpack(std::string("\x02"
                               "abc",
                               4),
                   4),
            "broken")
      << "too little";
  EXPECT_EQ(unpack(std::string("\x02"
                               "abc",
                               4),
                   2),
            "broken")
      << "too much";
  EXPECT_EQ(unpack(std::string("\x02"
                               "ab",
                               3),
                   3),
            "broken")
      << "literals cut";
  EXPECT_EQ(unpack(std::string("\x00"
                               "a\x40",
                               3),
                   5),
            "broken")
      << "distance cut";
  EXPECT_EQ(unpack(std::string("\x00"
                               "a\xe0",
                               3),
                   10),
            "broken")
      << "long length cut";
  EXPECT_EQ(unpack(std::string("\x00"
                               "a\xe0\x00",
                               4),
                   10),
            "broken")
      << "long distance cut";
  EXPECT_EQ(unpack(std::string("\x00"
                               "a\x40\x01",
                               4),
                   5),
            "broken")
      << "before the start";
  EXPECT_EQ(unpack("", 0), "");
}

TEST(Lzf, BrokenStreamsAreRefusedOrGiveTheSize) {
  std::mt19937 generator(3);
  const std::vector<unsigned char> bytes = randomBytes(3000, 4, generator);
  const std::vector<unsigned char> packed = lzfCompress(bytes.data(), bytes.size());
  std::size_t refused = 0;
  for (int round = 0; round < 5000; ++round) {
    // Exact heap blocks, so that the address sanitizer sees a single byte outside.
    std::vector<unsigned char> broken(packed.begin(), packed.end() - static_cast<std::ptrdiff_t>(generator() % 3));
    broken[generator() % broken.size()] ^= static_cast<unsigned char>(1U << (generator() % 8));
    std::vector<unsigned char> unpacked(bytes.size());
    refused += !lzfDecompress(broken.data(), broken.size(), unpacked.data(), unpacked.size());
  }
  EXPECT_GT(refused, 1000U);
}

} // namespace
} // namespace pcl_gpf
