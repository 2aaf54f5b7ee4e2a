// SPDX-License-Identifier: BSD-3-Clause
#include "kernels.h"

// SSSE3 and the last AVX-512 additions would only repeat their neighbours.
#ifdef PCL_GPF_FEW_TARGETS // sanitizer builds, for which every one costs a minute of compiling
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL | HWY_AVX3 | HWY_SSE4)
#else
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#endif
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/kernels/kernels_dispatch.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include "bilateral_normals-inl.h"
#include "gaussian_sums-inl.h"
#include "implicit_sums-inl.h"
#include "projection-inl.h"
#include "repulsion-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_gpf {
namespace kernels {
namespace HWY_NAMESPACE {

template <class D>
using SignInvariantNormalSum = BilateralNormalSum<D, true>;
template <class D>
using OrientedNormalSum = BilateralNormalSum<D, false>;

template <typename Real>
static void
gaussianSums(const Candidates& candidates, const GaussianSums<Real>& a, std::size_t begin, std::size_t end)
{
  streamPairs<GaussianSum, Real>(candidates, a, begin, end);
}

/** Chooses the loop that computes only what was asked for. */
template <bool kSymmetric, bool kNormalWeights>
struct ProjectionLoops {
  template <class D>
  using Plain = ProjectionSum<D, kSymmetric, kNormalWeights, false, false, false>;
  template <class D>
  using Gentle = ProjectionSum<D, kSymmetric, kNormalWeights, false, false, true>;
  template <class D>
  using Weighted = ProjectionSum<D, kSymmetric, kNormalWeights, true, false, false>;
  template <class D>
  using WithVariance = ProjectionSum<D, kSymmetric, kNormalWeights, true, true, false>;

  template <typename Real>
  static void
  run(const Candidates& candidates, const Projection<Real>& a, std::size_t begin, std::size_t end)
  {
    if (a.variance)
      streamPairs<WithVariance, Real>(candidates, a, begin, end);
    else if (a.data_weight)
      streamPairs<Weighted, Real>(candidates, a, begin, end);
    else if (sizeof(Real) == sizeof(float) && a.falloff <= Real(1))
      streamPairs<Gentle, Real>(candidates, a, begin, end);
    else
      streamPairs<Plain, Real>(candidates, a, begin, end);
  }
};

template <typename Real>
static void
projection(const Candidates& candidates, const Projection<Real>& a, std::size_t begin, std::size_t end)
{
  if (a.symmetric && a.normal_weights)
    ProjectionLoops<true, true>::run(candidates, a, begin, end);
  else if (a.symmetric)
    ProjectionLoops<true, false>::run(candidates, a, begin, end);
  else if (a.normal_weights)
    ProjectionLoops<false, true>::run(candidates, a, begin, end);
  else
    ProjectionLoops<false, false>::run(candidates, a, begin, end);
}

template <typename Real>
static void
repulsion(const Candidates& candidates, const Repulsion<Real>& a, std::size_t begin, std::size_t end)
{
  streamPairs<RepulsionSum, Real>(candidates, a, begin, end);
}

static void
bilateralNormals(const Candidates& candidates, const BilateralNormals& a, std::size_t begin, std::size_t end)
{
  if (a.sign_invariant)
    streamPairs<SignInvariantNormalSum, float>(candidates, a, begin, end);
  else
    streamPairs<OrientedNormalSum, float>(candidates, a, begin, end);
}

template <class D>
using PlainImplicitSum = ImplicitSum<D, false>;
template <class D>
using RobustImplicitSum = ImplicitSum<D, true>;

static void
implicitSums(const Candidates& candidates, const ImplicitSums& a, std::size_t begin, std::size_t end)
{
  if (a.robust)
    streamPairs<RobustImplicitSum, float>(candidates, a, begin, end);
  else
    streamPairs<PlainImplicitSum, float>(candidates, a, begin, end);
}

static void
moments(const Candidates& candidates, const Moments& a, std::size_t begin, std::size_t end)
{
  streamPairs<MomentSum, float>(candidates, a, begin, end);
}

static const KernelSet kKernelSet = {gaussianSums<float>, gaussianSums<double>, projection<float>, projection<double>,
                              repulsion<float>,    repulsion<double>,    bilateralNormals,  implicitSums,
                              moments};

} // namespace HWY_NAMESPACE
} // namespace kernels
} // namespace pcl_gpf
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pcl_gpf {
namespace kernels {

const KernelTarget*
builtTargets(std::size_t* count)
{
  static const KernelTarget targets[] = {
#if HWY_TARGETS & HWY_AVX3
      {"avx512", HWY_AVX3, &N_AVX3::kKernelSet},
#endif
#if HWY_TARGETS & HWY_AVX2
      {"avx2", HWY_AVX2, &N_AVX2::kKernelSet},
#endif
#if HWY_TARGETS & HWY_SSE4
      {"sse4", HWY_SSE4, &N_SSE4::kKernelSet},
#endif
#if HWY_TARGETS & HWY_NEON
      {"neon", HWY_NEON, &N_NEON::kKernelSet},
#endif
#if HWY_TARGETS & HWY_EMU128
      {"scalar", HWY_EMU128, &N_EMU128::kKernelSet},
#elif HWY_TARGETS & HWY_SCALAR
      {"scalar", HWY_SCALAR, &N_SCALAR::kKernelSet},
#endif
  };
  *count = sizeof(targets) / sizeof(targets[0]);
  return targets;
}

} // namespace kernels
} // namespace pcl_gpf
#endif
