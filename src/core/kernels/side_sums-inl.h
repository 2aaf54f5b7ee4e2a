// SPDX-License-Identifier: BSD-3-Clause
// Included once per instruction set (Highway's per-target include guard).
#if defined(PCL_GPF_SIDE_SUMS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PCL_GPF_SIDE_SUMS_INL_H_
#undef PCL_GPF_SIDE_SUMS_INL_H_
#else
#define PCL_GPF_SIDE_SUMS_INL_H_
#endif

#include "pair_loop-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_gpf {
namespace kernels {
namespace HWY_NAMESPACE {

template <class D, bool kSignInvariant>
struct SideSum {
  using V = hn::Vec<D>;
  const SideSums& a;
  D d;
  std::size_t out;
  Lanes3<D> query;
  V radius_sq, scale, angle_falloff;
  struct Side {
    Lanes3<D> direction, normal;
    V weight, offset, largest, nearest;
  } sides[2];

  HWY_INLINE
  SideSum(const SideSums& arguments, D tag, std::size_t q)
  : a(arguments)
  , d(tag)
  , out(q - arguments.first_output)
  , query(loadQueries(tag, arguments.queries, q))
  , radius_sq(loadRadiusSq(tag, arguments.radius, q))
  , scale(hn::Div(hn::Set(tag, -arguments.falloff), radius_sq))
  , angle_falloff(hn::Set(tag, arguments.angle_falloff))
  , sides{{loadQueries(tag, arguments.directions[0], q), zero3(tag), hn::Zero(tag), hn::Zero(tag), hn::Zero(tag), hn::Zero(tag)},
          {loadQueries(tag, arguments.directions[1], q), zero3(tag), hn::Zero(tag), hn::Zero(tag), hn::Zero(tag), hn::Zero(tag)}}
  {}

  template <class Datum>
  HWY_INLINE void
  pair(Datum datum)
  {
    const Lanes3<D> apart = minus<D>(query, loadDatum(d, a.data, datum));
    const V distance_sq = dot<D>(apart, apart);
    const auto inside = hn::Lt(distance_sq, radius_sq);
    if (hn::AllFalse(d, inside))
      return;
    const Lanes3<D> normal = loadDatum(d, a.data_normals, datum);
    const V number = datum(d, a.data_numbers); // bits that only move
    const V above = dot<D>(apart, normal);
    const V near = hn::Mul(distance_sq, scale);
    add(sides[0], normal, number, above, near, inside);
    add(sides[1], normal, number, above, near, inside);
  }

  HWY_INLINE void
  add(Side& side, const Lanes3<D>& normal, V number, V above, V near, hn::Mask<D> inside) const
  {
    const V cosine = dot<D>(side.direction, normal);
    const V turn = hn::Mul(hn::Sub(hn::Set(d, 1.0f), kSignInvariant ? hn::Abs(cosine) : cosine), angle_falloff);
    const V weight = hn::IfThenElseZero(inside, expNonPositive(d, hn::Sub(near, hn::Mul(turn, turn))));
    const V signed_weight = kSignInvariant ? hn::CopySign(weight, cosine) : weight;
    side.weight = hn::Add(side.weight, weight);
    side.offset = mulAdd(signed_weight, above, side.offset);
    addScaled<D>(side.normal, signed_weight, normal);
    const auto larger = hn::Gt(weight, side.largest);
    side.largest = hn::Max(weight, side.largest);
    side.nearest = hn::IfThenElse(larger, number, side.nearest);
  }

  HWY_INLINE void
  store()
  {
    for (std::size_t k = 0; k < 2; ++k) {
      hn::StoreU(sides[k].weight, d, a.weight[k] + out);
      hn::StoreU(sides[k].offset, d, a.offset[k] + out);
      storeQueries(d, a.normal[k], out, sides[k].normal);
      hn::StoreU(sides[k].nearest, d, a.nearest[k] + out);
    }
  }
};

} // namespace HWY_NAMESPACE
} // namespace kernels
} // namespace pcl_gpf
HWY_AFTER_NAMESPACE();

#endif
