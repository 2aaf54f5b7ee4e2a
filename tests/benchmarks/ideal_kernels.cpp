// SPDX-License-Identifier: BSD-3-Clause
#include "benchmarks/ideal_kernels.h"

// As kernels_dispatch.cpp.
#ifdef PCL_GPF_FEW_TARGETS
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL | HWY_AVX3 | HWY_SSE4)
#else
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#endif
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "benchmarks/ideal_kernels.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

// What is below the accumulators is used as it is.
#include "core/kernels/pair_loop-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_gpf {
namespace ideal {
namespace HWY_NAMESPACE {

/** Highway's operations, but for the two that apply the radius: every pair is inside, and the compiler drops the comparison. */
namespace without_mask {

using namespace hwy::HWY_NAMESPACE;

template <class D, class Mask>
HWY_INLINE bool
AllFalse(D, Mask)
{
  return false;
}

template <class Mask, class V>
HWY_INLINE V
IfThenElseZero(Mask, V value)
{
  return value;
}

} // namespace without_mask

using namespace kernels;
using namespace kernels::HWY_NAMESPACE;
namespace hn = without_mask; // found before the name in kernels, as is the next

template <class D, class Mask>
HWY_INLINE bool
skips(D, Mask)
{
  return false;
}

} // namespace HWY_NAMESPACE
} // namespace ideal
} // namespace pcl_gpf
HWY_AFTER_NAMESPACE();

// The accumulators' own text, in a namespace where `hn` is without_mask.
#define kernels ideal
#include "core/kernels/bilateral_normals-inl.h"
#include "core/kernels/field_sums-inl.h"
#include "core/kernels/gaussian_sums-inl.h"
#include "core/kernels/projection-inl.h"
#include "core/kernels/repulsion-inl.h"
#undef kernels

HWY_BEFORE_NAMESPACE();
namespace pcl_gpf {
namespace ideal {
namespace HWY_NAMESPACE {

// The loops that the benchmark's arguments choose in kernels_dispatch.cpp.
template <class D>
using DefaultProjection = ProjectionSum<D, true, true, false, false, false, true>;
template <class D>
using PaperProjection = ProjectionSum<D, false, false, true, true, true, false>;
template <class D>
using SignInvariantNormals = BilateralNormalSum<D, true, false>;
template <class D>
using PlainMoments = MomentSum<D, false>;
template <class D>
using AgreeingFields = FieldSum<D, true>;

template <template <class> class Sum, typename Real, class Arguments>
static void
run(const Arguments& arguments, std::size_t data_count, std::size_t passes)
{
  using D = QueryTag<Real>;
  const D d;
  for (std::size_t pass = 0; pass < passes; ++pass)
    for (std::size_t first = 0; first < kQueryBlock; first += hwy::HWY_NAMESPACE::Lanes(d)) {
      Sum<D> sum(arguments, d, first);
      SharedDatum<D, 1> datum = {};
      for (datum.index[0] = kQueryBlock; datum.index[0] < kQueryBlock + data_count; ++datum.index[0])
        sum.pair(datum);
      sum.store();
    }
}

static const LoopSet kLoops = {run<DefaultProjection, float>, run<SignInvariantNormals, float>, run<PlainMoments, float>,
                               run<AgreeingFields, float>,    run<GaussianSum, float>,          run<RepulsionSum, float>,
                               run<PaperProjection, double>,  run<GaussianSum, double>,         run<RepulsionSum, double>};

} // namespace HWY_NAMESPACE
} // namespace ideal
} // namespace pcl_gpf
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pcl_gpf::ideal {

const LoopSet*
loops(std::int64_t bit)
{
  switch (bit) {
#if HWY_TARGETS & HWY_AVX3
  case HWY_AVX3: return &N_AVX3::kLoops;
#endif
#if HWY_TARGETS & HWY_AVX2
  case HWY_AVX2: return &N_AVX2::kLoops;
#endif
#if HWY_TARGETS & HWY_SSE4
  case HWY_SSE4: return &N_SSE4::kLoops;
#endif
#if HWY_TARGETS & HWY_NEON
  case HWY_NEON: return &N_NEON::kLoops;
#endif
#if HWY_TARGETS & HWY_EMU128
  case HWY_EMU128: return &N_EMU128::kLoops;
#elif HWY_TARGETS & HWY_SCALAR
  case HWY_SCALAR: return &N_SCALAR::kLoops;
#endif
  default: return nullptr;
  }
}

} // namespace pcl_gpf::ideal
#endif
