// SPDX-License-Identifier: BSD-3-Clause
#include "io/text_lines.h"

#include <charconv>
#include <cstring>

#include "io/format_limits.h"
#include "pcl_gpf/io/errors.h"

namespace pcl_gpf {

void Source::failAtLine(std::size_t line, const std::string& promised, const std::string& found) const {
  throw IoError(IoErrorKind::Unreadable, name, "line " + std::to_string(line), promised, found);
}

void Source::failAtByte(std::size_t byte, const std::string& promised, const std::string& found) const {
  throw IoError(IoErrorKind::Unreadable, name, "byte " + std::to_string(byte), promised, found);
}

void Source::fail(const std::string& promised, const std::string& found) const {
  throw IoError(IoErrorKind::Unreadable, name, "", promised, found);
}

void LineReader::chooseLineEnd() {
  line_end_ = '\n';
  for (std::size_t i = next_; i < source_->size; ++i) {
    if (source_->data[i] == '\n') return;
    if (source_->data[i] != '\r') continue;
    if (i + 1 < source_->size && source_->data[i + 1] != '\n') line_end_ = '\r';
    return;
  }
}

bool LineReader::next(std::string_view& line) {
  if (next_ >= source_->size) return false;
  if (line_end_ == '\0') chooseLineEnd();
  const unsigned char* begin = source_->data + next_;
  const std::size_t left = bytesLeft();
  const void* found = std::memchr(begin, line_end_, left);
  std::size_t length = found ? static_cast<std::size_t>(static_cast<const unsigned char*>(found) - begin) : left;
  next_ += found ? length + 1 : length;
  ++line_number_;
  if (line_end_ == '\n' && length > 0 && begin[length - 1] == '\r') {
    --length;
    saw_crlf_ = true;
  } else if (found) {
    saw_lf_ = true;
  }
  line = std::string_view(reinterpret_cast<const char*>(begin), length);
  return true;
}

bool LineReader::nextFilled(std::string_view& line) {
  while (next(line)) {
    std::string_view rest = line;
    std::string_view token;
    if (takeToken(rest, token)) return true;
  }
  return false;
}

void LineReader::reportLineEnds(std::vector<std::string>& warnings) const {
  if (line_end_ == '\r') warnings.push_back("the lines end in CR, as on old Macintosh systems");
  if (saw_lf_ && saw_crlf_) warnings.push_back("some lines end in LF and some in CR LF");
}

std::vector<std::string_view> splitTokens(std::string_view line) {
  std::vector<std::string_view> tokens;
  std::string_view token;
  while (takeToken(line, token))
    tokens.push_back(token);
  return tokens;
}

std::string trimmed(std::string_view text) {
  constexpr const char* kBlanks = " \t\r\n\v\f";
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return std::string(text.substr(first, text.find_last_not_of(kBlanks) - first + 1));
}

std::string quoted(std::string_view token) {
  return "'" + printable(std::string(token.substr(0, 100))) + "'";
}

std::uint64_t parseCount(const LineReader& lines, std::string_view token, const std::string& what) {
  std::uint64_t value = 0;
  const char* end = token.data() + token.size();
  const auto result = std::from_chars(token.data(), end, value);
  if (token.empty() || result.ptr != end || result.ec != std::errc() || value > kMaxCount)
    lines.fail(what + " as a whole number from 0 to " + std::to_string(kMaxCount), quoted(token));
  return value;
}

std::size_t byteOrderMark(const Source& source, std::vector<std::string>* warnings) {
  constexpr unsigned char kMark[3] = {0xef, 0xbb, 0xbf};
  if (source.size < sizeof kMark || std::memcmp(source.data, kMark, sizeof kMark) != 0) return 0;
  if (warnings) warnings->push_back("the file starts with a UTF-8 byte-order mark");
  return sizeof kMark;
}

} // namespace pcl_gpf
