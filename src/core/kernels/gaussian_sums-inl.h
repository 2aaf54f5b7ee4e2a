// SPDX-License-Identifier: BSD-3-Clause
#if defined(PCL_GPF_GAUSSIAN_SUMS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PCL_GPF_GAUSSIAN_SUMS_INL_H_
#undef PCL_GPF_GAUSSIAN_SUMS_INL_H_
#else
#define PCL_GPF_GAUSSIAN_SUMS_INL_H_
#endif

#include "pair_loop-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_gpf {
namespace kernels {
namespace HWY_NAMESPACE {

template <class D>
struct GaussianSum {
  using Real = hn::TFromD<D>;
  using V = hn::Vec<D>;
  const GaussianSums<Real>& a;
  D d;
  std::size_t first;
  Lanes3<D> query;
  V radius_sq, scale, sum;

  HWY_INLINE
  GaussianSum(const GaussianSums<Real>& arguments, D tag, std::size_t q)
  : a(arguments)
  , d(tag)
  , first(q)
  , query(loadQueries(tag, arguments.queries, q))
  , radius_sq(loadRadiusSq(tag, arguments.radius, q))
  , scale(hn::Div(hn::Set(tag, -arguments.falloff), radius_sq))
  , sum(hn::Zero(tag))
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
    sum = hn::Add(sum, hn::IfThenElseZero(inside, expNonPositive(d, hn::Mul(distance_sq, scale))));
  }

  HWY_INLINE void
  store()
  {
    hn::StoreU(sum, d, a.out + first);
  }
};

/** Moments of the data in reach. */
template <class D, bool kWeighted>
struct MomentSum {
  using V = hn::Vec<D>;
  const Moments& a;
  D d;
  std::size_t first;
  Lanes3<D> query;
  V radius_sq, count;
  Lanes3<D> mean, diagonal, mixed;

  HWY_INLINE
  MomentSum(const Moments& arguments, D tag, std::size_t q)
  : a(arguments)
  , d(tag)
  , first(q)
  , query(loadQueries(tag, arguments.queries, q))
  , radius_sq(loadRadiusSq(tag, arguments.radius, q))
  , count(hn::Zero(tag))
  , mean(zero3(tag))
  , diagonal(zero3(tag))
  , mixed(zero3(tag))
  {}

  template <class Datum>
  HWY_INLINE void
  pair(Datum datum)
  {
    Lanes3<D> o = minus<D>(loadDatum(d, a.data, datum), query);
    const auto inside = hn::Lt(dot<D>(o, o), radius_sq);
    if (skips(d, inside))
      return;
    o = {hn::IfThenElseZero(inside, o.x), hn::IfThenElseZero(inside, o.y), hn::IfThenElseZero(inside, o.z)};
    const V weight = kWeighted ? datum(d, a.data_weight) : hn::Set(d, 1.0f);
    count = hn::Add(count, hn::IfThenElseZero(inside, weight));
    const Lanes3<D> w = kWeighted ? Lanes3<D>{hn::Mul(weight, o.x), hn::Mul(weight, o.y), hn::Mul(weight, o.z)} : o;
    mean = {hn::Add(mean.x, w.x), hn::Add(mean.y, w.y), hn::Add(mean.z, w.z)};
    addOuter<D>(w, o, diagonal, mixed);
  }

  HWY_INLINE void
  store()
  {
    const std::size_t place = first - a.first_output;
    hn::StoreU(count, d, a.count + place);
    storeQueries(d, a.mean, place, mean);
    storeQueries(d, a.scatter_diagonal, place, diagonal);
    storeQueries(d, a.scatter_mixed, place, mixed);
  }
};

} // namespace HWY_NAMESPACE
} // namespace kernels
} // namespace pcl_gpf
HWY_AFTER_NAMESPACE();

#endif
