// SPDX-License-Identifier: BSD-3-Clause
// Included once per instruction set (Highway's per-target include guard).
#if defined(PCL_GPF_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PCL_GPF_LANES_INL_H_
#undef PCL_GPF_LANES_INL_H_
#else
#define PCL_GPF_LANES_INL_H_
#endif

#include "kernels.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace pcl_gpf {
namespace kernels {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/** Three vectors of lanes. */
template <class D>
struct Lanes3 {
  hn::Vec<D> x, y, z;
};

template <class D>
HWY_INLINE Lanes3<D>
loadQueries(D d, const Vectors<hn::TFromD<D>>& v, std::size_t q)
{
  return {hn::LoadU(d, v.x + q), hn::LoadU(d, v.y + q), hn::LoadU(d, v.z + q)};
}

template <class D, class Datum>
HWY_INLINE Lanes3<D>
loadDatum(D d, const Vectors<hn::TFromD<D>>& v, Datum datum)
{
  return {datum(d, v.x), datum(d, v.y), datum(d, v.z)};
}

template <class D>
HWY_INLINE void
storeQueries(D d, const MutableVectors<hn::TFromD<D>>& v, std::size_t q, const Lanes3<D>& value)
{
  hn::StoreU(value.x, d, v.x + q);
  hn::StoreU(value.y, d, v.y + q);
  hn::StoreU(value.z, d, v.z + q);
}

template <class D>
HWY_INLINE Lanes3<D>
zero3(D d)
{
  return {hn::Zero(d), hn::Zero(d), hn::Zero(d)};
}

template <class D>
HWY_INLINE Lanes3<D>
minus(const Lanes3<D>& a, const Lanes3<D>& b)
{
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}

// Products and sums are rounded one by one, never fused: every instruction set, with or without fused multiply-add, gives the same bits.

/** a * b + c, rounded twice. */
template <class V>
HWY_INLINE V
mulAdd(V a, V b, V c)
{
  return hn::Add(hn::Mul(a, b), c);
}

template <class D>
HWY_INLINE hn::Vec<D>
dot(const Lanes3<D>& a, const Lanes3<D>& b)
{
  return mulAdd(a.z, b.z, mulAdd(a.y, b.y, hn::Mul(a.x, b.x)));
}

/** Adds w o^T to a symmetric matrix, where w = weight * o: its diagonal and yz, xz, xy. */
template <class D>
HWY_INLINE void
addOuter(const Lanes3<D>& w, const Lanes3<D>& o, Lanes3<D>& diagonal, Lanes3<D>& mixed)
{
  diagonal = {mulAdd(w.x, o.x, diagonal.x), mulAdd(w.y, o.y, diagonal.y), mulAdd(w.z, o.z, diagonal.z)};
  mixed = {mulAdd(w.y, o.z, mixed.x), mulAdd(w.x, o.z, mixed.y), mulAdd(w.x, o.y, mixed.z)};
}

/** sum += s * v */
template <class D>
HWY_INLINE void
addScaled(Lanes3<D>& sum, hn::Vec<D> s, const Lanes3<D>& v)
{
  sum.x = mulAdd(s, v.x, sum.x);
  sum.y = mulAdd(s, v.y, sum.y);
  sum.z = mulAdd(s, v.z, sum.z);
}

} // namespace HWY_NAMESPACE
} // namespace kernels
} // namespace pcl_gpf
HWY_AFTER_NAMESPACE();

#endif
