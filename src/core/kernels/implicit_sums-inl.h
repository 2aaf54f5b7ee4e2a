// SPDX-License-Identifier: BSD-3-Clause
#if defined(PCL_GPF_IMPLICIT_SUMS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PCL_GPF_IMPLICIT_SUMS_INL_H_
#undef PCL_GPF_IMPLICIT_SUMS_INL_H_
#else
#define PCL_GPF_IMPLICIT_SUMS_INL_H_
#endif

#include "pair_loop-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_gpf {
namespace kernels {
namespace HWY_NAMESPACE {

template <class D, bool kRobust>
struct ImplicitSum {
  using V = hn::Vec<D>;
  const ImplicitSums& a;
  D d;
  std::size_t out;
  Lanes3<D> query, gradient;
  V value;
  V weight_sum, height_sum, count, close_count, inverse_sum;
  Lanes3<D> normal_sum, slope, tilt;

  HWY_INLINE
  ImplicitSum(const ImplicitSums& arguments, D tag, std::size_t q)
  : a(arguments)
  , d(tag)
  , out(q - arguments.first_output)
  , query(loadQueries(tag, arguments.queries, q))
  , gradient(kRobust ? loadQueries(tag, arguments.gradient, out) : zero3(tag))
  , value(kRobust ? hn::LoadU(tag, arguments.value + out) : hn::Zero(tag))
  , weight_sum(hn::Zero(tag))
  , height_sum(hn::Zero(tag))
  , count(hn::Zero(tag))
  , close_count(hn::Zero(tag))
  , inverse_sum(hn::Zero(tag))
  , normal_sum(zero3(tag))
  , slope(zero3(tag))
  , tilt(zero3(tag))
  {}

  template <class Datum>
  HWY_INLINE void
  pair(Datum datum)
  {
    const Lanes3<D> u = minus<D>(query, loadDatum(d, a.data, datum));
    const V inverse_sq = datum(d, a.radius.inverse_sq_per_datum);
    const V ratio = hn::Mul(dot<D>(u, u), inverse_sq);
    const V one = hn::Set(d, 1.0f);
    const auto inside = hn::Lt(ratio, one);
    if (hn::AllFalse(d, inside))
      return;
    const Lanes3<D> normal = loadDatum(d, a.data_normals, datum);
    const V height = dot<D>(u, normal);
    const V t = hn::IfThenElseZero(inside, hn::Sub(one, ratio));
    V cube = hn::Mul(hn::Mul(t, t), t);
    if (kRobust) {
      const Lanes3<D> turn = minus<D>(normal, gradient);
      const V residual = hn::Sub(height, value);
      const V exponent = mulAdd(dot<D>(turn, turn), hn::Set(d, -a.normal_falloff),
                                hn::Mul(hn::Mul(hn::Mul(residual, residual), inverse_sq), hn::Set(d, -a.residual_falloff)));
      cube = hn::Mul(cube, expNonPositive(d, exponent));
    }
    const V weight = hn::Mul(cube, t);
    const V steepness = hn::Mul(cube, inverse_sq);
    weight_sum = hn::Add(weight_sum, weight);
    height_sum = mulAdd(weight, height, height_sum);
    addScaled<D>(normal_sum, weight, normal);
    addScaled<D>(slope, steepness, u);
    addScaled<D>(tilt, hn::Mul(steepness, height), u);
    if (!kRobust) {
      count = hn::Add(count, hn::IfThenElseZero(inside, one));
      close_count = hn::Add(close_count, hn::IfThenElseZero(hn::And(inside, hn::Lt(ratio, hn::Set(d, a.close))), one));
      inverse_sum = mulAdd(weight, inverse_sq, inverse_sum);
    }
  }

  HWY_INLINE void
  store()
  {
    hn::StoreU(weight_sum, d, a.weight + out);
    hn::StoreU(height_sum, d, a.height + out);
    storeQueries(d, a.normal, out, normal_sum);
    storeQueries(d, a.slope, out, slope);
    storeQueries(d, a.tilt, out, tilt);
    if (!kRobust) {
      hn::StoreU(count, d, a.count + out);
      hn::StoreU(close_count, d, a.close_count + out);
      hn::StoreU(inverse_sum, d, a.inverse_sq + out);
    }
  }
};

} // namespace HWY_NAMESPACE
} // namespace kernels
} // namespace pcl_gpf
HWY_AFTER_NAMESPACE();

#endif
