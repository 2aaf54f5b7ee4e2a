// SPDX-License-Identifier: BSD-3-Clause
#include "option_groups.h"

#include <pcl_gpf/io/atomic_file.h>

#include <algorithm>
#include <array>
#include <utility>

namespace pcl_gpf {

namespace {

const std::array<std::pair<const char*, CloudFormat>, 7> kFormats{{{"pcd-ascii", CloudFormat::PcdAscii},
                                                                   {"pcd-binary", CloudFormat::PcdBinary},
                                                                   {"pcd-compressed", CloudFormat::PcdCompressed},
                                                                   {"ply-ascii", CloudFormat::PlyAscii},
                                                                   {"ply-le", CloudFormat::PlyLittleEndian},
                                                                   {"ply-be", CloudFormat::PlyBigEndian},
                                                                   {"xyz", CloudFormat::Xyz}}};

OptionSpec
choice(const std::string& name, std::vector<std::string> choices, const std::string& default_text, const std::string& help)
{
  OptionSpec spec{name, OptionKind::Choice, "", default_text, help};
  spec.choices = std::move(choices);
  return spec;
}

OptionSpec
count(const std::string& name, const std::string& default_text, double most, const std::string& help)
{
  OptionSpec spec{name, OptionKind::Count, "N", default_text, help};
  spec.least = 0;
  spec.most = most;
  return spec;
}

} // namespace

OptionSpec
helpOption()
{
  return {"help", OptionKind::Flag, "", "", "show this help", 'h'};
}

OptionSpec
quietOption()
{
  return {"quiet", OptionKind::Flag, "", "", "print only warnings and errors, no progress", 'q'};
}

OptionSpec
outputOption()
{
  return {"output", OptionKind::Text, "FILE", "", "the file to write; - is standard output", 'o'};
}

OptionSpec
formatOption()
{
  std::vector<std::string> names;
  for (const auto& [name, format] : kFormats)
    names.emplace_back(name);
  return choice("format", names, "", "format of the output; without it the extension decides, text or binary as the input");
}

OptionSpec
overwriteOption()
{
  return {"overwrite", OptionKind::Flag, "", "", "replace existing output files"};
}

OptionSpec
jsonOption()
{
  return {"json", OptionKind::OptionalText, "FILE", "", "write a report as JSON to FILE, or to standard output (also: -)"};
}

OptionSpec
threadsOption()
{
  return count("threads", "0", 1024, "threads, 0 = all that the process may use; the result does not depend on it");
}

OptionSpec
seedOption()
{
  // Up to here a whole number is exact in JSON, too.
  return count("seed", "0", 9007199254740991.0, "seed of random choices");
}

OptionSpec
progressOption()
{
  return choice("progress", {"auto", "bar", "plain", "none"}, "auto",
                "auto: a bar on a terminal, else a line every 10 s; plain: a line every 10 % or 10 s");
}

OptionSpec
forceOption()
{
  return {"force", OptionKind::Flag, "", "", "go on with data that would be refused as quantised by float coordinates"};
}

std::vector<OptionSpec>
operator+(std::vector<OptionSpec> first, const std::vector<OptionSpec>& second)
{
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

unsigned
threadCount(const Options& options)
{
  return static_cast<unsigned>(options.count("threads"));
}

const std::string&
outputPath(const Options& options)
{
  if (!options.given("output"))
    throw UsageError("no output: add -o FILE");
  return options.text("output");
}

std::optional<CloudFormat>
chosenFormat(const Options& options)
{
  for (const auto& [name, format] : kFormats)
    if (options.text("format") == name)
      return format;
  return std::nullopt;
}

WriteOptions
writeOptions(const Options& options)
{
  WriteOptions write;
  write.format = chosenFormat(options);
  write.overwrite = options.given("overwrite");
  return write;
}

void
checkOutputHolds(const CloudFile& cloud, const Options& options)
{
  const std::string& output = outputPath(options);
  const std::optional<CloudFormat> format = chosenFormat(options);
  checkFits(cloud, format ? *format : formatForPath(output, cloud), output);
}

void
checkReport(const Options& options)
{
  if (!options.given("json"))
    return;
  const std::string& report = options.text("json");
  const std::vector<std::string>& inputs = options.files();
  if (report != "-" && std::find(inputs.begin(), inputs.end(), report) != inputs.end())
    throw UsageError("the report would replace the input '" + report + "'; give --json=FILE another name");
  checkWritable(report, options.given("overwrite"));
}

void
checkOutputs(const Options& options)
{
  const std::string& output = outputPath(options);
  if (options.given("json") && options.text("json") == output)
    throw UsageError("the cloud and the report both go to '" + output + "'; give --json=FILE another name");
  checkReport(options);
  checkWritable(output, options.given("overwrite"));
  if (!chosenFormat(options))
    formatForPath(output, CloudFile());
}

} // namespace pcl_gpf
