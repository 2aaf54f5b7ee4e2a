// SPDX-License-Identifier: BSD-3-Clause
#include "options.h"

#include "option_values.h"
#include "spelling.h"

#include <pcl_gpf/io/errors.h>

#include <boost/program_options.hpp>

#include <algorithm>
#include <cctype>

namespace po = boost::program_options;

namespace pcl_gpf {

namespace {

po::options_description
describe(const std::vector<OptionSpec>& table)
{
  po::options_description description;
  for (const OptionSpec& spec : table) {
    const std::string names = spec.letter ? spec.name + "," + spec.letter : spec.name;
    if (spec.kind == OptionKind::Flag)
      description.add_options()(names.c_str(), "");
    else if (spec.kind == OptionKind::OptionalText)
      description.add_options()(names.c_str(), po::value<std::string>()->implicit_value("-"));
    else
      description.add_options()(names.c_str(), po::value<std::string>());
  }
  return description;
}

[[noreturn]] void
refuseUnknown(const std::vector<OptionSpec>& table, const std::string& word)
{
  std::vector<std::string> names;
  for (const OptionSpec& spec : table)
    names.push_back(spec.name);
  const std::string bare = word.substr(std::min(word.find_first_not_of('-'), word.size()));
  const std::string name = bare.substr(0, bare.find('='));
  const std::string nearest = nearestSpelling(name, names);
  std::string message = "unknown option '" + printable(word) + "'";
  if (name == nearest)
    message += "; write it with two dashes: '--" + nearest + "'";
  else if (!nearest.empty())
    message += "; did you mean '--" + nearest + "'?";
  throw UsageError(message);
}

/** PCL's tools write -radius; so does a habit. A file name that starts with a dash needs "./" before it. */
void
refuseSingleDashWords(const std::vector<OptionSpec>& table, const std::vector<std::string>& words)
{
  for (const std::string& word : words) {
    if (word == "--")
      return;
    if (word.size() < 3 || word[0] != '-' || word[1] == '-')
      continue;
    const bool number = std::isdigit(static_cast<unsigned char>(word[1])) || word[1] == '.' ||
                        word == "-inf" || word == "-nan" || word == "-infinity";
    if (!number)
      refuseUnknown(table, word);
  }
}

std::vector<po::option>
tokenize(const std::vector<OptionSpec>& table, const std::vector<std::string>& words)
{
  using namespace po::command_line_style;
  // No abbreviations: a longer name added later would change what a script means.
  const int style = allow_long | long_allow_adjacent | long_allow_next | allow_short | allow_dash_for_short |
                    short_allow_next;
  const po::options_description description = describe(table);
  try {
    return po::command_line_parser(words).options(description).style(style).run().options;
  } catch (const po::unknown_option& error) {
    refuseUnknown(table, error.get_option_name());
  } catch (const po::invalid_command_line_syntax& error) {
    const std::string name = "option '" + printable(error.get_option_name()) + "' ";
    if (error.kind() == po::invalid_syntax::extra_parameter)
      throw UsageError(name + "takes no value");
    throw UsageError(name + "needs a value");
  } catch (const po::error& error) {
    throw UsageError(error.what());
  }
}

/** "--output --overwrite": the second word is no file name, whatever Boost says. */
void
refuseOptionAsValue(const std::vector<OptionSpec>& table, const po::option& token)
{
  if (token.original_tokens.size() < 2 || token.value.empty())
    return;
  for (const OptionSpec& spec : table)
    if (token.value[0] == "--" + spec.name || (spec.letter && token.value[0] == std::string("-") + spec.letter))
      throw UsageError("option '--" + token.string_key + "' needs a value");
}

} // namespace

Options
Options::parse(const std::vector<OptionSpec>& table, const std::vector<std::string>& words, std::size_t max_files)
{
  refuseSingleDashWords(table, words);
  const std::vector<po::option> tokens = tokenize(table, words);
  const auto is_file = [](const po::option& token) { return token.position_key >= 0; };
  auto files = static_cast<std::size_t>(std::count_if(tokens.begin(), tokens.end(), is_file));

  Options options;
  options.table_ = table;
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    const po::option& token = tokens[i];
    if (is_file(token)) {
      options.files_.push_back(token.value.at(0));
      continue;
    }
    refuseOptionAsValue(table, token);
    const OptionSpec& spec = options.spec(token.string_key);
    std::string value = token.value.empty() ? std::string() : token.value[0];
    // "--json FILE": the word behind belongs to it when it would be a file too many.
    const bool bare = spec.kind == OptionKind::OptionalText && token.value.empty();
    if (bare && files > max_files && i + 1 < tokens.size() && is_file(tokens[i + 1])) {
      value = tokens[++i].value.at(0);
      --files;
    } else if (bare)
      value = "-";
    checkValue(spec, value);
    if (!options.values_.emplace(spec.name, value).second)
      throw UsageError("option '--" + spec.name + "' is given twice; give it once");
  }
  if (options.files_.size() > max_files)
    throw UsageError("one file too many: '" + printable(options.files_[max_files]) + "'");
  return options;
}

bool
Options::given(const std::string& name) const
{
  return values_.count(name) > 0;
}

Options
Options::section(const std::string& prefix, const std::vector<OptionSpec>& table) const
{
  Options options;
  options.table_ = table;
  for (const OptionSpec& entry : table)
    for (const std::string& name : {prefix + "-" + entry.name, entry.name})
      if (const auto value = values_.find(name); value != values_.end())
        options.values_.emplace(entry.name, value->second);
  return options;
}

const std::string&
Options::text(const std::string& name) const
{
  const auto value = values_.find(name);
  return value != values_.end() ? value->second : spec(name).default_text;
}

std::uint64_t
Options::count(const std::string& name) const
{
  return parseCount(text(name)).value();
}

double
Options::number(const std::string& name) const
{
  return parseNumber(text(name)).value();
}

Length
Options::length(const std::string& name) const
{
  return parseLength(text(name)).value();
}

Share
Options::share(const std::string& name) const
{
  return parseShare(text(name)).value();
}

std::vector<double>
Options::vector(const std::string& name) const
{
  return parseVector(text(name)).value();
}

const OptionSpec&
Options::spec(const std::string& name) const
{
  for (const OptionSpec& candidate : table_)
    if (candidate.name == name)
      return candidate;
  throw std::logic_error("the table of options has no '" + name + "'");
}

} // namespace pcl_gpf
