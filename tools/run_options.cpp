// SPDX-License-Identifier: BSD-3-Clause
#include "run_options.h"

#include "filter_parameters.h"
#include "filter_presets.h"
#include "mesh_options.h"
#include "option_groups.h"
#include "orient_options.h"
#include "spelling.h"
#include "upsample_options.h"

#include <pcl_gpf/io/errors.h>

#include <algorithm>
#include <cctype>
#include <functional>
#include <map>

namespace pcl_gpf {

namespace {

const std::vector<std::string> kGroups{"filter", "orient", "upsample", "mesh"};

std::vector<OptionSpec>
without(std::vector<OptionSpec> options, const std::string& name)
{
  options.erase(std::remove_if(options.begin(), options.end(), [&name](const OptionSpec& option) { return option.name == name; }),
                options.end());
  return options;
}

/** The options of a stage's own command, but for those that the chain itself decides. */
const std::vector<OptionSpec>&
groupOptions(const std::string& group)
{
  static const std::map<std::string, std::vector<OptionSpec>> groups = [] {
    return std::map<std::string, std::vector<OptionSpec>>{
        {"filter", std::vector<OptionSpec>{presetOption()} + optionsOf(filterParameters())},
        {"orient", orientOptions()},
        {"upsample", without(upsampleOptions(), "normals")},
        {"mesh", without(meshOptions(), "orientation")}};
  }();
  return groups.at(group);
}

/** Help that speaks of another option of the group. */
void
renameIn(std::string& help, const std::string& name, const std::string& group)
{
  const std::string old_name = "--" + name, new_name = "--" + group + "-" + name;
  for (std::size_t at = help.find(old_name); at != std::string::npos; at = help.find(old_name, at + new_name.size())) {
    const std::size_t end = at + old_name.size();
    if (end == help.size() || (std::isalnum(static_cast<unsigned char>(help[end])) == 0 && help[end] != '-'))
      help.replace(at, old_name.size(), new_name);
  }
}

std::vector<std::string>
splitAtCommas(const std::string& text)
{
  std::vector<std::string> words;
  std::size_t begin = 0;
  for (std::size_t comma = 0; comma != std::string::npos; begin = comma + 1) {
    comma = text.find(',', begin);
    words.push_back(text.substr(begin, comma - begin));
  }
  return words;
}

/** Runs a check that names options as the stage's own command does, and says of which stage it speaks. */
template <typename Result>
Result
ofStage(const std::string& group, const std::function<Result()>& body)
{
  try {
    return body();
  } catch (const UsageError& error) {
    throw UsageError("stage " + group + ", options --" + group + "-...: " + error.what());
  }
}

DenoiseParameters
readDenoise(const Options& filter, const CloudScale& scale)
{
  DenoiseParameters parameters = readParameters(filterParameters(), filter, scale, presetNamed(filter.text("preset")));
  parameters.gpf.seed = filter.count("seed");
  return parameters;
}

} // namespace

const std::vector<RunStage>&
runStages()
{
  using P = ConsolidationParameters;
  static const std::vector<RunStage> stages{{"normals", &P::normals, "filter"},
                                            {"filter", &P::filter, "filter"},
                                            {"orient", &P::orient, "orient"},
                                            {"upsample", &P::upsample, "upsample"},
                                            {"mesh", &P::mesh, "mesh"}};
  return stages;
}

std::vector<OptionSpec>
runOptions()
{
  std::vector<OptionSpec> list{{"stages", OptionKind::Text, "A,B,...", "filter,orient,mesh",
                                "of normals, filter, orient, upsample, mesh, which run in this order; normals: estimate them even where "
                                "the file has some"}};
  for (const std::string& group : kGroups)
    for (OptionSpec option : groupOptions(group)) {
      for (const OptionSpec& other : groupOptions(group))
        renameIn(option.help, other.name, group);
      option.name = group + "-" + option.name;
      list.push_back(option);
    }
  return list;
}

Options
stageOptions(const Options& options, const std::string& group)
{
  std::vector<OptionSpec> table = groupOptions(group) + std::vector<OptionSpec>{threadsOption(), seedOption()};
  if (group == "mesh")
    table = meshOptions() + std::vector<OptionSpec>{threadsOption()}; // with --orientation, at its default
  return options.section(group, table);
}

ConsolidationParameters
chosenStages(const Options& options)
{
  ConsolidationParameters chosen;
  std::vector<std::string> names;
  for (const RunStage& stage : runStages()) {
    chosen.*stage.chosen = false;
    names.push_back(stage.name);
  }
  for (const std::string& word : splitAtCommas(options.text("stages"))) {
    const auto stage = std::find_if(runStages().begin(), runStages().end(), [&word](const RunStage& s) { return s.name == word; });
    if (stage == runStages().end()) {
      const std::string nearest = nearestSpelling(word, names);
      throw UsageError("option '--stages': '" + printable(word) + "' is no stage; " +
                       (nearest.empty() ? "" : "did you mean '" + nearest + "'? ") +
                       "allowed: normals, filter, orient, upsample, mesh, with commas between");
    }
    if (chosen.*stage->chosen)
      throw UsageError("option '--stages': '" + word + "' is there twice");
    chosen.*stage->chosen = true;
  }
  return chosen;
}

void
refuseOptionsOfOtherStages(const Options& options, const ConsolidationParameters& chosen)
{
  for (const std::string& group : kGroups) {
    const bool used = std::any_of(runStages().begin(), runStages().end(),
                                  [&](const RunStage& stage) { return stage.group == group && chosen.*stage.chosen; });
    for (const OptionSpec& option : groupOptions(group))
      if (!used && options.given(group + "-" + option.name))
        throw UsageError("--" + group + "-" + option.name + " has no meaning without the stage " + group + "; add it to --stages");
  }
}

void
checkStageOptions(const Options& options, const ConsolidationParameters& chosen)
{
  if (chosen.upsample)
    ofStage<void>("upsample", [&] { checkUpsampleOptions(stageOptions(options, "upsample")); });
  if (chosen.mesh)
    ofStage<void>("mesh", [&] { checkMeshOptions(stageOptions(options, "mesh")); });
}

ConsolidationParameters
readRunParameters(const Options& options, const LoadedCloud& cloud, const CloudScale& scale)
{
  ConsolidationParameters p = chosenStages(options);
  p.number_of_threads = threadCount(options);
  const Options orient = stageOptions(options, "orient");
  p.denoise = ofStage<DenoiseParameters>("filter", [&] { return readDenoise(stageOptions(options, "filter"), scale); });
  p.orientation = readOrientationParameters(orient, cloud);
  p.viewpoint = ofStage<Viewpoint>("orient", [&] { return chosenViewpoint(orient, cloud.file); });
  if (p.upsample)
    p.upsampling = ofStage<UpsampleParameters>("upsample", [&] { return readUpsampleParameters(stageOptions(options, "upsample"), cloud); });
  if (p.mesh)
    p.meshing = readMeshParameters(stageOptions(options, "mesh"), cloud);
  return p;
}

} // namespace pcl_gpf
