// SPDX-License-Identifier: BSD-3-Clause
#include "io/pcd_header.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <set>

#include "io/format_limits.h"
#include "io/viewpoint_text.h"

namespace pcl_gpf {

namespace {

constexpr std::array<std::string_view, 11> kKeywords = {"VERSION", "FIELDS", "COLUMNS",   "SIZE",   "TYPE", "COUNT",
                                                        "WIDTH",   "HEIGHT", "VIEWPOINT", "POINTS", "DATA"};

/** The type for a SIZE and a TYPE entry. */
std::optional<FieldType> typeFor(std::string_view size, std::string_view type) {
  struct Row {
    std::string_view size, type;
    FieldType result;
  };
  static constexpr Row kTypes[] = {{"1", "I", FieldType::Int8},    {"1", "U", FieldType::UInt8},
                                   {"2", "I", FieldType::Int16},   {"2", "U", FieldType::UInt16},
                                   {"4", "I", FieldType::Int32},   {"4", "U", FieldType::UInt32},
                                   {"8", "I", FieldType::Int64},   {"8", "U", FieldType::UInt64},
                                   {"4", "F", FieldType::Float32}, {"8", "F", FieldType::Float64}};
  for (const Row& row : kTypes)
    if (row.size == size && row.type == type) return row.result;
  return std::nullopt;
}

/** One header in the making: the lines are gathered, then checked against each other. */
class PcdHeaderParser {
public:
  explicit PcdHeaderParser(LineReader& lines)
      : lines_(lines)
      , first_byte_(lines.position()) {}

  PcdHeader parse() {
    std::string_view line;
    do {
      if (!lines_.next(line)) lines_.fail("a DATA line at the end of the PCD header", "the end of the file");
      if (lines_.position() - first_byte_ > kMaxHeaderBytes) lines_.fail("a PCD header of at most 1 MiB", "more");
    } while (!takeLine(line));
    buildColumns();
    buildSize();
    return std::move(header_);
  }

private:
  using Tokens = std::vector<std::string_view>;

  /** Returns true for the DATA line. */
  bool takeLine(std::string_view line) {
    if (line.find('\0') != std::string_view::npos) lines_.fail("text in the PCD header", "a NUL byte");
    std::string_view rest = line;
    std::string_view keyword;
    if (!takeToken(rest, keyword)) return false;
    if (keyword[0] == '#') {
      takeHeaderComment(trimmed(line));
      return false;
    }
    if (!isPcdKeyword(keyword)) lines_.fail("a keyword of the PCD header", quoted(keyword));
    if (keyword == "COLUMNS") keyword = "FIELDS";
    if (!seen_.insert(keyword).second) lines_.fail("each header entry once", std::string(keyword) + " again");
    takeEntry(keyword, splitTokens(rest));
    return keyword == "DATA";
  }

  void takeHeaderComment(const std::string& text) {
    const bool is_format_mark = text.find(".PCD") != std::string::npos && text.size() < 80;
    const std::size_t begin = text.find_first_not_of('#');
    if (!is_format_mark && begin != std::string::npos)
      header_.cloud.comments.push_back(trimmed(std::string_view(text).substr(begin)));
  }

  void takeEntry(std::string_view keyword, const Tokens& values) {
    if (keyword == "FIELDS")
      names_ = values;
    else if (keyword == "SIZE")
      sizes_ = values;
    else if (keyword == "TYPE")
      types_ = values;
    else if (keyword == "COUNT")
      counts_ = values;
    else if (keyword == "VIEWPOINT")
      takeViewpoint(values);
    else if (values.size() != 1)
      lines_.fail("one value after " + std::string(keyword), std::to_string(values.size()));
    else if (keyword == "VERSION")
      takeVersion(values[0]);
    else if (keyword == "WIDTH")
      width_ = parseCount(lines_, values[0], "WIDTH");
    else if (keyword == "HEIGHT")
      height_ = parseCount(lines_, values[0], "HEIGHT");
    else if (keyword == "POINTS")
      points_ = parseCount(lines_, values[0], "POINTS");
    else
      takeData(values[0]);
  }

