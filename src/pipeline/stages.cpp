// SPDX-License-Identifier: BSD-3-Clause
#include "stages.h"

#include <pcl_gpf/core/errors.h>

#include "gap_stage.h"
#include "scale_parameters.h"
#include "stopwatch.h"

#include <utility>

namespace pcl_gpf {

namespace {

void
estimateMissingNormals(const PlaneNormalsParameters& parameters, Packed& packed)
{
  if (packed.missing_normals.empty())
    return;
  std::vector<std::uint32_t> missing;
  missing.swap(packed.missing_normals); // frees them, too
  if (missing.size() == packed.rows.size()) {
    std::vector<std::uint32_t>().swap(missing);
    estimatePlaneNormals(parameters, *packed.index, packed.normals.view());
    return;
  }
  SoaBuffer estimated(packed.rows.size());
  estimatePlaneNormals(parameters, *packed.index, estimated.view());
  for (const std::uint32_t k : missing) {
    packed.normals.x[k] = estimated.x[k];
    packed.normals.y[k] = estimated.y[k];
    packed.normals.z[k] = estimated.z[k];
  }
}

/** A stage of one of the scales, as the callback sees it. */
std::string
stageName(const char* stage, FilterScale filter_scale)
{
  const char* const prefix = filter_scale == FilterScale::Finest ? "finest " : filter_scale == FilterScale::Fine ? "fine " : "";
  return std::string(prefix) + stage;
}

} // namespace

ProgressCallback
stageOf(std::string name, const StageProgress& progress)
{
  if (!progress)
    return {};
  return [name = std::move(name), &progress](double fraction) { return progress(name, fraction); };
}

Packed
prepare(const DenoiseInput& input, DenoiseParameters& parameters, bool with_remainders, CloudScale& scale, DenoiseResult& result)
{
  validate(parameters);
  Packed packed = packPositions(input, with_remainders, parameters.number_of_threads);
  result.non_finite_points = input.size - packed.rows.size();
  parameters = toLocal(parameters, packed.frame);
  scale = measureScale(*packed.index, parameters.number_of_threads);
  result.scale = {packed.frame.lengthToWorld(scale.spacing), packed.frame.lengthToWorld(scale.noise),
                  packed.frame.lengthToWorld(scale.diagonal), packed.frame.lengthToWorld(scale.h0)};
  return packed;
}

void
makeNormals(const DenoiseInput& input, const DenoiseParameters& parameters, FilterScale filter_scale, Packed& packed,
            const StageProgress& progress, DenoiseResult& result)
{
  Stopwatch watch;
  if (progress && !progress(stageName("normals", filter_scale), 0.0))
    throw Cancelled();
  packNormals(input, packed);
  result.estimated_normals = packed.missing_normals.size();
  estimateMissingNormals(parameters.normals, packed);
  result.seconds_normals += watch.lap();
  filterNormalsBilaterally(parameters.bilateral, *packed.index, packed.normals.view(), {},
                           stageOf(stageName("bilateral", filter_scale), progress));
  result.seconds_bilateral += watch.lap();
}

FilteredCloud
project(const GPFParameters& parameters, FilterScale filter_scale, const std::vector<std::uint32_t>& samples, Packed& packed,
        const StageProgress& progress, std::vector<IterationStats>& iterations)
{
  GPFInput input;
  input.index = packed.index.get();
  if (runsInDouble(parameters))
    input.remainders = packed.remainders.view();
  input.normals = packed.normals.view();
  input.samples = samples.empty() ? nullptr : samples.data();
  input.sample_count = samples.size();
  GPFState state = gpfInit(parameters, input);
  packed.remainders = SoaBuffer(); // the state has its own
  packed.normals = SoaBuffer();
  iterations = gpfRun(state, stageOf(stageName("filter", filter_scale), progress));
  for (IterationStats& stats : iterations) {
    stats.mean_movement = packed.frame.lengthToWorld(stats.mean_movement);
    stats.max_movement = packed.frame.lengthToWorld(stats.max_movement);
  }
  FilteredCloud cloud;
  fillGaps(parameters, packed.frame, stageOf(stageName("gaps", filter_scale), progress), state, cloud);
  cloud.isolated = state.isolated();
  cloud.normals = SoaBuffer(state.size());
  state.normals(cloud.normals.view());
  cloud.displacements = SoaBuffer(state.size());
  state.displacements(cloud.displacements.view());
  return cloud;
}

} // namespace pcl_gpf
