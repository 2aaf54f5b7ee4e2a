// SPDX-License-Identifier: BSD-3-Clause
#include "../console.h"
#include "../field_types.h"
#include "../load_cloud.h"
#include "../option_groups.h"
#include "../positions.h"
#include "commands.h"

#include <pcl_gpf/core/analysis/synthetic_noise.h>
#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/io/write_cloud.h>

#include <algorithm>
#include <stdexcept>

namespace pcl_gpf {

namespace {

const std::vector<std::string> kLengths{"gaussian", "uniform", "along-normal"};

void
requireSomething(const Options& options)
{
  if (!options.given("outliers") &&
      std::none_of(kLengths.begin(), kLengths.end(), [&](const std::string& name) { return options.given(name); }))
    throw UsageError("nothing to add: give --gaussian, --uniform, --along-normal or --outliers");
  for (const std::string& name : kLengths)
    if (options.given(name) && options.length(name).unit == Length::Unit::Auto)
      throw UsageError("option '--" + name + "': there is no automatic value; give a length");
}

/** The share of the finite points that --outliers means. */
double
outlierShare(const Options& options, std::size_t finite)
{
  if (!options.given("outliers"))
    return 0.0;
  const Share share = options.share("outliers");
  if (share.count > finite)
    throw UsageError("option '--outliers': " + std::to_string(share.count) + " of " + std::to_string(finite) +
                     " finite points is too many");
  return share.count > 0 ? static_cast<double>(share.count) / static_cast<double>(finite) : share.ratio;
}

SyntheticNoise
noiseFrom(const Options& options, const LoadedCloud& cloud)
{
  CloudScale scale;
  scale.diagonal = cloud.box.diagonal();
  if (std::any_of(kLengths.begin(), kLengths.end(), [&](const std::string& name) {
        return options.given(name) && options.length(name).unit == Length::Unit::Spacing;
      }))
    scale = measureCloud(cloud, threadCount(options));
  const auto length = [&](const std::string& name) {
    return options.given(name) ? options.length(name).resolve(scale) : 0.0;
  };
  SyntheticNoise noise;
  noise.gaussian = length("gaussian");
  noise.uniform = length("uniform");
  noise.along_normal = length("along-normal");
  noise.outliers = outlierShare(options, cloud.finite);
  noise.seed = options.count("seed");
  return noise;
}

/** Only rows that moved are written, so that the others keep every bit. */
void
storeMoved(const std::vector<Position>& before, const std::vector<Position>& after, CloudFile& cloud)
{
  promoteIntegerFields(cloud, {"x", "y", "z"}, FieldType::Float64);
  try {
    for (std::size_t i = 0; i < after.size(); ++i)
      for (int axis = 0; axis < 3; ++axis) {
        const double value = after[i][static_cast<std::size_t>(axis)];
        if (value != before[i][static_cast<std::size_t>(axis)] && std::isfinite(value))
          cloud.setCoordinate(i, axis, value);
      }
  } catch (const std::out_of_range& error) {
    throw UnsuitableData(std::string("noisy coordinates do not fit in their type: ") + error.what());
  }
}

ExitCode
runNoise(const Options& options)
{
  requireSomething(options);
  checkWritable(outputPath(options), options.given("overwrite"));
  Console console(options);
  LoadedCloud cloud = loadCloud(options.files()[0], console);
  requireUsable(cloud);
  const SyntheticNoise noise = noiseFrom(options, cloud);
  if (noise.along_normal > 0 && !cloud.file.hasNormals())
    throw UnsuitableData("--along-normal needs normals in the file; add them with 'pcl_gpf_tool normals'");

  const std::vector<Position> before = positionsOf(cloud.coordinates);
  std::vector<Position> after = before;
  const NoiseReport report = addNoise(noise, after, noise.along_normal > 0 ? normalsOf(cloud.file) : std::vector<Position>{});
  if (report.without_normal > 0)
    console.warn(std::to_string(report.without_normal) + " points have no usable normal and got no noise along it");
  storeMoved(before, after, cloud.file);

  WriteOptions write;
  write.format = chosenFormat(options);
  write.overwrite = options.given("overwrite");
  writeCloud(cloud.file, outputPath(options), write);
  console.say("noise added to " + std::to_string(report.moved) + " points, " + std::to_string(report.outliers) +
              " outliers; gaussian " + shortNumber(noise.gaussian) + ", uniform " + shortNumber(noise.uniform) +
              ", along normal " + shortNumber(noise.along_normal) + " (cloud units), seed " + std::to_string(noise.seed));
  return kExitOk;
}

} // namespace

Command
noiseCommand()
{
  Command command;
  command.name = "noise";
  command.summary = "Adds repeatable synthetic noise and outliers, for tests and demonstrations; keeps order and fields";
  command.synopsis = "IN -o OUT [options]";
  command.examples = {{{"pcl_gpf_tool noise clean.ply -o noisy.ply --gaussian 0.5%", "0.5 % of the box diagonal on each axis"},
                       {"pcl_gpf_tool noise clean.ply -o noisy.ply --along-normal 2x", "twice the spacing along the normals"},
                       {"pcl_gpf_tool noise clean.ply -o noisy.ply --uniform 0.8% --outliers 1% --seed 7",
                        "uniform noise and outliers"}}};
  command.options = {outputOption(),
                     {"gaussian", OptionKind::Length, "LENGTH", "", "standard deviation of Gaussian noise on each axis"},
                     {"uniform", OptionKind::Length, "LENGTH", "", "half width of uniform noise on each axis"},
                     {"along-normal", OptionKind::Length, "LENGTH", "",
                      "standard deviation of Gaussian noise along the normals of the file"},
                     {"outliers", OptionKind::Share, "SHARE", "",
                      "replace this share or number of the points by points anywhere in the box, enlarged 1.2 times"},
                     seedOption(),
                     formatOption(),
                     overwriteOption(),
                     threadsOption()};
  command.notes = "Kinds of noise add up. The same seed gives the same file.";
  command.run = runNoise;
  return command;
}

} // namespace pcl_gpf
