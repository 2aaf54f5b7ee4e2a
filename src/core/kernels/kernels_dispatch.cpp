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

#include "better_gaps-inl.h"
#include "bilateral_normals-inl.h"
#include "field_sums-inl.h"
#include "gaussian_sums-inl.h"
#include "implicit_sums-inl.h"
#include "near_children-inl.h"
#include "projection-inl.h"
#include "quadric_moments-inl.h"
#include "repulsion-inl.h"
#include "side_sums-inl.h"
#include "steered_moments-inl.h"
#include "widest_gaps-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_gpf {
namespace kernels {
namespace HWY_NAMESPACE {

template <bool kSignInvariant, bool kWeighted>
struct NormalLoops {
  template <class D>
  using Sum = BilateralNormalSum<D, kSignInvariant, kWeighted>;
};

template <class D>
using PlainMomentSum = MomentSum<D, false>;
template <class D>
using WeightedMomentSum = MomentSum<D, true>;

template <typename Real>
static void
gaussianSums(const Candidates& candidates, const GaussianSums<Real>& a, std::size_t begin, std::size_t end)
{
  streamPairs<GaussianSum, Real>(candidates, a, begin, end);
}

/** Chooses the loop that computes only what was asked for. */
template <bool kSymmetric, bool kNormalWeights>
struct ProjectionLoops {
  template <bool kWeighted, bool kDensity, bool kVariance, bool kGentle>
  struct Loop {
    template <class D>
    using Sum = ProjectionSum<D, kSymmetric, kNormalWeights, kWeighted, kDensity, kVariance, kGentle>;
  };

  template <typename Real>
  static void
  run(const Candidates& candidates, const Projection<Real>& a, std::size_t begin, std::size_t end)
  {
    const bool gentle = sizeof(Real) == sizeof(float) && a.falloff <= static_cast<Real>(kGentlest);
    if (a.variance)
      streamPairs<Loop<true, true, true, false>::template Sum, Real>(candidates, a, begin, end);
    else if (a.data_weight && a.data_density)
      streamPairs<Loop<true, true, false, false>::template Sum, Real>(candidates, a, begin, end);
    else if (a.data_weight && gentle)
      streamPairs<Loop<true, false, false, true>::template Sum, Real>(candidates, a, begin, end);
    else if (a.data_weight)
      streamPairs<Loop<true, false, false, false>::template Sum, Real>(candidates, a, begin, end);
    else if (gentle)
      streamPairs<Loop<false, false, false, true>::template Sum, Real>(candidates, a, begin, end);
    else
      streamPairs<Loop<false, false, false, false>::template Sum, Real>(candidates, a, begin, end);
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
  if (a.sign_invariant && a.data_weight)
    streamPairs<NormalLoops<true, true>::Sum, float>(candidates, a, begin, end);
  else if (a.sign_invariant)
    streamPairs<NormalLoops<true, false>::Sum, float>(candidates, a, begin, end);
  else if (a.data_weight)
    streamPairs<NormalLoops<false, true>::Sum, float>(candidates, a, begin, end);
  else
    streamPairs<NormalLoops<false, false>::Sum, float>(candidates, a, begin, end);
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
  if (a.data_weight)
    streamPairs<WeightedMomentSum, float>(candidates, a, begin, end);
  else
    streamPairs<PlainMomentSum, float>(candidates, a, begin, end);
}

template <class D>
using AgreeingFieldSum = FieldSum<D, true>;
template <class D>
using PlainFieldSum = FieldSum<D, false>;

static void
fieldSums(const Candidates& candidates, const FieldSums& a, std::size_t begin, std::size_t end)
{
  if (a.normal_falloff > 0.0f)
    streamPairs<AgreeingFieldSum, float>(candidates, a, begin, end);
  else
    streamPairs<PlainFieldSum, float>(candidates, a, begin, end);
}

static void
sideSums(const Candidates& candidates, const SideSums& a, std::size_t begin, std::size_t end)
{
  if (a.sign_invariant)
    SideLoop<true>(candidates, a).run(begin, end);
  else
    SideLoop<false>(candidates, a).run(begin, end);
}

template <class D>
using PlainSteeredMomentSum = SteeredMomentSum<D, false>;
template <class D>
using WeightedSteeredMomentSum = SteeredMomentSum<D, true>;

static void
steeredMoments(const Candidates& candidates, const SteeredMoments& a, std::size_t begin, std::size_t end)
{
  if (a.data_weight)
    streamPairs<WeightedSteeredMomentSum, float>(candidates, a, begin, end);
  else
    streamPairs<PlainSteeredMomentSum, float>(candidates, a, begin, end);
}

static void
quadricMoments(const Candidates& candidates, const QuadricMoments& a, std::size_t begin, std::size_t end)
{
  streamPairs<QuadricMomentSum, float>(candidates, a, begin, end);
}

static const KernelSet kKernelSet = {gaussianSums<float>, gaussianSums<double>, projection<float>, projection<double>,
                              repulsion<float>,    repulsion<double>,    bilateralNormals,  implicitSums,
                              moments,             fieldSums,            sideSums,            widestGaps,
                              betterGaps,          steeredMoments,       quadricMoments,      nearChildren};

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
