// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/parallel.h>

#include "cloud_flags.h"
#include "finest_scale.h"
#include "foresight.h"
#include "gap_stage.h"
#include "move_limit.h"
#include "outlier_repeat.h"
#include "packed_cloud.h"
#include "scale_parameters.h"
#include "stopwatch.h"
#include "two_scales.h"

#include <limits>
#include <string>
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

ProgressCallback
stageOf(std::string name, const StageProgress& progress)
{
  if (!progress)
    return {};
  return [name = std::move(name), &progress](double fraction) { return progress(name, fraction); };
}

/** A stage of one of the scales, as the callback sees it. */
std::string
stageName(const char* stage, FilterScale filter_scale)
{
  const char* const prefix = filter_scale == FilterScale::Finest ? "finest " : filter_scale == FilterScale::Fine ? "fine " : "";
  return std::string(prefix) + stage;
}

/** Everything that does not depend on lengths: packs, measures. */
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

/** The normals that the input has, the others from plane fits, all of them filtered. */
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

/** GPF on the packed points and normals, which are given up. */
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

/** The chain with every point as data. */
DenoiseResult
denoiseOnce(const DenoiseInput& input, const DenoiseParameters& wanted, const StageProgress& progress)
{
  DenoiseParameters parameters = wanted;
  DenoiseResult result;
  CloudScale scale;
  Stopwatch watch;
  Packed packed = prepare(input, parameters, runsInDouble(parameters.gpf), scale, result);
  result.seconds_normals = watch.lap();
  const CloudScale measured = scale;
  scale.noise *= parameters.strength;
  const std::vector<std::uint32_t> samples = drawSamples(parameters.gpf, packed);
  const auto filterAt = [&](FilterScale filter_scale, const DenoiseParameters& p, const std::vector<std::uint32_t>& seeds,
                            std::vector<IterationStats>& iterations) {
    makeNormals(input, p, filter_scale, packed, progress, result);
    const Stopwatch filter_watch;
    FilteredCloud cloud = project(p.gpf, filter_scale, seeds, packed, progress, iterations);
    result.seconds_filter += filter_watch.elapsed();
    return cloud;
  };
  const bool two_scales = filtersTwoScales(parameters) && scale.spacing > 0.0;
  const FilterScale first = two_scales ? FilterScale::Coarse : FilterScale::Single;
  const DenoiseParameters p = parametersAt(first, parameters, scale, packed.frame, result);
  refuseExcessiveStages(p, packed, samples.empty() ? packed.rows.size() : samples.size());
  FilteredCloud cloud = filterAt(first, p, samples, result.iterations);
  result.gap_iterations = std::move(cloud.gap_iterations);
  watch.lap();
  if (two_scales) {
    const DenoiseParameters fine = parametersAt(FilterScale::Fine, parameters, scale, packed.frame, result);
    const std::vector<std::uint32_t> places =
        lostDetail({measured.noise, measured.spacing, 0.5 * fine.gpf.support_radius, 0.5 * p.gpf.support_radius, parameters.number_of_threads},
                   packed, cloud);
    result.seconds_filter += watch.lap();
    if (!places.empty()) {
      replaceAt(places, filterAt(FilterScale::Fine, fine, places, result.fine_iterations), cloud);
      watch.lap();
      steer(fine.steered, packed, places, cloud, stageOf("fine planes", progress));
      result.seconds_filter += watch.lap();
    }
    fitSmoothParts(p.quadric, packed, cloud, stageOf("quadrics", progress));
    result.seconds_filter += watch.lap();
    cloud.fine.assign(packed.rows.size(), 0);
    for (const std::uint32_t k : places)
      cloud.fine[k] = 1;
    const auto filter_finest = [&](const DenoiseParameters& finest, const std::vector<std::uint32_t>& at) {
      std::vector<IterationStats> iterations;
      return filterAt(FilterScale::Finest, finest, at, iterations);
    };
    keepThinParts(parameters, measured, scale, packed, filter_finest, cloud, result);
    watch.lap();
  }
  findFlags(parameters, measured, 0.5 * p.gpf.support_radius, packed, samples, cloud);
  limitMoves(wanted, scale.noise, scale.spacing, packed.frame, cloud, result);
  unpack(input, std::move(packed), std::move(cloud), samples, resolveThreads(parameters.number_of_threads), result);
  result.seconds_filter += watch.lap();
  return result;
}

} // namespace

void
validate(const DenoiseParameters& parameters)
{
  validate(parameters.gpf);
  validate(parameters.bilateral);
  validate(parameters.normals);
  validate(parameters.steered);
  validate(parameters.quadric);
  if (!(parameters.max_move >= 0.0))
    throw InvalidParameter("max_move must be >= 0, 0 = estimated");
  if (!(parameters.strength >= 0.5 && parameters.strength <= 2.0))
    throw InvalidParameter("strength must be within 0.5 .. 2");
}

DenoiseResult
denoise(const DenoiseInput& input, const DenoiseParameters& parameters, const StageProgress& progress)
{
  DenoiseResult result = denoiseOnce(input, parameters, progress);
  if (!outliersDisturb(parameters, input, result))
    return result;
  StageProgress again;
  if (progress)
    again = [&progress](const std::string& stage, double fraction) { return progress("repeated " + stage, fraction); };
  return repeatWithoutOutliers(input, std::move(result),
                               [&](const DenoiseInput& part) { return denoiseOnce(part, parameters, again); });
}

DenoiseResult
denoiseNormals(const DenoiseInput& input, const DenoiseParameters& wanted, const StageProgress& progress)
{
  DenoiseParameters parameters = wanted;
  DenoiseResult result;
  CloudScale scale;
  Packed packed = prepare(input, parameters, false, scale, result);
  const DenoiseParameters p = parametersAt(FilterScale::Single, parameters, scale, packed.frame, result);
  refuseExcessiveStages(p, packed, 0);
  makeNormals(input, p, FilterScale::Single, packed, progress, result);
  spreadNormals(packed, input.size, result.normal_x, result.normal_y, result.normal_z);
  return result;
}

} // namespace pcl_gpf
