// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "lengths.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace pcl_gpf {

/** \brief The command line is wrong; the message names option, value and what is allowed. Exit code 2. */
class UsageError : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/** \brief What the value of an option is; decides how it is checked and shown. */
enum class OptionKind {
  Flag,         ///< no value
  Text,         ///< any text that is not empty, a file name for example
  OptionalText, ///< --name or --name=TEXT; without a value the text is "-"
  Choice,       ///< one of `choices`
  Count,        ///< whole number within [least, most]
  Number,       ///< number within the range
  Length,       ///< 0.01, 4x, 1% or auto (lengths.h); never negative
  Share,        ///< a count (25000) or a percentage (50%), more than 0
  Vector        ///< three numbers with commas: 1,2,3
};

/** \brief One option as data: help, checks and the tables of docs/tool.md all come from it. */
struct OptionSpec {
  std::string name; ///< without dashes
  OptionKind kind = OptionKind::Flag;
  std::string metavar;      ///< name of the value in the help; empty for flags and choices
  std::string default_text; ///< what holds when the option is not given: a valid value, or empty (then text in `help` says it)
  std::string help;         ///< one sentence with the unit, no full stop
  char letter = '\0';       ///< one-letter form, 0 = none
  std::vector<std::string> choices{};
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  bool above_least = false; ///< the value must be greater than `least`, not equal
  bool below_most = false;  ///< the value must be less than `most`, not equal
};

/** \brief A number of points: either a count or a share of what is there. */
struct Share {
  double ratio = 1.0;      ///< 0 < ratio <= 1, when count is 0
  std::uint64_t count = 0; ///< when > 0
};

/** \brief The checked command line of one command. Getters of values throw std::logic_error for a name that is not in the table. */
class Options {
public:
  /** \brief Checks words against the table.
   * \param[in] max_files most file names that may stand without an option
   * \throws UsageError naming option, value and range, or the nearest right spelling */
  static Options
  parse(const std::vector<OptionSpec>& table, const std::vector<std::string>& words, std::size_t max_files);

  /** \brief Whether the user wrote it (flags: whether it is set); never for an option that the command does not have. */
  bool
  given(const std::string& name) const;

  /** \brief Takes the values of `other`, of the same table, for options that were not given. */
  void
  complete(const Options& other) { values_.insert(other.values_.begin(), other.values_.end()); }

  /** \brief The options "PREFIX-name" as options of another table, which has them as "name"; threads and the like, which both tables
   * have under one name, are taken over. */
  Options
  section(const std::string& prefix, const std::vector<OptionSpec>& table) const;

  /** \brief The value written, else the default text, else "". */
  const std::string&
  text(const std::string& name) const;

  std::uint64_t
  count(const std::string& name) const;
  double
  number(const std::string& name) const;
  Length
  length(const std::string& name) const;
  Share
  share(const std::string& name) const;
  std::vector<double>
  vector(const std::string& name) const;

  /** \brief The words that belong to no option, in order. */
  const std::vector<std::string>&
  files() const { return files_; }

private:
  const OptionSpec&
  spec(const std::string& name) const;

  std::vector<OptionSpec> table_;
  std::map<std::string, std::string> values_;
  std::vector<std::string> files_;
};

/** \brief The allowed values in words, for example "0 .. 0.5", "> 0", "paper | fixed". */
std::string
describeRange(const OptionSpec& spec);

} // namespace pcl_gpf
