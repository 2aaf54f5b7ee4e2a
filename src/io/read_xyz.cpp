// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <optional>
#include <set>

#include "io/element_bytes.h"
#include "io/format_limits.h"
#include "io/format_readers.h"
#include "io/viewpoint_text.h"

namespace pcl_gpf {

namespace {

constexpr std::size_t kMaxCommentBytes = std::size_t{1} << 16;

/** XYZ text in the making: rows of doubles, as many in each as in the first. */
class XyzReader {
public:
  explicit XyzReader(const Source& source)
      : source_(source)
      , lines_(source, byteOrderMark(source, &cloud_.warnings)) {
    cloud_.format = CloudFormat::Xyz;
  }

  CloudFile read() {
    std::string_view line;
    while (lines_.nextFilled(line)) {
      std::string_view rest = line;
      std::string_view first;
      takeToken(rest, first);
      if (first[0] == '#' || first.substr(0, 2) == "//")
        takeCommentLine(line);
      else if (columns_ == 0 && !promised_points_ && isLoneInteger(line))
        takePointCount(first);
      else
        takeRow(line);
    }
    if (columns_ == 0) source_.fail("rows of at least three numbers", "no row");
    if (promised_points_ && *promised_points_ != points_)
      source_.fail(std::to_string(*promised_points_) + " points, as the first line says", std::to_string(points_));
    cloud_.width = static_cast<std::uint32_t>(points_);
    cloud_.data.shrink_to_fit();
    lines_.reportLineEnds(cloud_.warnings);
    return std::move(cloud_);
  }

private:
  void takeCommentLine(std::string_view line) {
    const std::string text = trimmed(line);
    const std::size_t begin = text.find_first_not_of("#/ \t");
    if (columns_ > 0 || begin == std::string::npos) return;
    const std::vector<std::string_view> tokens = splitTokens(std::string_view(text).substr(begin));
    if (tokens[0] == "columns:") {
      names_.assign(tokens.begin() + 1, tokens.end());
      return;
    }
    comment_bytes_ += text.size();
    if (comment_bytes_ <= kMaxCommentBytes) takeComment(std::string_view(text).substr(begin), cloud_);
  }

  static bool isLoneInteger(std::string_view line) {
    return trimmed(line).find_first_not_of("0123456789") == std::string::npos;
  }

  void takePointCount(std::string_view token) { promised_points_ = parseCount(lines_, token, "the number of points"); }

  void takeRow(std::string_view line) {
    if (columns_ == 0) beginRows(line);
    std::string_view token;
    std::size_t count = 0;
    unsigned char value[sizeof(double)];
    for (; takeToken(line, token); ++count) {
      if (count == columns_) break;
      if (!parseElement(FieldType::Float64, token, value)) refuseToken(token);
      cloud_.data.insert(cloud_.data.end(), value, value + sizeof value);
    }
    if (count != columns_ || !token.empty())
      lines_.fail(std::to_string(columns_) + " columns, as in the first row",
                  token.empty() ? std::to_string(count) : "more");
    if (++points_ > kMaxCount) lines_.fail("at most 2^31 - 1 points", "more");
  }

  [[noreturn]] void refuseToken(std::string_view token) const {
    if (token.find(',') != std::string_view::npos)
      lines_.fail("numbers with a decimal point, separated by blanks (commas are refused: they can mean either)",
                  quoted(token));
    lines_.fail("a number", quoted(token));
  }

  void beginRows(std::string_view line) {
    columns_ = splitTokens(line).size();
    std::string_view first;
    std::string_view rest = line;
    takeToken(rest, first);
    unsigned char value[sizeof(double)];
    if (!parseElement(FieldType::Float64, first, value)) refuseToken(first);
    if (columns_ < 3) lines_.fail("at least three columns", std::to_string(columns_));
    if (columns_ > kMaxFields) lines_.fail("at most 1000 columns", std::to_string(columns_));
    nameColumns();
    // No more rows than the text can hold, so no more memory than a small multiple of it.
    const std::size_t bytes = lines_.bytesLeft() + line.size() + 1;
    const auto* end = source_.data + source_.size;
    const auto ends = static_cast<std::size_t>(std::count(end - lines_.bytesLeft(), end, '\n')) + 2;
    cloud_.data.reserve(std::min(ends, bytes / (2 * columns_) + 1) * columns_ * sizeof(double));
  }

  void nameColumns() {
    const std::set<std::string> distinct(names_.begin(), names_.end());
    const bool usable = names_.size() == columns_ && distinct.size() == columns_ && distinct.count("x") == 1 &&
                        distinct.count("y") == 1 && distinct.count("z") == 1;
    if (!usable) {
      names_ = {"x", "y", "z"};
      if (columns_ == 6) names_.insert(names_.end(), {"normal_x", "normal_y", "normal_z"});
      while (names_.size() < columns_)
        names_.push_back("c" + std::to_string(names_.size() + 1));
    }
    for (std::size_t c = 0; c < columns_; ++c)
      cloud_.fields.push_back({names_[c], FieldType::Float64, 1, c * sizeof(double)});
  }

  const Source& source_;
  CloudFile cloud_;
  LineReader lines_;
  std::vector<std::string> names_;
  std::optional<std::uint64_t> promised_points_;
  std::size_t columns_ = 0;
  std::size_t points_ = 0;
  std::size_t comment_bytes_ = 0;
};

} // namespace

CloudFile readXyz(const Source& source) {
  return XyzReader(source).read();
}

} // namespace pcl_gpf
