// SPDX-License-Identifier: BSD-3-Clause
#if defined(PCL_GPF_FIELD_SUMS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PCL_GPF_FIELD_SUMS_INL_H_
#undef PCL_GPF_FIELD_SUMS_INL_H_
#else
#define PCL_GPF_FIELD_SUMS_INL_H_
#endif

#include "pair_loop-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_gpf {
namespace kernels {
namespace HWY_NAMESPACE {

/** Sums of two fields over the data in reach, weighted by the agreement of normals. */
template <class D, bool kNormals>
struct FieldSum {
  using V = hn::Vec<D>;
  const FieldSums& a;
  D d;
  std::size_t first;
  Lanes3<D> query, query_normal;
  Bell<D> agreement;
  V sign, radius_sq, count, weight_sum, first_sum, second_sum;

  HWY_INLINE
  FieldSum(const FieldSums& arguments, D tag, std::size_t q)
  : a(arguments)
  , d(tag)
  , first(q)
  , query(loadQueries(tag, arguments.queries, q))
  , query_normal(kNormals ? loadQueries(tag, arguments.query_normals, q) : zero3(tag))
  , agreement(tag, 1.0, arguments.normal_falloff)
  , sign(hn::Set(tag, arguments.along_normals ? -0.0f : 0.0f))
  , radius_sq(loadRadiusSq(tag, arguments.radius, q))
  , count(hn::Zero(tag))
  , weight_sum(hn::Zero(tag))
  , first_sum(hn::Zero(tag))
  , second_sum(hn::Zero(tag))
  {}

  template <class Datum>
  HWY_INLINE void
  pair(Datum datum)
  {
    const Lanes3<D> offset = minus<D>(loadDatum(d, a.data, datum), query);
    const auto inside = hn::Lt(dot<D>(offset, offset), radius_sq);
    V weight = hn::IfThenElseZero(inside, hn::Set(d, 1.0f));
    count = hn::Add(count, weight);
    V first_value = datum(d, a.first_field);
    if (kNormals) {
      const V cosine = dot<D>(loadDatum(d, a.data_normals, datum), query_normal);
      const V deviation = hn::Sub(hn::Set(d, 1.0f), hn::Abs(cosine));
      weight = hn::Mul(weight, agreement(d, hn::Mul(deviation, deviation)));
      first_value = hn::Xor(first_value, hn::And(cosine, sign));
    }
    weight_sum = hn::Add(weight_sum, weight);
    first_sum = mulAdd(weight, first_value, first_sum);
    second_sum = mulAdd(weight, datum(d, a.second_field), second_sum);
  }

  HWY_INLINE void
  store()
  {
    hn::StoreU(count, d, a.count + first);
    hn::StoreU(weight_sum, d, a.weight_sum + first);
    hn::StoreU(first_sum, d, a.first_sum + first);
    hn::StoreU(second_sum, d, a.second_sum + first);
  }
};

} // namespace HWY_NAMESPACE
} // namespace kernels
} // namespace pcl_gpf
HWY_AFTER_NAMESPACE();

#endif
