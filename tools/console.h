// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace pcl_gpf {

class Options;

/** \brief Messages of one run: everything goes to standard error; --quiet leaves warnings and errors. */
class Console {
public:
  explicit Console(const Options& options);

  /** \brief A line of information. */
  void
  say(const std::string& line) const;
  /** \brief A line that starts with "warning:", also kept for the report. */
  void
  warn(const std::string& sentence);

  bool
  quiet() const { return quiet_; }
  const std::vector<std::string>&
  warnings() const { return warnings_; }

private:
  bool quiet_;
  std::vector<std::string> warnings_;
};

/** \brief Writes to standard output and makes sure that it arrived. \throws IoError (kind Unwritable) */
void
printToStandardOutput(const std::string& text);

/** \brief Six significant digits at most, independent of the locale: "0.00123", "1.5e-07". */
std::string
shortNumber(double value);

} // namespace pcl_gpf
