// SPDX-License-Identifier: BSD-3-Clause
#include "benchmarks/ideal_kernels.h"
#include "benchmarks/kernel_arguments.h"

#include <pcl_gpf/core/simd.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

namespace pcl_gpf {
namespace {

using namespace benchmark_arguments;

/** Both loops over the same data, all in reach of all 16 queries. */
template <typename Real, typename Arguments, typename Kernel>
void
expectSameBits(const char* name, Kernel kernel, ideal::Loop<Arguments> loop, Arguments (*make)(Sums<Real>&))
{
  const std::size_t run_offsets[] = {0, 1};
  const Run runs[] = {{kQueryBlock, kQueryBlock + kIdealData}};
  kernels::Candidates candidates;
  candidates.query_count = kQueryBlock;
  candidates.run_offsets = run_offsets;
  candidates.runs = runs;
  candidates.absent = kPoints;
  Sums<Real> real_sums, ideal_sums;
  Arguments arguments = make(real_sums);
  arguments.radius.radius_sq = kEverywhere;
  kernel(candidates, arguments, 0, 1);
  arguments = make(ideal_sums);
  arguments.radius.radius_sq = kEverywhere;
  loop(arguments, kIdealData, 2);
  ASSERT_EQ(real_sums.arrays.size(), ideal_sums.arrays.size());
  bool sums = false;
  for (std::size_t i = 0; i < real_sums.arrays.size(); ++i) {
    const Real* const real = real_sums.arrays[i].data();
    EXPECT_EQ(std::memcmp(real, ideal_sums.arrays[i].data(), kQueryBlock * sizeof(Real)), 0) << name << ", array " << i;
    sums = sums || std::any_of(real, real + kQueryBlock, [](Real value) { return value != 0; });
  }
  EXPECT_TRUE(sums) << name;
}

TEST(IdealKernels, ComputeWhatTheKernelsDoWhereAllDataAreInReach)
{
  const auto available = availableSimdTargets();
  std::size_t count = 0;
  const kernels::KernelTarget* built = kernels::builtTargets(&count);
  for (std::size_t i = 0; i < count; ++i) {
    SCOPED_TRACE(built[i].name);
    const ideal::LoopSet* loops = ideal::loops(built[i].bit);
    ASSERT_NE(loops, nullptr);
    if (std::find(available.begin(), available.end(), built[i].name) == available.end())
      continue;
    const kernels::KernelSet& set = *built[i].set;
    expectSameBits("projection_default", set.projection_float, loops->projection_default, defaultProjection);
    expectSameBits("bilateral_normals", set.bilateral_normals, loops->bilateral_normals, bilateralNormals);
    expectSameBits("moments", set.moments, loops->moments, moments);
    expectSameBits("field_sums", set.field_sums, loops->field_sums, fieldSums);
    expectSameBits("gaussian_sums", set.gaussian_sums_float, loops->gaussian_sums, gaussianSums<float>);
    expectSameBits("repulsion", set.repulsion_float, loops->repulsion, repulsion<float>);
    expectSameBits("projection_paper_double", set.projection_double, loops->projection_paper_double, paperProjection);
    expectSameBits("gaussian_sums_double", set.gaussian_sums_double, loops->gaussian_sums_double, gaussianSums<double>);
    expectSameBits("repulsion_double", set.repulsion_double, loops->repulsion_double, repulsion<double>);
  }
}

} // namespace
} // namespace pcl_gpf
