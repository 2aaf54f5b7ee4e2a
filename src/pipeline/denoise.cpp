// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/parallel.h>

#include "packed_cloud.h"

#include <chrono>
#include <limits>
#include <utility>

namespace pcl_gpf {

namespace {

class Stopwatch {
public:
  double
  lap()
  {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return seconds;
  }

private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

void
estimateMissingNormals(const PlaneNormalsParameters& parameters, Packed& packed)
{
  if (packed.missing_normals.empty())
    return;
  std::vector<std::uint32_t> missing;
  missing.swap(packed.missing_normals); // frees them, too
  if (missing.size() == packed.rows.size()) {
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

/** Lengths of the parameters from cloud units into the normalised frame. */
DenoiseParameters
toLocal(DenoiseParameters p, const LocalFrame& frame)
{
  p.normals.radius = frame.lengthToLocal(p.normals.radius);
  p.bilateral.radius = frame.lengthToLocal(p.bilateral.radius);
  p.gpf.support_radius = frame.lengthToLocal(p.gpf.support_radius);
  p.normals.number_of_threads = p.bilateral.number_of_threads = p.gpf.number_of_threads = p.number_of_threads;
  return p;
}

ProgressCallback
stageOf(const char* name, const StageProgress& progress)
{
  if (!progress)
    return {};
  return [name, &progress](double fraction) { return progress(name, fraction); };
}

/** Everything before GPF: packs, estimates parameters, makes normals. */
Packed
prepare(const DenoiseInput& input, DenoiseParameters& parameters, bool with_remainders, const StageProgress& progress,
        DenoiseResult& result)
{
  validate(parameters.gpf);
  validate(parameters.bilateral);
  validate(parameters.normals);
  Stopwatch watch;
  Packed packed = packPositions(input, with_remainders, parameters.number_of_threads);
  packNormals(input, packed);
  result.non_finite_points = input.size - packed.rows.size();
  result.estimated_normals = packed.missing_normals.size();

  parameters = toLocal(parameters, packed.frame);
  const CloudScale scale = measureScale(*packed.index, parameters.number_of_threads);
  result.parameters = estimateParameters(scale, parameters.normals, parameters.bilateral, parameters.gpf);
  for (ParameterOrigin& origin : result.parameters)
    origin.value = packed.frame.lengthToWorld(origin.value);
  result.scale = {packed.frame.lengthToWorld(scale.spacing), packed.frame.lengthToWorld(scale.noise),
                  packed.frame.lengthToWorld(scale.diagonal), packed.frame.lengthToWorld(scale.h0)};

  if (progress && !progress("normals", 0.0))
    throw Cancelled();
  estimateMissingNormals(parameters.normals, packed);
  result.seconds_normals = watch.lap();
  filterNormalsBilaterally(parameters.bilateral, *packed.index, packed.normals.view(), {}, stageOf("bilateral", progress));
  result.seconds_bilateral = watch.lap();
  return packed;
}

} // namespace

DenoiseResult
denoise(const DenoiseInput& input, const DenoiseParameters& wanted, const StageProgress& progress)
{
  DenoiseParameters parameters = wanted;
  DenoiseResult result;
  const bool exact = runsInDouble(parameters.gpf);
  Packed packed = prepare(input, parameters, exact, progress, result);
  Stopwatch watch;
  const std::vector<std::uint32_t> samples = drawSamples(parameters.gpf, packed);
  GPFInput gpf_input;
  gpf_input.index = packed.index.get();
  if (exact)
    gpf_input.remainders = packed.remainders.view();
  gpf_input.normals = packed.normals.view();
  gpf_input.samples = samples.empty() ? nullptr : samples.data();
  gpf_input.sample_count = samples.size();
  GPFState state = gpfInit(parameters.gpf, gpf_input);
  packed.remainders = SoaBuffer(); // the state has its own
  packed.normals = SoaBuffer();
  result.iterations = gpfRun(state, stageOf("filter", progress));
  for (IterationStats& stats : result.iterations) {
    stats.mean_movement = packed.frame.lengthToWorld(stats.mean_movement);
    stats.max_movement = packed.frame.lengthToWorld(stats.max_movement);
  }
  unpack(input, std::move(packed), std::move(state), samples, resolveThreads(parameters.number_of_threads), result);
  result.seconds_filter = watch.lap();
  return result;
}

DenoiseResult
denoiseNormals(const DenoiseInput& input, const DenoiseParameters& wanted, const StageProgress& progress)
{
  DenoiseParameters parameters = wanted;
  DenoiseResult result;
  const Packed packed = prepare(input, parameters, false, progress, result);
  const float missing = std::numeric_limits<float>::quiet_NaN();
  const auto spread = [&](const AlignedArray<float>& from, std::vector<float>& to) {
    to.assign(input.size, missing);
    for (std::size_t k = 0; k < packed.rows.size(); ++k)
      to[packed.rows[k]] = from[k];
  };
  spread(packed.normals.x, result.normal_x);
  spread(packed.normals.y, result.normal_y);
  spread(packed.normals.z, result.normal_z);
  return result;
}

} // namespace pcl_gpf
