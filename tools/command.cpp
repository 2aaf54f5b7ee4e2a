// SPDX-License-Identifier: BSD-3-Clause
#include "command.h"

#include <algorithm>

namespace pcl_gpf {

namespace {

constexpr std::size_t kLineWidth = 100;
constexpr std::size_t kHelpColumn = 34;

std::string
valueName(const OptionSpec& spec)
{
  if (spec.kind != OptionKind::Choice || !spec.metavar.empty())
    return spec.metavar;
  return spec.choices == std::vector<std::string>{"on", "off"} ? "on|off" : "NAME";
}

std::string
spelling(const OptionSpec& spec)
{
  std::string text = spec.letter ? std::string("-") + spec.letter + ", --" : "    --";
  text += spec.name;
  if (spec.kind == OptionKind::OptionalText)
    return text + "[=" + valueName(spec) + "]";
  return spec.kind == OptionKind::Flag ? text : text + " " + valueName(spec);
}

/** What the help and the table say behind the sentence: the range where it is not plain, and the default. */
std::string
rangeAndDefault(const OptionSpec& spec)
{
  std::string text;
  const bool ranged = spec.kind == OptionKind::Count || spec.kind == OptionKind::Number || spec.kind == OptionKind::Choice;
  if (ranged)
    text = describeRange(spec);
  if (!spec.default_text.empty())
    text += (text.empty() ? "default " : "; default ") + spec.default_text;
  return text;
}

std::string
wrapped(const std::string& text, std::size_t first_column, std::size_t indent)
{
  std::string result;
  std::size_t column = first_column;
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    if (column > indent && column + 1 + word.size() > kLineWidth) {
      result += "\n" + std::string(indent, ' ');
      column = indent;
    } else if (column > indent) {
      result += " ";
      ++column;
    }
    result += word;
    column += word.size();
    begin = end + 1;
  }
  return result;
}

std::string
optionLine(const OptionSpec& spec)
{
  std::string line = "  " + spelling(spec);
  line += line.size() + 2 > kHelpColumn ? "\n" + std::string(kHelpColumn, ' ')
                                        : std::string(kHelpColumn - line.size(), ' ');
  const std::string details = rangeAndDefault(spec);
  const std::string help = spec.help + (details.empty() ? "" : " [" + details + "]");
  return line + wrapped(help, kHelpColumn, kHelpColumn) + "\n";
}

} // namespace

std::string
helpText(const Command& command)
{
  std::string text = "Examples:\n";
  std::size_t widest = 0;
  for (const Example& example : command.examples)
    widest = std::max(widest, example.command_line.size());
  for (const Example& example : command.examples)
    text += "  " + example.command_line + std::string(widest - example.command_line.size(), ' ') + "   # " +
            example.meaning + "\n";
  text += "\nUsage: pcl_gpf_tool " + command.name + " " + command.synopsis + "\n\n" + command.summary + ".\n\nOptions:\n";
  for (const OptionSpec& spec : command.options)
    text += optionLine(spec);
  const bool lengths = std::any_of(command.options.begin(), command.options.end(),
                                   [](const OptionSpec& spec) { return spec.kind == OptionKind::Length; });
  if (lengths)
    text += "\nLENGTH is 0.01 (cloud units), 4x (times the mean spacing), 1% (of the box diagonal) or auto.\n";
  if (!command.notes.empty())
    text += "\n" + command.notes + "\n";
  return text;
}

std::string
markdownTable(const Command& command)
{
  std::string text = "| option | meaning | range and default |\n|---|---|---|\n";
  const auto escaped = [](std::string cell) {
    for (std::size_t i = 0; (i = cell.find('|', i)) != std::string::npos; i += 2)
      cell.insert(i, "\\");
    return cell;
  };
  for (const OptionSpec& spec : command.options) {
    std::string name = spelling(spec);
    name.erase(0, name.find_first_not_of(' '));
    text += "| `" + escaped(name) + "` | " + escaped(spec.help) + " | " + escaped(rangeAndDefault(spec)) + " |\n";
  }
  return text;
}

} // namespace pcl_gpf
