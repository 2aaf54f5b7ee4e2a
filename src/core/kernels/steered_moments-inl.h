// SPDX-License-Identifier: BSD-3-Clause
#if defined(PCL_GPF_STEERED_MOMENTS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PCL_GPF_STEERED_MOMENTS_INL_H_
#undef PCL_GPF_STEERED_MOMENTS_INL_H_
#else
#define PCL_GPF_STEERED_MOMENTS_INL_H_
#endif

#include "pair_loop-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_gpf {
namespace kernels {
namespace HWY_NAMESPACE {

/** Moments of the data within each query's own ellipsoid. */
template <class D, bool kWeighted>
struct SteeredMomentSum {
  using V = hn::Vec<D>;
  const SteeredMoments& a;
  D d;
  std::size_t first;
  Lanes3<D> query, query_normal, metric_diagonal, metric_mixed;
  V radius_sq, weight_sum;
  Bell<D> symmetry_bell;
  Lanes3<D> mean, shift, diagonal, mixed;

  HWY_INLINE
  SteeredMomentSum(const SteeredMoments& arguments, D tag, std::size_t q)
  : a(arguments)
  , d(tag)
  , first(q)
  , query(loadQueries(tag, arguments.queries, q))
  , query_normal(loadQueries(tag, arguments.query_normals, q))
  , metric_diagonal(loadQueries(tag, arguments.metric_diagonal, q))
  , metric_mixed(loadQueries(tag, arguments.metric_mixed, q))
  , radius_sq(loadRadiusSq(tag, arguments.radius, q))
  , weight_sum(hn::Zero(tag))
  , symmetry_bell(tag, 0.5, arguments.symmetry_falloff)
  , mean(zero3(tag))
  , shift(zero3(tag))
  , diagonal(zero3(tag))
  , mixed(zero3(tag))
  {
    metric_mixed = {hn::Add(metric_mixed.x, metric_mixed.x), hn::Add(metric_mixed.y, metric_mixed.y),
                    hn::Add(metric_mixed.z, metric_mixed.z)};
  }

  template <class Datum>
  HWY_INLINE void
  pair(Datum datum)
  {
    const Lanes3<D> o = minus<D>(loadDatum(d, a.data, datum), query);
    const auto inside = hn::Lt(dot<D>(o, o), radius_sq); // the form itself overflows for padded data
    const V square = hn::Add(hn::Add(hn::Mul(hn::Mul(o.x, o.x), metric_diagonal.x), hn::Mul(hn::Mul(o.y, o.y), metric_diagonal.y)),
                             hn::Mul(hn::Mul(o.z, o.z), metric_diagonal.z));
    const V cross = hn::Add(hn::Add(hn::Mul(hn::Mul(o.y, o.z), metric_mixed.x), hn::Mul(hn::Mul(o.x, o.z), metric_mixed.y)),
                            hn::Mul(hn::Mul(o.x, o.y), metric_mixed.z));
    const V share = hn::Max(hn::Sub(hn::Set(d, 1.0f), hn::Add(square, cross)), hn::Zero(d));
    V weight = hn::IfThenElseZero(inside, hn::Mul(share, share));
    if (hn::AllFalse(d, hn::Gt(weight, hn::Zero(d)))) // more often than not: thin ellipsoids in balls as long as they
      return;
    if (kWeighted)
      weight = hn::Mul(weight, datum(d, a.data_weight));
    weight_sum = hn::Add(weight_sum, weight);
    const Lanes3<D> w = {hn::Mul(weight, o.x), hn::Mul(weight, o.y), hn::Mul(weight, o.z)};
    mean = {hn::Add(mean.x, w.x), hn::Add(mean.y, w.y), hn::Add(mean.z, w.z)};
    addOuter<D>(w, o, diagonal, mixed);
    addScaled<D>(shift, weight, loadDatum(d, a.residuals, datum));
    addHeight(weight, o, loadDatum(d, a.data_normals, datum));
  }

  /** On a curved surface the neighbours' planes lie as far outside as the neighbours lie inside: the halves cancel. */
  HWY_INLINE void
  addHeight(V weight, const Lanes3<D>& o, const Lanes3<D>& normal)
  {
    const V deviation = hn::Sub(hn::Set(d, 1.0f), hn::Abs(dot<D>(normal, query_normal)));
    const V planes = hn::Mul(weight, symmetry_bell(d, hn::Mul(deviation, deviation)));
    addScaled<D>(shift, hn::Sub(weight, planes), o);
    addScaled<D>(shift, hn::Mul(planes, dot<D>(o, normal)), normal);
  }

  HWY_INLINE void
  store()
  {
    const std::size_t place = first - a.first_output;
    hn::StoreU(weight_sum, d, a.weight_sum + place);
    storeQueries(d, a.mean, place, mean);
    storeQueries(d, a.shift, place, shift);
    storeQueries(d, a.scatter_diagonal, place, diagonal);
    storeQueries(d, a.scatter_mixed, place, mixed);
  }
};

} // namespace HWY_NAMESPACE
} // namespace kernels
} // namespace pcl_gpf
HWY_AFTER_NAMESPACE();

#endif
