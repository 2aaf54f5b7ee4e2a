// SPDX-License-Identifier: BSD-3-Clause
// Drives the fuzz target without a fuzzing engine: small good files of every format are changed at random and read.
// Arguments: [seconds, default 5] [seed, default 1]. A crash prints the seed and the round before it.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "pcl_gpf/io/write_cloud.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

using namespace pcl_gpf;
using Bytes = std::vector<std::uint8_t>;

unsigned long seed = 1;
volatile unsigned long round_number = 0;

void reportCrash(int signal_number) {
  std::fprintf(stderr, "signal %d with seed %lu in round %lu\n", signal_number, seed, round_number);
  std::signal(signal_number, SIG_DFL);
  std::raise(signal_number);
}

Bytes bytesOf(const std::string& text) {
  return {text.begin(), text.end()};
}

/** A cloud of several types and element counts, in every format, through a temporary folder. */
std::vector<Bytes> writtenSeeds() {
  CloudFile cloud;
  cloud.width = 4;
  cloud.height = 3;
  cloud.addField("x", FieldType::Float32);
  cloud.addField("y", FieldType::Float64);
  cloud.addField("list", FieldType::Int16, 3);
  cloud.addField("z", FieldType::Int32);
  for (const char* channel : {"red", "green", "blue"})
    cloud.addField(channel, FieldType::UInt8);
  cloud.addField("time", FieldType::UInt64);
  for (std::size_t i = 0; i < cloud.size(); ++i)
    for (int field = 0; field < 8; ++field)
      cloud.setValue(i, field, static_cast<double>(i) * 1.25);
  cloud.viewpoint[0] = 2.5;
  cloud.comments = {"a comment"};
  const auto folder =
      std::filesystem::temp_directory_path() / ("pcl_gpf_fuzz_" + std::to_string(std::random_device()()));
  std::filesystem::create_directory(folder);
  std::vector<Bytes> seeds;
  for (const CloudFormat format :
       {CloudFormat::PcdAscii, CloudFormat::PcdBinary, CloudFormat::PcdCompressed, CloudFormat::PlyAscii,
        CloudFormat::PlyLittleEndian, CloudFormat::PlyBigEndian, CloudFormat::Xyz}) {
    WriteOptions options;
    options.format = format;
    options.overwrite = true;
    const std::string path = (folder / "seed").string();
    writeCloud(cloud, path, options);
    std::ifstream stream(path, std::ios::binary);
    seeds.emplace_back(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
  }
  std::filesystem::remove_all(folder);
  return seeds;
}

std::vector<Bytes> allSeeds() {
  std::vector<Bytes> seeds = writtenSeeds();
  const std::string header =
      "element vertex 3\nproperty list uchar short before\nproperty float x\nproperty float y\nproperty float z\n";
  const std::string faces = "element face 1\nproperty list uchar int vertex_indices\n";
  const std::string rows = "1 5 0 0 0\n2 5 6 1 0 0\n1 7 0 1 0\n";
  std::string camera = "element camera 1\n";
  for (const char* name : {"view_px", "view_py", "view_pz", "x_axisx", "x_axisy", "x_axisz", "y_axisx", "y_axisy",
                           "y_axisz", "z_axisx", "z_axisy", "z_axisz"})
    camera += std::string("property float ") + name + '\n';
  seeds.push_back(bytesOf("ply\nformat ascii 1.0\nobj_info num_cols 3\nobj_info num_rows 1\n" + header + camera +
                          faces + "end_header\n" + rows + "0 0 0 1 0 0 0 1 0 0 0 1\n3 0 1 2\n"));
  std::string binary = "ply\nformat binary_little_endian 1.0\n" + header + faces + "end_header\n";
  for (char length = 1; length <= 3; ++length)
    binary += length + std::string(2 * static_cast<std::size_t>(length) + 12, '\x01');
  seeds.push_back(bytesOf(binary + std::string("\x03\0\0\0\0\1\0\0\0\2\0\0\0", 13)));
  seeds.push_back(
      bytesOf("FIELDS x _ y z\nSIZE 4 1 4 4\nTYPE F U F F\nCOUNT 1 4 1 1\nWIDTH 2\nHEIGHT 1\nDATA binary\n" +
              std::string(32, '\x3f')));
  seeds.push_back(bytesOf("OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n4 0 1 2 3 255 0 0\n"));
  seeds.push_back(bytesOf("# a\no b\nv 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nf 1/1 2/1 3/1\nf -1 -2 -3\n"));
  seeds.push_back(bytesOf("2\n// a\n1 2 3 0 0 1\n4 5 6 0 1 0\n"));
  return seeds;
}

class Mutator {
public:
  explicit Mutator(unsigned long generator_seed)
      : generator_(generator_seed) {}

  Bytes mutated(const std::vector<Bytes>& seeds) {
    Bytes bytes = seeds[below(seeds.size())];
    for (std::size_t step = 0, steps = 1 + below(4); step < steps; ++step)
      mutateOnce(bytes, seeds);
    return bytes;
  }

private:
  std::size_t below(std::size_t limit) { return limit == 0 ? 0 : generator_() % limit; }
  std::ptrdiff_t place(const Bytes& bytes) { return static_cast<std::ptrdiff_t>(below(bytes.size() + 1)); }

  void mutateOnce(Bytes& bytes, const std::vector<Bytes>& seeds) {
    switch (below(8)) {
    case 0:
      if (!bytes.empty()) bytes[below(bytes.size())] ^= static_cast<std::uint8_t>(1U << below(8));
      break;
    case 1:
      if (!bytes.empty()) bytes[below(bytes.size())] = static_cast<std::uint8_t>(below(256));
      break;
    case 2:
      bytes.resize(below(bytes.size() + 1));
      break;
    case 3:
      duplicatePart(bytes);
      break;
    case 4:
      removePart(bytes);
      break;
    case 5:
      spliceIn(bytes, seeds[below(seeds.size())]);
      break;
    default:
      changeNumber(bytes);
      break;
    }
  }

  void duplicatePart(Bytes& bytes) {
    const std::size_t begin = below(bytes.size());
    const std::size_t length = below(std::min<std::size_t>(64, bytes.size() - begin) + 1);
    const Bytes part(bytes.begin() + static_cast<std::ptrdiff_t>(begin),
                     bytes.begin() + static_cast<std::ptrdiff_t>(begin + length));
    bytes.insert(bytes.begin() + place(bytes), part.begin(), part.end());
  }

  void removePart(Bytes& bytes) {
    const std::size_t begin = below(bytes.size());
    const std::size_t length = below(std::min<std::size_t>(32, bytes.size() - begin) + 1);
    bytes.erase(bytes.begin() + static_cast<std::ptrdiff_t>(begin),
                bytes.begin() + static_cast<std::ptrdiff_t>(begin + length));
  }

  void spliceIn(Bytes& bytes, const Bytes& other) {
    const std::ptrdiff_t cut = place(other);
    bytes.resize(below(bytes.size() + 1));
    bytes.insert(bytes.end(), other.begin() + cut, other.end());
  }

  /** Replaces a run of digits, in the header most of the time, by a number that breaks careless arithmetic. */
  void changeNumber(Bytes& bytes) {
    static constexpr const char* kNumbers[] = {"0",
                                               "1",
                                               "-1",
                                               "2",
                                               "3",
                                               "8",
                                               "10",
                                               "12",
                                               "255",
                                               "256",
                                               "65536",
                                               "1e9",
                                               "nan",
                                               "2147483647",
                                               "2147483648",
                                               "4294967295",
                                               "4294967296",
                                               "99999999999999999999",
                                               "18446744073709551615",
                                               "0x10",
                                               "1e999",
                                               "+1",
                                               ".",
                                               "-",
                                               ""};
    const std::size_t from = below(bytes.size());
    const auto is_digit = [](std::uint8_t c) { return c >= '0' && c <= '9'; };
    auto begin = std::find_if(bytes.begin() + static_cast<std::ptrdiff_t>(from), bytes.end(), is_digit);
    const auto end = std::find_if_not(begin, bytes.end(), is_digit);
    const std::string number = kNumbers[below(std::size(kNumbers))];
    begin = bytes.erase(begin, end);
    bytes.insert(begin, number.begin(), number.end());
  }

  std::mt19937_64 generator_;
};

} // namespace

int main(int argument_count, char** arguments) {
  const double seconds = argument_count > 1 ? std::atof(arguments[1]) : 5;
  seed = argument_count > 2 ? std::strtoul(arguments[2], nullptr, 10) : 1;
  for (const int signal_number : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE})
    std::signal(signal_number, reportCrash);
  const std::vector<Bytes> seeds = allSeeds();
  for (const Bytes& bytes : seeds)
    LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
  Mutator mutator(seed);
  const auto start = std::chrono::steady_clock::now();
  const auto elapsed = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); };
  while (elapsed() < seconds) {
    for (int i = 0; i < 100; ++i) {
      const Bytes bytes = mutator.mutated(seeds);
      LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
      round_number = round_number + 1;
    }
  }
  std::printf("%lu files with seed %lu, nothing but success or IoError\n", round_number, seed);
  return 0;
}
