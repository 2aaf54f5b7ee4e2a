// SPDX-License-Identifier: BSD-3-Clause
#if defined(PCL_GPF_REPULSION_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PCL_GPF_REPULSION_INL_H_
#undef PCL_GPF_REPULSION_INL_H_
#else
#define PCL_GPF_REPULSION_INL_H_
#endif

#include "pair_loop-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_gpf {
namespace kernels {
namespace HWY_NAMESPACE {

template <class D>
struct RepulsionSum {
  using Real = hn::TFromD<D>;
  using V = hn::Vec<D>;
  const Repulsion<Real>& a;
  D d;
  std::size_t first;
  Lanes3<D> query;
  V radius_sq, scale, weight_sum;
  Lanes3<D> push;

  HWY_INLINE
  RepulsionSum(const Repulsion<Real>& arguments, D tag, std::size_t q)
  : a(arguments)
  , d(tag)
  , first(q)
  , query(loadQueries(tag, arguments.queries, q))
  , radius_sq(loadRadiusSq(tag, arguments.radius, q))
  , scale(hn::Div(hn::Set(tag, -arguments.falloff), radius_sq))
  , weight_sum(hn::Zero(tag))
  , push(zero3(tag))
  {}

  template <class Datum>
  HWY_INLINE void
  pair(Datum datum)
  {
    const Lanes3<D> apart = minus<D>(query, loadDatum(d, a.data, datum));
    const auto inside = hn::Lt(dot<D>(apart, apart), radius_sq);
    if (hn::AllFalse(d, inside))
      return;
    const Lanes3<D> normal = loadDatum(d, a.data_normals, datum);
    Lanes3<D> tangential = apart;
    addScaled<D>(tangential, hn::Neg(dot<D>(apart, normal)), normal);
    const V distance_sq = dot<D>(tangential, tangential);
    // r = 0 has no direction: the point itself, a copy of it, or one straight above.
    const auto counts = hn::And(inside, hn::Gt(distance_sq, hn::Zero(d)));
    const V distance = hn::Max(hn::Sqrt(distance_sq), hn::Set(d, a.shortest));
    V beta = hn::Div(expNonPositive(d, hn::Mul(distance_sq, scale)), distance);
    if (a.data_weight)
      beta = hn::Mul(beta, datum(d, a.data_weight));
    beta = hn::IfThenElseZero(counts, beta);
    weight_sum = hn::Add(weight_sum, beta);
    addScaled<D>(push, beta, tangential);
  }

  HWY_INLINE void
  store()
  {
    hn::StoreU(weight_sum, d, a.weight_sum + first);
    storeQueries(d, a.push, first, push);
  }
};

} // namespace HWY_NAMESPACE
} // namespace kernels
} // namespace pcl_gpf
HWY_AFTER_NAMESPACE();

#endif
