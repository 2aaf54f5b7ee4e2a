// SPDX-License-Identifier: BSD-3-Clause
#include "ideal_kernels.h"
#include "kernel_arguments.h"
#include "kernel_operations.h"
#include "kernel_report.h"

#include "core/kernels/kernels.h"

#include <pcl_gpf/core/simd.h>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <stdexcept>
#include <string>

/** \file
 * \brief Nanoseconds per in-radius pair of each kernel on each instruction set, on one thread and a noisy block that fits the caches,
 * beside the same arithmetic without radius, candidates and neighbour structure (ideal_kernels.h).
 */
namespace {

using namespace pcl_gpf;
using namespace pcl_gpf::benchmark_arguments;
using namespace pcl_gpf::benchmark_scene;
using benchmark::Counter;
using benchmark::State;

const Counter::Flags kTimePerUnit = Counter::kIsIterationInvariantRate | Counter::kInvert;

template <typename Arguments>
using Kernel = void (*)(const kernels::Candidates&, const Arguments&, std::size_t, std::size_t);

void
countPairs(State& state, double pairs, int operations)
{
  state.counters["pair"] = Counter(pairs, kTimePerUnit);
  state.counters["FLOP/s"] = Counter(pairs * operations, Counter::kIsIterationInvariantRate);
}

/** Repeats the kernel over all queries and reports per in-radius pair. */
template <typename Real, typename Arguments>
void
realLoop(State& state, Kernel<Arguments> kernel, const Arguments& arguments, int operations)
{
  const Scene<Real>& s = scene<Real>();
  const kernels::Candidates candidates = candidatesOf(s.near);
  for (auto _ : state) {
    kernel(candidates, arguments, 0, blockCount(kPoints));
    benchmark::ClobberMemory();
  }
  countPairs(state, s.pairs, operations);
  state.counters["candidate"] = Counter(s.candidates, kTimePerUnit);
  state.counters["candidates/pair"] = s.candidates / s.pairs;
}

/** Repeats the ideal loop over the first points of the scene, which then stay in the first cache. */
template <typename Arguments>
void
idealLoop(State& state, ideal::Loop<Arguments> loop, Arguments arguments, int operations)
{
  constexpr std::size_t kPasses = 64;
  arguments.radius.radius_sq = kEverywhere;
  for (auto _ : state) {
    loop(arguments, kIdealData, kPasses);
    benchmark::ClobberMemory();
  }
  countPairs(state, static_cast<double>(kQueryBlock * kIdealData * kPasses), operations);
}

/** Registers a kernel and, beside it, its ideal loop. \param[in] make arguments, whose output arrays live in the given Sums */
template <typename Real, typename Arguments>
void
add(benchmark_report::RatioReporter& reporter,
    const std::string& name,
    int operations,
    Kernel<Arguments> kernel,
    ideal::Loop<Arguments> loop,
    Arguments (*make)(Sums<Real>&))
{
  reporter.add(name, operations);
  benchmark::RegisterBenchmark(name.c_str(), [=](State& state) {
    Sums<Real> out;
    realLoop<Real>(state, kernel, make(out), operations);
  })->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark(reporter.idealName(name).c_str(), [=](State& state) {
    Sums<Real> out;
    idealLoop(state, loop, make(out), operations);
  })->Unit(benchmark::kMillisecond);
}

void
addAll(benchmark_report::RatioReporter& reporter, const kernels::KernelTarget& target)
{
  using namespace benchmark_operations;
  const kernels::KernelSet& set = *target.set;
  const ideal::LoopSet* loops = ideal::loops(target.bit);
  if (!loops)
    throw std::logic_error(std::string("no ideal loops for ") + target.name);
  const std::string end = std::string("/") + target.name;
  add(reporter, "projection_default" + end, kProjectionDefault, set.projection_float, loops->projection_default, defaultProjection);
  add(reporter, "bilateral_normals" + end, kBilateralNormals, set.bilateral_normals, loops->bilateral_normals, bilateralNormals);
  add(reporter, "moments" + end, kMoments, set.moments, loops->moments, moments);
  add(reporter, "field_sums" + end, kFieldSums, set.field_sums, loops->field_sums, fieldSums);
  add(reporter, "gaussian_sums" + end, kGaussianSums, set.gaussian_sums_float, loops->gaussian_sums, gaussianSums<float>);
  add(reporter, "repulsion" + end, kRepulsion, set.repulsion_float, loops->repulsion, repulsion<float>);
  add(reporter, "projection_paper_double" + end, kProjectionPaperDouble, set.projection_double, loops->projection_paper_double,
      paperProjection);
  add(reporter, "gaussian_sums_double" + end, kGaussianSumsDouble, set.gaussian_sums_double, loops->gaussian_sums_double,
      gaussianSums<double>);
  add(reporter, "repulsion_double" + end, kRepulsionDouble, set.repulsion_double, loops->repulsion_double, repulsion<double>);
}

} // namespace

int
main(int argc, char** argv)
{
  const auto available = availableSimdTargets();
  std::size_t count = 0;
  const kernels::KernelTarget* built = kernels::builtTargets(&count);
  benchmark_report::RatioReporter reporter;
  for (std::size_t i = 0; i < count; ++i)
    if (std::find(available.begin(), available.end(), built[i].name) != available.end())
      addAll(reporter, built[i]);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv))
    return 2;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  benchmark::Shutdown();
  return 0;
}
