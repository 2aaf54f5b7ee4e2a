// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "io/element_bytes.h"
#include "io/format_readers.h"
#include "io/mesh_readers.h"

namespace pcl_gpf {

namespace {

/** One OFF file: the word OFF, three counts, vertices, faces; # starts a comment anywhere. */
class OffReader {
public:
  explicit OffReader(const Source& source)
      : source_(source)
      , lines_(source, byteOrderMark(source, nullptr)) {}

  TriangleMesh read() {
    readCounts();
    mesh_.vertices.reserve(3 * static_cast<std::size_t>(vertices_));
    for (std::uint64_t i = 0; i < vertices_; ++i)
      readVertex();
    for (std::uint64_t i = 0; i < faces_; ++i)
      readFace();
    if (mesh_.triangles.empty()) source_.fail("at least one face", "none");
    return std::move(mesh_);
  }

private:
  void nextRow(const char* what) {
    do {
      if (!lines_.nextFilled(row_)) lines_.fail(what, "the end of the file");
      row_ = row_.substr(0, row_.find('#'));
    } while (trimmed(row_).empty());
  }

  std::string_view nextToken(const char* what) {
    std::string_view token;
    if (!takeToken(row_, token)) lines_.fail(what, "the end of the line");
    return token;
  }

  void readCounts() {
    nextRow("the word OFF");
    const std::string word(nextToken("the word OFF"));
    const std::string prefix = word.substr(0, word.size() - 3);
    if (prefix != "" && prefix != "C" && prefix != "N" && prefix != "CN" && prefix != "ST" && prefix != "STCN")
      lines_.fail("OFF, COFF, NOFF, CNOFF, STOFF or STCNOFF", quoted(word));
    if (trimmed(row_).empty()) nextRow("the counts of vertices, faces and edges");
    vertices_ = parseCount(lines_, nextToken("the number of vertices"), "the number of vertices");
    faces_ = parseCount(lines_, nextToken("the number of faces"), "the number of faces");
    // The number of edges is often wrong and never used.
    std::string_view edges;
    if (takeToken(row_, edges)) parseCount(lines_, edges, "the number of edges");
    if (!trimmed(row_).empty()) lines_.fail("three counts", "more");
    constexpr std::uint64_t kShortestVertex = 5; // "0 0 0"
    constexpr std::uint64_t kShortestFace = 7;   // "3 0 1 2"
    requireBytes(source_, lines_.position(), vertices_, kShortestVertex, lines_.bytesLeft());
    requireBytes(source_, lines_.position(), faces_, kShortestFace,
                 lines_.bytesLeft() - static_cast<std::size_t>(vertices_ * kShortestVertex));
  }

  /** Normals, colours and texture coordinates follow; they must be numbers. */
  void checkRestOfRow() {
    std::string_view token;
    double ignored = 0;
    while (takeToken(row_, token))
      if (!parseReal(token, ignored)) lines_.fail("a number", quoted(token));
  }

  void readVertex() {
    nextRow("another vertex");
    for (int axis = 0; axis < 3; ++axis) {
      double value = 0;
      const std::string_view token = nextToken("three coordinates");
      if (!parseReal(token, value) || !std::isfinite(value)) lines_.fail("a finite number", quoted(token));
      mesh_.vertices.push_back(value);
    }
    checkRestOfRow();
  }

  void readFace() {
    nextRow("another face");
    const std::uint64_t corners = parseCount(lines_, nextToken("the number of corners"), "the number of corners");
    if (corners < 3) lines_.fail("a face of at least three corners", std::to_string(corners));
    polygon_.clear();
    for (std::uint64_t k = 0; k < corners; ++k) {
      const std::string_view token = nextToken("as many vertex numbers as the row promises");
      const std::uint64_t index = parseCount(lines_, token, "a vertex number");
      if (index >= vertices_) lines_.fail("a vertex number below " + std::to_string(vertices_), quoted(token));
      polygon_.push_back(static_cast<std::uint32_t>(index));
    }
    checkRestOfRow();
    appendFan(polygon_, mesh_);
  }

  const Source& source_;
  LineReader lines_;
  std::string_view row_;
  std::uint64_t vertices_ = 0;
  std::uint64_t faces_ = 0;
  std::vector<std::uint32_t> polygon_;
  TriangleMesh mesh_;
};

} // namespace

TriangleMesh readMeshOff(const Source& source) {
  return OffReader(source).read();
}

} // namespace pcl_gpf