  void takeVersion(std::string_view version) {
    const bool is_number = version.find_first_not_of("0123456789.") == std::string_view::npos;
    if (!is_number) lines_.fail("a PCD version such as 0.7", quoted(version));
    if (version != "0.7" && version != ".7" && version != "0.6" && version != ".6" && version != "0.5" &&
        version != ".5")
      header_.cloud.warnings.push_back("PCD version " + std::string(version.substr(0, 20)) + " is read as 0.7");
  }

  void takeViewpoint(const Tokens& values) {
    if (!parseViewpoint(values, header_.cloud.viewpoint))
      lines_.fail("seven numbers after VIEWPOINT", std::to_string(values.size()) + " values");
  }

  void takeData(std::string_view kind) {
    if (kind == "ascii")
      header_.cloud.format = CloudFormat::PcdAscii;
    else if (kind == "binary")
      header_.cloud.format = CloudFormat::PcdBinary;
    else if (kind == "binary_compressed")
      header_.cloud.format = CloudFormat::PcdCompressed;
    else
      lines_.fail("DATA ascii, binary or binary_compressed", quoted(kind));
  }

  void requireSameLength(const char* keyword, const Tokens& values) const {
    if (values.size() != names_.size())
      lines_.fail(std::to_string(names_.size()) + " entries after " + keyword + ", as after FIELDS",
                  std::to_string(values.size()));
  }

  void buildColumns() {
    if (names_.empty()) lines_.fail("field names after FIELDS", "none");
    if (names_.size() > kMaxFields) lines_.fail("at most 1000 fields", std::to_string(names_.size()));
    if (seen_.count("COUNT") == 0) counts_.assign(names_.size(), "1");
    requireSameLength("SIZE", sizes_);
    requireSameLength("TYPE", types_);
    requireSameLength("COUNT", counts_);
    std::set<std::string_view> used;
    for (std::size_t i = 0; i < names_.size(); ++i) {
      if (names_[i] != "_" && !used.insert(names_[i]).second)
        lines_.fail("every field name once", quoted(names_[i]) + " twice");
      header_.columns.push_back(columnAt(i));
    }
  }

  CloudField columnAt(std::size_t i) {
    const std::optional<FieldType> type = typeFor(sizes_[i], types_[i]);
    if (!type)
      lines_.fail("TYPE I or U with SIZE 1, 2, 4, 8 or TYPE F with SIZE 4, 8 for field " + quoted(names_[i]),
                  "TYPE " + quoted(types_[i]) + " with SIZE " + quoted(sizes_[i]));
    const std::uint64_t count = parseCount(lines_, counts_[i], "COUNT");
    if (count == 0) lines_.fail("COUNT of at least 1", "0 for field " + quoted(names_[i]));
    const CloudField column{std::string(names_[i]), *type, static_cast<std::uint32_t>(count), header_.step};
    header_.step += sizeOf(*type) * count;
    if (header_.step > kMaxCount) lines_.fail("rows below 2 GiB", "more");
    return column;
  }

  void buildSize() {
    if (!points_ && !width_) lines_.fail("WIDTH and HEIGHT or POINTS in the header", "neither");
    if (!width_) {
      if (height_ && *height_ != 1) lines_.fail("WIDTH beside HEIGHT", "HEIGHT only");
      width_ = points_;
    }
    // Both are below 2^31, so the product fits.
    const std::uint64_t product = *width_ * height_.value_or(1);
    if (points_ && product != *points_)
      lines_.fail("WIDTH x HEIGHT = POINTS", std::to_string(product) + " and " + std::to_string(*points_));
    if (product > kMaxCount) lines_.fail("at most 2^31 - 1 points", std::to_string(product));
    header_.cloud.width = product == 0 ? 0 : static_cast<std::uint32_t>(*width_);
    header_.cloud.height = product == 0 ? 1 : static_cast<std::uint32_t>(height_.value_or(1));
  }

  LineReader& lines_;
  std::size_t first_byte_;
  PcdHeader header_;
  std::set<std::string_view> seen_;
  Tokens names_, sizes_, types_, counts_;
  std::optional<std::uint64_t> width_, height_, points_;
};

} // namespace

bool isPcdKeyword(std::string_view token) {
  return std::find(kKeywords.begin(), kKeywords.end(), token) != kKeywords.end();
}

PcdHeader readPcdHeader(LineReader& lines) {
  return PcdHeaderParser(lines).parse();
}

} // namespace pcl_gpf
