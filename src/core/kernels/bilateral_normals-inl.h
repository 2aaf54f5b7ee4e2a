// SPDX-License-Identifier: BSD-3-Clause
#if defined(PCL_GPF_BILATERAL_NORMALS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PCL_GPF_BILATERAL_NORMALS_INL_H_
#undef PCL_GPF_BILATERAL_NORMALS_INL_H_
#else
#define PCL_GPF_BILATERAL_NORMALS_INL_H_
#endif

#include "pair_loop-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_gpf {
namespace kernels {
namespace HWY_NAMESPACE {

template <class D, bool kSignInvariant, bool kWeighted>
struct BilateralNormalSum {
  using V = hn::Vec<D>;
  const BilateralNormals& a;
  D d;
  std::size_t first;
  Lanes3<D> query, query_normal;
  V radius_sq, scale;
  Lanes3<D> sum;

  HWY_INLINE
  BilateralNormalSum(const BilateralNormals& arguments, D tag, std::size_t q)
  : a(arguments)
  , d(tag)
  , first(q)
  , query(loadQueries(tag, arguments.queries, q))
  , query_normal(loadQueries(tag, arguments.query_normals, q))
  , radius_sq(loadRadiusSq(tag, arguments.radius, q))
  , scale(hn::Div(hn::Set(tag, -arguments.falloff), radius_sq))
  , sum(zero3(tag))
  {}

  template <class Datum>
  HWY_INLINE void
  pair(Datum datum)
  {
    const Lanes3<D> offset = minus<D>(loadDatum(d, a.data, datum), query);
    const V distance_sq = dot<D>(offset, offset);
    const auto inside = hn::Lt(distance_sq, radius_sq);
    if (skips(d, inside))
      return;
    const Lanes3<D> normal = loadDatum(d, a.data_normals, datum);
    const V cosine = dot<D>(normal, query_normal);
    const V deviation =
        hn::Mul(hn::Sub(hn::Set(d, 1.0f), kSignInvariant ? hn::Abs(cosine) : cosine), hn::Set(d, a.angle_falloff));
    // theta and psi share one exponential.
    const V exponent = hn::Sub(hn::Mul(distance_sq, scale), hn::Mul(deviation, deviation));
    V weight = hn::IfThenElseZero(inside, expNonPositive(d, exponent));
    if (kSignInvariant)
      weight = hn::CopySignToAbs(weight, cosine);
    if (kWeighted)
      weight = hn::Mul(weight, datum(d, a.data_weight));
    addScaled<D>(sum, weight, normal);
  }

  HWY_INLINE void
  store()
  {
    storeQueries(d, a.out, first, sum);
  }
};

} // namespace HWY_NAMESPACE
} // namespace kernels
} // namespace pcl_gpf
HWY_AFTER_NAMESPACE();

#endif
