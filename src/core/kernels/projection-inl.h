// SPDX-License-Identifier: BSD-3-Clause
#if defined(PCL_GPF_PROJECTION_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PCL_GPF_PROJECTION_INL_H_
#undef PCL_GPF_PROJECTION_INL_H_
#else
#define PCL_GPF_PROJECTION_INL_H_
#endif

#include "pair_loop-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_gpf {
namespace kernels {
namespace HWY_NAMESPACE {

/** Data term of eq. 10. The residual of eq. 11 after the move delta is a quadratic form in it,
 * sum p ((d - delta).b)^2 = sum p (d.b)^2 - 2 delta.sum p (d.b) b + delta^T (sum p b b^T) delta, so one visit serves both. */
template <class D, bool kSymmetric, bool kNormalWeights, bool kWeighted, bool kDensity, bool kVariance, bool kGentle>
struct ProjectionSum {
  using Real = hn::TFromD<D>;
  using V = hn::Vec<D>;
  const Projection<Real>& a;
  D d;
  std::size_t first;
  Lanes3<D> query, query_normal;
  V radius_sq, scale, weight_sum;
  Lanes3<D> pull, own_offset;
  Bell<D> normal_bell, symmetry_bell;
  V posterior_sum, residual_sq;
  Lanes3<D> cross, diagonal, mixed;

  HWY_INLINE
  ProjectionSum(const Projection<Real>& arguments, D tag, std::size_t q)
  : a(arguments)
  , d(tag)
  , first(q)
  , query(loadQueries(tag, arguments.queries, q))
  , query_normal(loadQueries(tag, arguments.query_normals, q))
  , radius_sq(loadRadiusSq(tag, arguments.radius, q))
  , scale(hn::Div(hn::Set(tag, -arguments.falloff), radius_sq))
  , weight_sum(hn::Zero(tag))
  , pull(zero3(tag))
  , own_offset(zero3(tag))
  , normal_bell(tag, 1.0 - static_cast<double>(arguments.normal_floor), arguments.normal_falloff)
  , symmetry_bell(tag, 0.5, arguments.symmetry_falloff)
  , posterior_sum(hn::Zero(tag))
  , residual_sq(hn::Zero(tag))
  , cross(zero3(tag))
  , diagonal(zero3(tag))
  , mixed(zero3(tag))
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
    const V height = dot<D>(offset, normal);
    const V exponent = hn::Mul(distance_sq, scale);
    V weight = hn::IfThenElseZero(inside, kGentle ? expGentle(d, exponent) : expNonPositive(d, exponent));
    if (kWeighted)
      weight = hn::Mul(weight, datum(d, a.data_weight));
    if (kVariance)
      addVariance(weight, height, normal);
    if (kDensity)
      weight = hn::Mul(weight, datum(d, a.data_density));
    if (kSymmetric || kNormalWeights)
      addAnisotropic(weight, height, offset, normal);
    else {
      weight_sum = hn::Add(weight_sum, weight);
      addScaled<D>(pull, hn::Mul(weight, height), normal);
    }
  }

  HWY_INLINE void
  addAnisotropic(V weight, V height, const Lanes3<D>& offset, const Lanes3<D>& normal)
  {
    const V one = hn::Set(d, Real(1));
    const V deviation = hn::Sub(one, hn::Abs(dot<D>(normal, query_normal))); // 1 - cos of the angle between the planes
    const V deviation_sq = hn::Mul(deviation, deviation);
    if (kNormalWeights)
      weight = hn::Mul(weight, hn::Add(normal_bell(d, deviation_sq), hn::Set(d, a.normal_floor)));
    weight_sum = hn::Add(weight_sum, weight);
    if (kSymmetric) {
      // (1 - s) (d.b_n) b_n + s (d.b_x) b_x: where s is one half the two errors cancel on a curved surface; s is 0 across an edge.
      const V own = hn::Mul(weight, symmetry_bell(d, deviation_sq));
      addScaled<D>(own_offset, own, offset); // d.b_x is taken of the sum
      weight = hn::Sub(weight, own);
    }
    addScaled<D>(pull, hn::Mul(weight, height), normal);
  }

  HWY_INLINE void
  addVariance(V posterior, V height, const Lanes3<D>& n)
  {
    posterior_sum = hn::Add(posterior_sum, posterior);
    const V weighted_height = hn::Mul(posterior, height);
    residual_sq = mulAdd(weighted_height, height, residual_sq);
    addScaled<D>(cross, weighted_height, n);
    const Lanes3<D> weighted = {hn::Mul(posterior, n.x), hn::Mul(posterior, n.y), hn::Mul(posterior, n.z)};
    addOuter<D>(weighted, n, diagonal, mixed);
  }

  HWY_INLINE void
  store()
  {
    if (kSymmetric)
      addScaled<D>(pull, dot<D>(own_offset, query_normal), query_normal);
    const std::size_t place = first - a.first_output;
    hn::StoreU(weight_sum, d, a.weight_sum + place);
    storeQueries(d, a.pull, place, pull);
    if (kVariance) {
      hn::StoreU(posterior_sum, d, a.posterior_sum + place);
      hn::StoreU(residual_sq, d, a.residual_sq + place);
      storeQueries(d, a.cross, place, cross);
      storeQueries(d, a.scatter_diagonal, place, diagonal);
      storeQueries(d, a.scatter_mixed, place, mixed);
    }
  }
};

} // namespace HWY_NAMESPACE
} // namespace kernels
} // namespace pcl_gpf
HWY_AFTER_NAMESPACE();

#endif
