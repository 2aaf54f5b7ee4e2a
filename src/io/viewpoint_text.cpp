// SPDX-License-Identifier: BSD-3-Clause
#include "io/viewpoint_text.h"

#include "io/element_bytes.h"
#include "io/format_limits.h"
#include "io/text_lines.h"

namespace pcl_gpf {

std::string viewpointText(const std::array<double, 7>& viewpoint) {
  std::string text;
  for (const double& value : viewpoint) {
    char buffer[kMaxElementText];
    const char* end = formatElement(FieldType::Float64, reinterpret_cast<const unsigned char*>(&value), buffer);
    if (!text.empty()) text += ' ';
    text.append(static_cast<const char*>(buffer), end);
  }
  return text;
}

bool parseViewpoint(const std::vector<std::string_view>& tokens, std::array<double, 7>& viewpoint) {
  std::array<double, 7> values{};
  if (tokens.size() != values.size()) return false;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!parseReal(tokens[i], values[i])) return false;
  viewpoint = values;
  return true;
}

void takeComment(std::string_view text, CloudFile& cloud) {
  std::string_view rest = text;
  std::string_view token;
  if (takeToken(rest, token) && token == "viewpoint" && parseViewpoint(splitTokens(rest), cloud.viewpoint)) return;
  cloud.comments.push_back(trimmed(text));
}

std::vector<std::string> commentLines(const CloudFile& cloud) {
  // Half of what a reader takes as a header, so that what is written can be read again.
  std::size_t bytes_left = kMaxHeaderBytes / 2;
  std::vector<std::string> lines;
  for (const std::string& comment : cloud.comments) {
    std::string line;
    const auto finish = [&] {
      line = trimmed(line);
      const std::size_t cost = line.size() + sizeof "comment \n";
      if (!line.empty() && cost <= bytes_left) {
        bytes_left -= cost;
        lines.push_back(line);
      }
      line.clear();
    };
    for (const char c : comment) {
      if (c == '\n' || c == '\r')
        finish();
      else if (static_cast<unsigned char>(c) >= 0x20 || c == '\t')
        line += c;
    }
    finish();
  }
  return lines;
}

} // namespace pcl_gpf
