// SPDX-License-Identifier: BSD-3-Clause
// One file of a table of broken or odd files, made in the test, and what the reader must do with it.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "pcl_gpf/io/errors.h"
#include "pcl_gpf/io/read_cloud.h"

namespace pcl_gpf::test {

constexpr int kRefused = -1;

struct RuleCase {
  const char* what;
  std::string bytes;
  int points;       ///< kRefused, or the number of points that must come out
  const char* part; ///< of the error's message, or of one warning ("" for no warning at all)
};

inline CloudFile readText(const std::string& bytes, const std::string& name) {
  return readCloudBuffer(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(), name);
}

inline void expectRule(const RuleCase& rule, const std::string& name) {
  SCOPED_TRACE(rule.what);
  try {
    const CloudFile cloud = readText(rule.bytes, name);
    ASSERT_NE(rule.points, kRefused) << "the file was accepted";
    EXPECT_EQ(cloud.size(), static_cast<std::size_t>(rule.points));
    EXPECT_EQ(cloud.data.size(), cloud.size() * cloud.pointStep());
    std::string warnings;
    for (const std::string& warning : cloud.warnings)
      warnings += warning + "; ";
    if (*rule.part == '\0')
      EXPECT_EQ(warnings, "");
    else
      EXPECT_NE(warnings.find(rule.part), std::string::npos) << warnings;
  } catch (const IoError& error) {
    const std::string message = error.what();
    EXPECT_EQ(rule.points, kRefused) << message;
    EXPECT_NE(message.find(rule.part), std::string::npos) << message;
    EXPECT_EQ(message.find(name), 0U) << message;
  }
}

/** \a text with the first \a old replaced, which must be there. */
inline std::string changed(std::string text, const std::string& old, const std::string& replacement) {
  const std::size_t at = text.find(old);
  if (at == std::string::npos) throw std::logic_error("the test replaces what is not there: " + old);
  return text.replace(at, old.size(), replacement);
}

/** Every LF becomes \a line_end. */
inline std::string withLineEnds(const std::string& text, const std::string& line_end) {
  std::string result;
  for (const char c : text)
    result += c == '\n' ? line_end : std::string(1, c);
  return result;
}

} // namespace pcl_gpf::test
