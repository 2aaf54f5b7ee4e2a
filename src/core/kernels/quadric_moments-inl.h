// SPDX-License-Identifier: BSD-3-Clause
#if defined(PCL_GPF_QUADRIC_MOMENTS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PCL_GPF_QUADRIC_MOMENTS_INL_H_
#undef PCL_GPF_QUADRIC_MOMENTS_INL_H_
#else
#define PCL_GPF_QUADRIC_MOMENTS_INL_H_
#endif

#include "pair_loop-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_gpf {
namespace kernels {
namespace HWY_NAMESPACE {

/** Normal equations of a quadric over each query's plane, and of its normals. */
template <class D>
struct QuadricMomentSum {
  using V = hn::Vec<D>;
  const QuadricMoments& a;
  D d;
  std::size_t first;
  Lanes3<D> query, axis_u, axis_v, axis_n;
  V radius_sq, one_by_radius;
  V sums[QuadricMoments::kSums];

  HWY_INLINE
  QuadricMomentSum(const QuadricMoments& arguments, D tag, std::size_t q)
  : a(arguments)
  , d(tag)
  , first(q)
  , query(loadQueries(tag, arguments.queries, q))
  , axis_u(loadQueries(tag, arguments.axis_u, q))
  , axis_v(loadQueries(tag, arguments.axis_v, q))
  , axis_n(loadQueries(tag, arguments.axis_n, q))
  , radius_sq(hn::Set(tag, arguments.radius.radius_sq))
  , one_by_radius(hn::Set(tag, arguments.one_by_radius))
  {
    for (V& sum : sums)
      sum = hn::Zero(tag);
  }

  template <class Datum>
  HWY_INLINE void
  pair(Datum datum)
  {
    const Lanes3<D> offset = minus<D>(loadDatum(d, a.data, datum), query);
    const V distance_sq = dot<D>(offset, offset);
    const auto inside = hn::Lt(distance_sq, radius_sq);
    const Lanes3<D> o = {inUnits(inside, offset.x), inUnits(inside, offset.y), inUnits(inside, offset.z)}; // padding would overflow
    const V share = hn::IfThenElseZero(inside, hn::Sub(hn::Set(d, 1.0f), dot<D>(o, o)));
    const V bell = hn::Mul(share, share), weight = hn::Mul(bell, datum(d, a.data_weight));
    const V x = dot<D>(o, axis_u), y = dot<D>(o, axis_v);
    const Lanes3<D> raised = minus<D>(loadDatum(d, a.noisy, datum), query);
    const V height = inUnits(inside, dot<D>(raised, axis_n));
    addMonomials(weight, x, y, height);
    addNormal(weight, x, y, loadDatum(d, a.data_normals, datum));
    add(QuadricMoments::kBell, bell);
    sums[QuadricMoments::kWithin] = mulAdd(bell, datum(d, a.within), sums[QuadricMoments::kWithin]);
    sums[QuadricMoments::kSpread] = mulAdd(weight, datum(d, a.spread), sums[QuadricMoments::kSpread]);
  }

  HWY_INLINE void
  store()
  {
    const std::size_t place = first - a.first_output;
    for (std::size_t s = 0; s < QuadricMoments::kSums; ++s)
      hn::StoreU(sums[s], d, a.sums + s * a.row + place);
  }

private:
  HWY_INLINE V inUnits(hn::Mask<D> inside, V length) const { return hn::IfThenElseZero(inside, hn::Mul(length, one_by_radius)); }
  HWY_INLINE void add(std::size_t to, V value) { sums[to] = hn::Add(sums[to], value); }

  HWY_INLINE void
  addMonomials(V weight, V x, V y, V height)
  {
    std::size_t to = QuadricMoments::kMonomials;
    V power_x = weight; // weight * x^i
    for (std::size_t i = 0; i <= 4; ++i) {
      V term = power_x;
      for (std::size_t j = 0; i + j <= 4; ++j) {
        add(to++, term);
        term = hn::Mul(term, y);
      }
      power_x = hn::Mul(power_x, x);
    }
    const V w = hn::Mul(weight, height), wx = hn::Mul(w, x), wy = hn::Mul(w, y);
    const V rights[6] = {w, wx, wy, hn::Mul(wx, x), hn::Mul(wx, y), hn::Mul(wy, y)};
    for (std::size_t k = 0; k < 6; ++k)
      add(QuadricMoments::kHeights + k, rights[k]);
    add(QuadricMoments::kSquare, hn::Mul(w, height));
  }

  HWY_INLINE void
  addNormal(V weight, V x, V y, const Lanes3<D>& free_sign)
  {
    const V cosine = dot<D>(free_sign, axis_n), toward = hn::CopySign(hn::Set(d, 1.0f), cosine);
    const V slopes[2] = {hn::Mul(toward, dot<D>(free_sign, axis_u)), hn::Mul(toward, dot<D>(free_sign, axis_v))};
    std::size_t to = QuadricMoments::kSlopes;
    V square = hn::Zero(d);
    for (const V slope : slopes) {
      const V w = hn::Mul(weight, slope);
      add(to++, w);
      add(to++, hn::Mul(w, x));
      add(to++, hn::Mul(w, y));
      square = mulAdd(w, slope, square);
    }
    add(QuadricMoments::kSlopeSquare, square);
    sums[QuadricMoments::kAgreement] = mulAdd(weight, hn::Abs(cosine), sums[QuadricMoments::kAgreement]);
  }
};

} // namespace HWY_NAMESPACE
} // namespace kernels
} // namespace pcl_gpf
HWY_AFTER_NAMESPACE();

#endif
