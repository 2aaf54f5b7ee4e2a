// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/local_frame.h>
#include <pcl_gpf/core/operators/gpf.h>
#include <pcl_gpf/core/sampling.h>
#include <pcl_gpf/core/soa_buffer.h>
#include <pcl_gpf/pipeline/denoise.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

namespace pcl_gpf {

namespace {

/** Finite rows of the input in the normalised frame. */
struct Packed {
  LocalFrame frame;
  std::vector<std::uint32_t> rows;
  SoaBuffer points, remainders; ///< remainders only for the paper's recursion
  SoaBuffer normals;
  std::vector<std::uint32_t> missing_normals; ///< places in `rows`
};

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

Packed
packPositions(const DenoiseInput& input, bool with_remainders)
{
  Packed packed;
  BoundingBox box;
  for (std::size_t i = 0; i < input.size; ++i)
    if (std::isfinite(input.x[i]) && std::isfinite(input.y[i]) && std::isfinite(input.z[i])) {
      packed.rows.push_back(static_cast<std::uint32_t>(i));
      box.add(input.x[i], input.y[i], input.z[i]);
    }
  if (packed.rows.empty())
    throw UnsuitableData("no point has finite coordinates");
  if (!(box.diagonal() > 0.0) || !std::isfinite(box.diagonal()))
    throw UnsuitableData(box.diagonal() > 0.0 ? "the extent of the points is beyond the range of double"
                                              : "all points are identical");
  packed.frame = localFrame(box);
  packed.points = SoaBuffer(packed.rows.size());
  if (with_remainders)
    packed.remainders = SoaBuffer(packed.rows.size());
  const auto one = [&](const double* from, std::size_t axis, AlignedArray<float>& to, AlignedArray<float>& rest) {
    for (std::size_t k = 0; k < packed.rows.size(); ++k) {
      const double local = (from[packed.rows[k]] - packed.frame.origin[axis]) / packed.frame.scale;
      to[k] = static_cast<float>(local);
      if (with_remainders)
        rest[k] = static_cast<float>(local - static_cast<double>(to[k]));
    }
  };
  one(input.x, 0, packed.points.x, packed.remainders.x);
  one(input.y, 1, packed.points.y, packed.remainders.y);
  one(input.z, 2, packed.points.z, packed.remainders.z);
  return packed;
}

/** Takes the unit normals that the input has and notes the rest. */
void
packNormals(const DenoiseInput& input, Packed& packed)
{
  packed.normals = SoaBuffer(packed.rows.size());
  for (std::size_t k = 0; k < packed.rows.size(); ++k) {
    const std::size_t row = packed.rows[k];
    const double x = input.normal_x ? input.normal_x[row] : 0.0, y = input.normal_x ? input.normal_y[row] : 0.0,
                 z = input.normal_x ? input.normal_z[row] : 0.0;
    const double length = std::sqrt(x * x + y * y + z * z);
    if (!(length > 1e-6) || !std::isfinite(length)) {
      packed.missing_normals.push_back(static_cast<std::uint32_t>(k));
      continue;
    }
    packed.normals.x[k] = static_cast<float>(x / length);
    packed.normals.y[k] = static_cast<float>(y / length);
    packed.normals.z[k] = static_cast<float>(z / length);
  }
}

void
estimateMissingNormals(const PlaneNormalsParameters& parameters, Packed& packed)
{
  if (packed.missing_normals.empty())
    return;
  SoaBuffer estimated(packed.rows.size());
  estimatePlaneNormals(parameters, packed.points.view(), estimated.view());
  for (const std::uint32_t k : packed.missing_normals) {
    packed.normals.x[k] = estimated.x[k];
    packed.normals.y[k] = estimated.y[k];
    packed.normals.z[k] = estimated.z[k];
  }
}

bool
isPaperRecursion(const GPFParameters& gpf)
{
  return gpf.posterior_normalization || gpf.variance_update != VarianceUpdate::Fixed;
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
  Stopwatch watch;
  Packed packed = packPositions(input, with_remainders);
  packNormals(input, packed);
  result.non_finite_points = input.size - packed.rows.size();
  result.estimated_normals = packed.missing_normals.size();

  parameters = toLocal(parameters, packed.frame);
  const CloudScale scale = measureScale(packed.points.view(), parameters.number_of_threads);
  result.parameters = estimateParameters(scale, parameters.normals, parameters.bilateral, parameters.gpf);
  for (ParameterOrigin& origin : result.parameters)
    origin.value = packed.frame.lengthToWorld(origin.value);
  result.scale = {packed.frame.lengthToWorld(scale.spacing), packed.frame.lengthToWorld(scale.noise),
                  packed.frame.lengthToWorld(scale.diagonal), packed.frame.lengthToWorld(scale.h0)};

  if (progress && !progress("normals", 0.0))
    throw Cancelled();
  estimateMissingNormals(parameters.normals, packed);
  result.seconds_normals = watch.lap();
  filterNormalsBilaterally(parameters.bilateral, packed.points.view(), packed.normals.view(), {}, stageOf("bilateral", progress));
  result.seconds_bilateral = watch.lap();
  return packed;
}

} // namespace

DenoiseResult
denoise(const DenoiseInput& input, const DenoiseParameters& wanted, const StageProgress& progress)
{
  DenoiseParameters parameters = wanted;
  DenoiseResult result;
  const bool paper = isPaperRecursion(parameters.gpf);
  Packed packed = prepare(input, parameters, paper, progress, result);
  Stopwatch watch;

  const bool sampled = parameters.gpf.sample_ratio < 1.0;
  std::vector<std::uint32_t> samples;
  if (sampled) {
    const auto wanted_count = static_cast<std::size_t>(std::llround(parameters.gpf.sample_ratio * static_cast<double>(packed.rows.size())));
    samples = randomSubset(packed.rows.size(), std::max<std::size_t>(1, wanted_count), parameters.gpf.seed);
  }
  GPFInput gpf_input;
  gpf_input.points = packed.points.view();
  if (paper)
    gpf_input.remainders = packed.remainders.view();
  gpf_input.normals = packed.normals.view();
  gpf_input.samples = sampled ? samples.data() : nullptr;
  gpf_input.sample_count = samples.size();
  GPFState state = gpfInit(parameters.gpf, gpf_input);
  for (SoaBuffer* buffer : {&packed.points, &packed.remainders, &packed.normals}) // the state has its own
    *buffer = SoaBuffer();
  result.iterations = gpfRun(state, stageOf("filter", progress));
  for (IterationStats& stats : result.iterations) {
    stats.mean_movement = packed.frame.lengthToWorld(stats.mean_movement);
    stats.max_movement = packed.frame.lengthToWorld(stats.max_movement);
  }

  SoaBuffer moves(state.size()), normals(state.size());
  state.displacements(moves.view());
  state.normals(normals.view());
  result.isolated = state.isolated();
  result.normal_x.assign(normals.x.begin(), normals.x.end());
  result.normal_y.assign(normals.y.begin(), normals.y.end());
  result.normal_z.assign(normals.z.begin(), normals.z.end());
  result.sample_indices.resize(state.size());
  for (std::size_t k = 0; k < state.size(); ++k)
    result.sample_indices[k] = packed.rows[sampled ? samples[k] : k];
  const auto restore = [&](const double* from, const AlignedArray<float>& move, std::vector<double>& to) {
    to.resize(state.size());
    for (std::size_t k = 0; k < to.size(); ++k)
      to[k] = from[result.sample_indices[k]] + packed.frame.lengthToWorld(static_cast<double>(move[k]));
  };
  restore(input.x, moves.x, result.x);
  restore(input.y, moves.y, result.y);
  restore(input.z, moves.z, result.z);
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
