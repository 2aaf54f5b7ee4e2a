// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <charconv>
#include <cmath>

#include "io/element_bytes.h"
#include "io/format_limits.h"
#include "io/mesh_readers.h"

namespace pcl_gpf {

namespace {

/** Statements of the OBJ format that say nothing about vertices and faces. */
constexpr std::string_view kSkipped[] = {
    "vt",     "vn",         "vp",        "g",      "o",     "s",    "mg",   "l",     "p",        "usemtl",
    "mtllib", "maplib",     "usemap",    "cstype", "deg",   "bmat", "step", "curv",  "curv2",    "surf",
    "parm",   "trim",       "hole",      "scrv",   "sp",    "end",  "con",  "bevel", "c_interp", "d_interp",
    "lod",    "shadow_obj", "trace_obj", "ctech",  "stech", "call", "csh"};

/** One OBJ file: `v x y z` and `f a/b/c ...` lines in any order. */
class ObjReader {
public:
  explicit ObjReader(const Source& source)
      : source_(source)
      , lines_(source, byteOrderMark(source, nullptr)) {}

  TriangleMesh read() {
    std::string_view line;
    while (lines_.nextFilled(line))
      takeLine(line);
    if (mesh_.triangles.empty()) source_.fail("at least one face", "none");
    if (largest_index_ >= mesh_.vertexCount())
      source_.failAtLine(largest_index_line_, "a vertex number up to " + std::to_string(mesh_.vertexCount()),
                         std::to_string(largest_index_ + 1));
    return std::move(mesh_);
  }

private:
  void takeLine(std::string_view line) {
    std::string_view word;
    takeToken(line, word);
    if (word[0] == '#') return;
    line = line.substr(0, line.find('#'));
    const std::string text = trimmed(line);
    if (!text.empty() && text.back() == '\\') lines_.fail("a statement on one line", "a line continued by a backslash");
    if (word == "v")
      takeVertex(line);
    else if (word == "f")
      takeFace(line);
    else if (std::find(std::begin(kSkipped), std::end(kSkipped), word) == std::end(kSkipped))
      lines_.fail("a statement of the OBJ format", quoted(word));
  }

  void takeVertex(std::string_view line) {
    std::string_view token;
    std::size_t count = 0;
    for (; takeToken(line, token); ++count) {
      double value = 0;
      if (!parseReal(token, value) || !std::isfinite(value)) lines_.fail("a finite number", quoted(token));
      if (count < 3) mesh_.vertices.push_back(value);
    }
    // After x y z there may be a weight or a colour.
    if (count != 3 && count != 4 && count != 6 && count != 7) lines_.fail("three coordinates", std::to_string(count));
    if (mesh_.vertexCount() > kMaxCount) lines_.fail("at most 2^31 - 1 vertices", "more");
  }

  /** The vertex number of `a`, `a/b`, `a//c` or `a/b/c`, from 0. */
  std::uint32_t vertexIndex(std::string_view token) const {
    const std::string_view digits = token.substr(0, token.find('/'));
    std::int64_t index = 0;
    const char* end = digits.data() + digits.size();
    const auto result = std::from_chars(digits.data(), end, index);
    const bool is_number = result.ec == std::errc() && result.ptr == end && !digits.empty();
    const auto count = static_cast<std::int64_t>(mesh_.vertexCount());
    const std::int64_t from_zero = index > 0 ? index - 1 : count + index;
    const bool is_index = is_number && index != 0 && from_zero >= 0 && from_zero < static_cast<std::int64_t>(kMaxCount);
    if (!is_index) lines_.fail("a vertex number from 1, or a negative one back to the first vertex", quoted(token));
    return static_cast<std::uint32_t>(from_zero);
  }

  void takeFace(std::string_view line) {
    polygon_.clear();
    std::string_view token;
    while (takeToken(line, token)) {
      polygon_.push_back(vertexIndex(token));
      if (polygon_.back() < largest_index_) continue;
      largest_index_ = polygon_.back();
      largest_index_line_ = lines_.lineNumber();
    }
    if (polygon_.size() < 3) lines_.fail("a face of at least three corners", std::to_string(polygon_.size()));
    appendFan(polygon_, mesh_);
  }

  const Source& source_;
  LineReader lines_;
  std::vector<std::uint32_t> polygon_;
  std::size_t largest_index_ = 0;
  std::size_t largest_index_line_ = 0;
  TriangleMesh mesh_;
};

} // namespace

TriangleMesh readMeshObj(const Source& source) {
  return ObjReader(source).read();
}

} // namespace pcl_gpf
