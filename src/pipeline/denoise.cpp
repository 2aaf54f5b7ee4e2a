// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/parallel.h>

#include "cloud_flags.h"
#include "finest_scale.h"
#include "foresight.h"
#include "move_limit.h"
#include "outlier_repeat.h"
#include "packed_cloud.h"
#include "scale_parameters.h"
#include "stages.h"
#include "stopwatch.h"
#include "two_scales.h"

#include <limits>
#include <string>
#include <utility>

namespace pcl_gpf {

namespace {

/** The chain over one packed cloud, at the scales that it needs. */
class Chain {
public:
  Chain(const DenoiseInput& input, const DenoiseParameters& wanted, const StageProgress& progress, DenoiseResult& result)
  : input_(input)
  , progress_(progress)
  , parameters_(wanted)
  , result_(result)
  {
    const Stopwatch watch;
    packed_ = prepare(input, parameters_, runsInDouble(parameters_.gpf), measured_, result);
    result.seconds_normals = watch.elapsed();
    scale_ = measured_;
    scale_.noise *= parameters_.strength;
    samples_ = drawSamples(parameters_.gpf, packed_);
    two_scales_ = filtersTwoScales(parameters_) && scale_.spacing > 0.0;
  }

  /** The whole of it, into the result. */
  void
  run(const DenoiseParameters& wanted)
  {
    const DenoiseParameters p = parametersAt(two_scales_ ? FilterScale::Coarse : FilterScale::Single, parameters_, scale_, packed_.frame, result_);
    refuseExcessiveStages(p, packed_, samples_.empty() ? packed_.rows.size() : samples_.size());
    FilteredCloud cloud = filter(two_scales_ ? FilterScale::Coarse : FilterScale::Single, p, samples_, result_.iterations);
    result_.gap_iterations = std::move(cloud.gap_iterations);
    if (two_scales_)
      refine(p, cloud);
    const Stopwatch watch;
    findFlags(parameters_, measured_, 0.5 * p.gpf.support_radius, packed_, samples_, cloud);
    limitMoves(wanted, scale_.noise, scale_.spacing, packed_.frame, cloud, result_);
    unpack(input_, std::move(packed_), std::move(cloud), samples_, resolveThreads(parameters_.number_of_threads), result_);
    result_.seconds_filter += watch.elapsed();
  }

private:
  FilteredCloud
  filter(FilterScale filter_scale, const DenoiseParameters& p, const std::vector<std::uint32_t>& seeds, std::vector<IterationStats>& iterations)
  {
    makeNormals(input_, p, filter_scale, packed_, progress_, result_);
    const Stopwatch watch;
    FilteredCloud cloud = project(p.gpf, filter_scale, seeds, packed_, progress_, iterations);
    result_.seconds_filter += watch.elapsed();
    return cloud;
  }

  /** What one scale for all takes away: detail, then thin parts; at last what a wider ball than planes can have averages better. */
  void
  refine(const DenoiseParameters& coarse, FilteredCloud& cloud)
  {
    Stopwatch watch;
    const DenoiseParameters fine = parametersAt(FilterScale::Fine, parameters_, scale_, packed_.frame, result_);
    const std::vector<std::uint32_t> places = lostDetail({measured_.noise, measured_.spacing, 0.5 * fine.gpf.support_radius,
                                                          0.5 * coarse.gpf.support_radius, parameters_.number_of_threads},
                                                         packed_, cloud);
    result_.seconds_filter += watch.lap();
    if (!places.empty()) {
      replaceAt(places, filter(FilterScale::Fine, fine, places, result_.fine_iterations), cloud);
      watch.lap();
      steer(fine.steered, packed_, places, cloud, stageOf("fine planes", progress_));
      result_.seconds_filter += watch.lap();
    }
    cloud.fine.assign(packed_.rows.size(), 0);
    for (const std::uint32_t k : places)
      cloud.fine[k] = 1;
    keepThinParts(parameters_, measured_, scale_, packed_,
                  [this](const DenoiseParameters& finest, const std::vector<std::uint32_t>& at) {
                    std::vector<IterationStats> iterations;
                    return filter(FilterScale::Finest, finest, at, iterations);
                  },
                  cloud, result_);
    watch.lap();
    fitSmoothParts(coarse.quadric, packed_, cloud, stageOf("quadrics", progress_));
    result_.seconds_filter += watch.lap();
  }

  const DenoiseInput& input_;
  const StageProgress& progress_;
  DenoiseParameters parameters_; ///< lengths in the normalised frame
  DenoiseResult& result_;
  CloudScale measured_, scale_; ///< as it is, and with the noise times the strength
  Packed packed_;
  std::vector<std::uint32_t> samples_;
  bool two_scales_ = false;
};

/** The chain with every point as data. */
DenoiseResult
denoiseOnce(const DenoiseInput& input, const DenoiseParameters& wanted, const StageProgress& progress)
{
  DenoiseResult result;
  Chain(input, wanted, progress, result).run(wanted);
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
