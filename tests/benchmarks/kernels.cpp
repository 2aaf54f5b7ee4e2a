// SPDX-License-Identifier: BSD-3-Clause
#include "kernel_scene.h"

#include "core/kernels/kernels.h"

#include <pcl_gpf/core/simd.h>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <string>

/** \file
 * \brief Nanoseconds per in-radius pair of each kernel on each instruction set, on one thread and a noisy block that fits the caches.
 */
namespace {

using namespace pcl_gpf;
using namespace pcl_gpf::benchmark_scene;
using benchmark::State;

/** Repeats the kernel over all queries and reports per pair. */
template <typename Real, typename Arguments>
void
loop(State& state, void (*kernel)(const kernels::Candidates&, const Arguments&, std::size_t, std::size_t), const Arguments& arguments)
{
  const Scene<Real>& s = scene<Real>();
  const kernels::Candidates candidates = candidatesOf(s.near);
  for (auto _ : state) {
    kernel(candidates, arguments, 0, blockCount(kPoints));
    benchmark::ClobberMemory();
  }
  const auto time_per_unit = benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert;
  state.counters["pair"] = benchmark::Counter(s.pairs, time_per_unit);
  state.counters["candidate"] = benchmark::Counter(s.candidates, time_per_unit);
  state.counters["candidates/pair"] = s.candidates / s.pairs;
}

template <typename Real>
kernels::Radius<Real>
radius()
{
  const double r = scene<Real>().radius;
  return {static_cast<Real>(r * r), nullptr};
}

template <typename Real>
kernels::GaussianSums<Real>
gaussianSums(Sums<Real>& out)
{
  kernels::GaussianSums<Real> a;
  a.queries = a.data = scene<Real>().points.vectors();
  a.radius = radius<Real>();
  a.falloff = 1;
  a.out = out.one();
  return a;
}

/** \param[in] paper Algorithm 1's term with the sums of eq. 11, else the default mode's */
template <typename Real>
kernels::Projection<Real>
projection(Sums<Real>& out, bool paper)
{
  const Scene<Real>& s = scene<Real>();
  kernels::Projection<Real> a;
  a.queries = a.data = s.points.vectors();
  a.query_normals = a.data_normals = s.normals.vectors();
  a.radius = radius<Real>();
  a.falloff = Real(0.5);
  a.symmetric = a.normal_weights = !paper;
  a.symmetry_falloff = Real(7.46);
  a.normal_falloff = Real(3.41);
  a.normal_floor = Real(0.15);
  a.weight_sum = out.one();
  a.pull = out.three();
  a.variance = paper;
  if (paper) {
    a.data_weight = a.data_density = s.ones.data();
    a.posterior_sum = out.one();
    a.residual_sq = out.one();
    a.cross = out.three();
    a.scatter_diagonal = out.three();
    a.scatter_mixed = out.three();
  }
  return a;
}

template <typename Real>
kernels::Repulsion<Real>
repulsion(Sums<Real>& out)
{
  const Scene<Real>& s = scene<Real>();
  kernels::Repulsion<Real> a;
  a.queries = a.data = s.points.vectors();
  a.data_normals = s.normals.vectors();
  a.radius = radius<Real>();
  a.falloff = 4;
  a.shortest = Real(1e-6);
  a.push = out.three();
  a.weight_sum = out.one();
  return a;
}

kernels::BilateralNormals
bilateralNormals(Sums<float>& out)
{
  const Scene<float>& s = scene<float>();
  kernels::BilateralNormals a;
  a.queries = a.data = s.points.vectors();
  a.query_normals = a.data_normals = s.normals.vectors();
  a.radius = radius<float>();
  a.angle_falloff = 7.46f;
  a.out = out.three();
  return a;
}

kernels::Moments
moments(Sums<float>& out)
{
  kernels::Moments a;
  a.queries = a.data = scene<float>().points.vectors();
  a.radius = radius<float>();
  a.count = out.one();
  a.mean = out.three();
  a.scatter_diagonal = out.three();
  a.scatter_mixed = out.three();
  return a;
}

template <typename Real, typename Kernel, typename Make>
void
add(const std::string& name, Kernel kernel, const Make& make)
{
  benchmark::RegisterBenchmark(name.c_str(), [kernel, make](State& state) {
    Sums<Real> out;
    loop<Real>(state, kernel, make(out));
  })->Unit(benchmark::kMillisecond);
}

void
addAll(const kernels::KernelTarget& target)
{
  const kernels::KernelSet& set = *target.set;
  const std::string suffix = std::string("/") + target.name;
  add<float>("projection_default" + suffix, set.projection_float, [](Sums<float>& out) { return projection<float>(out, false); });
  add<float>("bilateral_normals" + suffix, set.bilateral_normals, bilateralNormals);
  add<float>("moments" + suffix, set.moments, moments);
  add<float>("gaussian_sums" + suffix, set.gaussian_sums_float, gaussianSums<float>);
  add<float>("repulsion" + suffix, set.repulsion_float, repulsion<float>);
  add<double>("projection_paper_double" + suffix, set.projection_double, [](Sums<double>& out) { return projection<double>(out, true); });
  add<double>("gaussian_sums_double" + suffix, set.gaussian_sums_double, gaussianSums<double>);
  add<double>("repulsion_double" + suffix, set.repulsion_double, repulsion<double>);
}

} // namespace

int
main(int argc, char** argv)
{
  const auto available = availableSimdTargets();
  std::size_t count = 0;
  const kernels::KernelTarget* built = kernels::builtTargets(&count);
  for (std::size_t i = 0; i < count; ++i)
    if (std::find(available.begin(), available.end(), built[i].name) != available.end())
      addAll(built[i]);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv))
    return 2;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
