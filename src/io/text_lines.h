// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace pcl_gpf {

/** \brief The bytes of one input file and its name; nothing is owned. */
struct Source {
  const unsigned char* data = nullptr;
  std::size_t size = 0;
  std::string name;

  [[noreturn]] void failAtLine(std::size_t line, const std::string& promised, const std::string& found) const;
  [[noreturn]] void failAtByte(std::size_t byte, const std::string& promised, const std::string& found) const;
  [[noreturn]] void fail(const std::string& promised, const std::string& found) const;
};

/** \brief Walks over the lines of a file that end in LF, CR LF or (when the first line does) a lone CR. */
class LineReader {
public:
  LineReader(const Source& source, std::size_t first_byte)
      : source_(&source)
      , next_(first_byte) {}

  /** \brief The next line without its end. \return false when no byte is left */
  bool next(std::string_view& line);
  /** \brief The next line that is not blank. */
  bool nextFilled(std::string_view& line);

  /** \brief Number, from 1, of the line that next() gave last. */
  std::size_t lineNumber() const noexcept { return line_number_; }
  /** \brief First byte after that line. */
  std::size_t position() const noexcept { return next_; }
  std::size_t bytesLeft() const noexcept { return source_->size - next_; }
  const Source& source() const noexcept { return *source_; }

  /** \brief Adds a warning when line ends were mixed or are lone CRs. */
  void reportLineEnds(std::vector<std::string>& warnings) const;

  [[noreturn]] void fail(const std::string& promised, const std::string& found) const {
    source_->failAtLine(line_number_, promised, found);
  }

private:
  void chooseLineEnd();

  const Source* source_;
  std::size_t next_;
  std::size_t line_number_ = 0;
  char line_end_ = '\0'; // not known yet
  bool saw_lf_ = false;
  bool saw_crlf_ = false;
};

/** \brief Takes the next token, ended by blanks, off the front of \a line. \return false when only blanks are left */
inline bool takeToken(std::string_view& line, std::string_view& token) noexcept {
  const auto is_blank = [](char c) { return c == ' ' || (c >= '\t' && c <= '\r'); };
  const char* begin = line.data();
  const char* const end = begin + line.size();
  while (begin != end && is_blank(*begin))
    ++begin;
  const char* stop = begin;
  while (stop != end && !is_blank(*stop))
    ++stop;
  token = std::string_view(begin, static_cast<std::size_t>(stop - begin));
  line = std::string_view(stop, static_cast<std::size_t>(end - stop));
  return !token.empty();
}

std::vector<std::string_view> splitTokens(std::string_view line);

/** \brief Text without blanks at both ends. */
std::string trimmed(std::string_view text);

/** \brief 'token' for a message. */
std::string quoted(std::string_view token);

/** \brief Strict decimal digits of a count from 0 to 2^31 - 1. \throws IoError naming \a what */
std::uint64_t parseCount(const LineReader& lines, std::string_view token, const std::string& what);

/** \brief Bytes of a UTF-8 byte-order mark at the start: 3 or 0. */
std::size_t byteOrderMark(const Source& source, std::vector<std::string>* warnings);

} // namespace pcl_gpf
