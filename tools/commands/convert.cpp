// SPDX-License-Identifier: BSD-3-Clause
#include "../console.h"
#include "../field_types.h"
#include "../load_cloud.h"
#include "../option_groups.h"
#include "../precision.h"
#include "commands.h"

#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/io/write_cloud.h>

#include <stdexcept>

namespace pcl_gpf {

namespace {

const std::vector<std::string> kAxes{"x", "y", "z"};

void
changePrecision(CloudFile& cloud, FieldType type)
{
  try {
    changeFieldTypes(cloud, kAxes, type);
  } catch (const std::out_of_range& error) {
    throw UnsuitableData(std::string("coordinates do not fit in the precision chosen: ") + error.what());
  }
}

/** Adds the offset in double, before any rounding to float. */
void
shift(CloudFile& cloud, const std::vector<double>& offset)
{
  try {
    for (std::size_t i = 0; i < cloud.size(); ++i)
      for (int axis = 0; axis < 3; ++axis) {
        const int field = cloud.findField(kAxes[static_cast<std::size_t>(axis)]);
        cloud.setCoordinate(i, axis, cloud.value(i, field) + offset[static_cast<std::size_t>(axis)]);
      }
  } catch (const std::out_of_range& error) {
    throw UnsuitableData(std::string("shifted coordinates do not fit in their type: ") + error.what());
  }
}

/** The type that holds all three coordinates and no less than they have. */
FieldType
widestType(const CloudFile& cloud)
{
  for (const std::string& axis : kAxes) {
    const FieldType type = cloud.fields[static_cast<std::size_t>(cloud.findField(axis))].type;
    if (type != FieldType::Float32)
      return FieldType::Float64;
  }
  return FieldType::Float32;
}

/** Coordinates that are rounded to float may lose the detail of the cloud; the file then looks right and is not. */
void
warnWhereFloatIsCoarse(const LoadedCloud& before, const CloudFile& after, Console& console)
{
  const Precision precision = judgePrecision(inspectCloud(after), measureCloud(before, 0).spacing);
  if (precision.verdict != Precision::Verdict::Fine)
    console.warn(describe(precision));
}

ExitCode
runConvert(const Options& options)
{
  checkOutputs(options);
  Console console(options);
  const LoadedCloud input = loadCloud(options.files()[0], console);
  CloudFile cloud = input.file;
  const std::string& precision = options.text("precision");
  FieldType target = widestType(cloud);
  if (precision != "same")
    target = precision == "float" ? FieldType::Float32 : FieldType::Float64;
  if (options.given("offset")) {
    changePrecision(cloud, FieldType::Float64);
    shift(cloud, options.vector("offset"));
  }
  if (options.given("offset") || precision != "same")
    changePrecision(cloud, target);
  if (target == FieldType::Float32 && cloud.size() > 0)
    warnWhereFloatIsCoarse(input, cloud, console);
  writeCloud(cloud, outputPath(options), writeOptions(options));
  console.say("wrote " + std::to_string(cloud.size()) + " points");
  return kExitOk;
}

OptionSpec
precisionOption()
{
  OptionSpec spec{"precision", OptionKind::Choice, "", "same", "type of x, y and z in the output"};
  spec.choices = {"same", "float", "double"};
  return spec;
}

} // namespace

Command
convertCommand()
{
  Command command;
  command.name = "convert";
  command.summary = "Changes format, precision or origin of a cloud; every field is kept";
  command.synopsis = "IN -o OUT [options]";
  command.examples = {{{"pcl_gpf_tool convert scan.ply -o scan.pcd", "another format"},
                       {"pcl_gpf_tool convert scan.pcd -o scan_text.pcd --format pcd-ascii", "text instead of binary"},
                       {"pcl_gpf_tool convert utm.ply -o local.ply --offset -691000,-5335000,0 --precision float",
                        "a local origin, then float"}}};
  command.options = {outputOption(),
                     formatOption(),
                     precisionOption(),
                     {"offset", OptionKind::Vector, "DX,DY,DZ", "", "added to every point, in double, before any rounding"},
                     overwriteOption()};
  command.notes = "With --precision same, --offset turns integer coordinates into double.";
  command.run = runConvert;
  return command;
}

} // namespace pcl_gpf
