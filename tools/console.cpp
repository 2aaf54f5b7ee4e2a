// SPDX-License-Identifier: BSD-3-Clause
#include "console.h"

#include "options.h"

#include <pcl_gpf/io/errors.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <unistd.h>

namespace pcl_gpf {

Console::Console(const Options& options) : quiet_(options.given("quiet")) {}

void
Console::say(const std::string& line) const
{
  if (!quiet_)
    std::fputs((line + "\n").c_str(), stderr);
}

void
Console::warn(const std::string& sentence)
{
  warnings_.push_back(sentence);
  std::fputs(("warning: " + sentence + "\n").c_str(), stderr);
}

void
printToStandardOutput(const std::string& text)
{
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t written = ::write(STDOUT_FILENO, text.data() + done, text.size() - done);
    if (written < 0 && errno == EINTR)
      continue;
    if (written < 0)
      throw IoError(IoErrorKind::Unwritable, "standard output", "", "to write " + std::to_string(text.size()) + " bytes",
                    std::strerror(errno));
    done += static_cast<std::size_t>(written);
  }
}

std::string
shortNumber(double value)
{
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, 6).ptr;
  return std::string(text.data(), end);
}

} // namespace pcl_gpf
