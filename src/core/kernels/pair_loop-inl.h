// SPDX-License-Identifier: BSD-3-Clause
// Included once per instruction set (Highway's per-target include guard).
#if defined(PCL_GPF_PAIR_LOOP_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PCL_GPF_PAIR_LOOP_INL_H_
#undef PCL_GPF_PAIR_LOOP_INL_H_
#else
#define PCL_GPF_PAIR_LOOP_INL_H_
#endif

#include "kernels.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace pcl_gpf {
namespace kernels {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/** Vectors of queries: one query a lane, never wider than a block. */
template <typename Real>
using QueryTag = hn::CappedTag<Real, kQueryBlock>;

/** One datum for all lanes: the candidates of a run, in order. */
template <class D>
struct SharedDatum {
  std::size_t index;

  HWY_INLINE hn::Vec<D>
  operator()(D d, const hn::TFromD<D>* array) const
  {
    return hn::Set(d, array[index]);
  }
};

/** One datum a lane: the k-th candidates of a foreign search. */
template <class D>
struct LaneDatum {
  const std::int32_t* indices;

  HWY_INLINE hn::Vec<D>
  operator()(D d, const hn::TFromD<D>* array) const
  {
    HWY_ALIGN hn::TFromD<D> values[kQueryBlock];
    for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane)
      values[lane] = array[indices[lane]];
    return hn::Load(d, values);
  }
};

/** Candidates of a run whose distance from the box of a vector of queries is within the largest radius of its lanes; about half of
 * what the cluster boxes let through. The survivors' indices are compressed into a small array that stays in the first cache. */
template <class D>
class CandidateFilter {
public:
  using Real = hn::TFromD<D>;
  using Index = hn::TFromD<hn::RebindToSigned<D>>;
  static constexpr std::size_t kCapacity = 512;

  HWY_INLINE
  CandidateFilter(D d, const Vectors<Real>& queries, std::size_t first, std::size_t count, const Radius<Real>& radius)
  {
    const std::size_t end = first + hn::Lanes(d) < count ? first + hn::Lanes(d) : count;
    const Real* axes[3] = {queries.x, queries.y, queries.z};
    for (int axis = 0; axis < 3; ++axis) {
      min_[axis] = max_[axis] = axes[axis][first];
      for (std::size_t q = first + 1; q < end; ++q) {
        min_[axis] = axes[axis][q] < min_[axis] ? axes[axis][q] : min_[axis];
        max_[axis] = axes[axis][q] > max_[axis] ? axes[axis][q] : max_[axis];
      }
    }
    Real radius_sq = radius.radius_sq;
    if (radius.per_query)
      for (std::size_t q = first; q < end; ++q)
        radius_sq = q == first || radius.per_query[q] > radius_sq ? radius.per_query[q] : radius_sq;
    radius_sq_ = radius_sq * Real(1.0001); // rounding here must not cost a pair; the sums test each pair exactly
  }

  /** \return number of survivors of [begin, end), at most kCapacity - one vector candidates at a time */
  HWY_INLINE std::size_t
  filter(D d, const Vectors<Real>& data, std::size_t begin, std::size_t end, Index* survivors) const
  {
    const hn::RebindToSigned<D> di;
    const std::size_t lanes = hn::Lanes(d);
    const auto radius_sq = hn::Set(d, radius_sq_);
    std::size_t found = 0;
    for (std::size_t j = begin; j < end; j += lanes) {
      const auto gap_x = gap(d, hn::LoadU(d, data.x + j), 0);
      const auto gap_y = gap(d, hn::LoadU(d, data.y + j), 1);
      const auto gap_z = gap(d, hn::LoadU(d, data.z + j), 2);
      const auto distance_sq = hn::Add(hn::Add(hn::Mul(gap_x, gap_x), hn::Mul(gap_y, gap_y)), hn::Mul(gap_z, gap_z));
      auto near = hn::RebindMask(di, hn::Lt(distance_sq, radius_sq));
      if (j + lanes > end)
        near = hn::And(near, hn::FirstN(di, end - j));
      found += hn::CompressStore(hn::Iota(di, static_cast<Index>(j)), near, di, survivors + found);
    }
    return found;
  }

private:
  HWY_INLINE hn::Vec<D>
  gap(D d, hn::Vec<D> p, int axis) const
  {
    const auto outside = hn::Max(hn::Sub(hn::Set(d, min_[axis]), p), hn::Sub(p, hn::Set(d, max_[axis])));
    return hn::Max(outside, hn::Zero(d));
  }

  Real min_[3], max_[3], radius_sq_;
};

/** Streams the candidates of blocks [begin, end) through an accumulator: Sum(arguments, d, first query), pair(datum), store(). The
 * sum of each lane runs over the candidates in their order, whatever the width of a vector. */
template <template <class> class Sum, typename Real, class Arguments>
HWY_INLINE void
streamPairs(const Candidates& candidates, const Arguments& arguments, std::size_t begin, std::size_t end)
{
  const QueryTag<Real> d;
  using D = QueryTag<Real>;
  using Filter = CandidateFilter<D>;
  const std::size_t lanes = hn::Lanes(d);
  HWY_ALIGN typename Filter::Index survivors[Filter::kCapacity + kQueryBlock];
  for (std::size_t block = begin; block < end; ++block)
    for (std::size_t first = block * kQueryBlock; first < (block + 1) * kQueryBlock; first += lanes) {
      Sum<D> sum(arguments, d, first);
      if (candidates.lane_offsets) {
        for (std::size_t row = candidates.lane_offsets[block]; row < candidates.lane_offsets[block + 1]; ++row)
          sum.pair(LaneDatum<D>{candidates.lanes + row * kQueryBlock + first % kQueryBlock});
      } else if (first < candidates.query_count) {
        const Filter filter(d, arguments.queries, first, candidates.query_count, arguments.radius);
        for (std::size_t r = candidates.run_offsets[block]; r < candidates.run_offsets[block + 1]; ++r)
          for (std::size_t j = candidates.runs[r].begin; j < candidates.runs[r].end; j += Filter::kCapacity) {
            const std::size_t part_end = candidates.runs[r].end - j < Filter::kCapacity ? candidates.runs[r].end : j + Filter::kCapacity;
            const std::size_t found = filter.filter(d, arguments.data, j, part_end, survivors);
            for (std::size_t k = 0; k < found; ++k)
              sum.pair(SharedDatum<D>{static_cast<std::size_t>(survivors[k])});
          }
      }
      sum.store();
    }
}

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

/** sum += s * v */
template <class D>
HWY_INLINE void
addScaled(Lanes3<D>& sum, hn::Vec<D> s, const Lanes3<D>& v)
{
  sum.x = mulAdd(s, v.x, sum.x);
  sum.y = mulAdd(s, v.y, sum.y);
  sum.z = mulAdd(s, v.z, sum.z);
}

template <class D>
HWY_INLINE hn::Vec<D>
loadRadiusSq(D d, const Radius<hn::TFromD<D>>& radius, std::size_t q)
{
  return radius.per_query ? hn::LoadU(d, radius.per_query + q) : hn::Set(d, radius.radius_sq);
}

/** exp(x) for x <= 0. Relative error below 3e-7 in float and 4e-16 in double; 0 below -87.3 and -708.4.
 *
 * x = n ln 2 + r with |r| <= ln 2 / 2; Taylor polynomial of exp(r); n goes into the exponent bits. Adding and subtracting 1.5 * 2^23
 * (2^52) rounds to an integer, which is then found in the low bits of the sum. */
template <class D>
HWY_INLINE hn::Vec<D>
expNonPositive(D d, hn::Vec<D> x)
{
  using Real = hn::TFromD<D>;
  constexpr bool kDouble = sizeof(Real) == 8;
  constexpr int kMantissaBits = kDouble ? 52 : 23;
  const auto lowest = hn::Set(d, static_cast<Real>(kDouble ? -708.4 : -87.3));
  const auto rounding = hn::Set(d, static_cast<Real>(kDouble ? 6755399441055744.0 : 12582912.0));
  const auto underflow = hn::Lt(x, lowest);
  x = hn::Max(x, lowest);
  const auto shifted = mulAdd(x, hn::Set(d, static_cast<Real>(1.4426950408889634)), rounding);
  const auto n = hn::Sub(shifted, rounding);
  // ln 2 in two parts; the first has so few bits that its product with n is exact.
  const Real ln2_high = static_cast<Real>(kDouble ? 6.93147180369123816490e-01 : 0.693359375);
  const Real ln2_low = static_cast<Real>(kDouble ? 1.90821492927058770002e-10 : -2.12194440e-4);
  auto r = hn::Sub(x, hn::Mul(n, hn::Set(d, ln2_high)));
  r = hn::Sub(r, hn::Mul(n, hn::Set(d, ln2_low)));
  constexpr double kInverseFactorial[] = {1.0,
                                          1.0,
                                          0.5,
                                          1.0 / 6,
                                          1.0 / 24,
                                          1.0 / 120,
                                          1.0 / 720,
                                          1.0 / 5040,
                                          1.0 / 40320,
                                          1.0 / 362880,
                                          1.0 / 3628800,
                                          1.0 / 39916800,
                                          1.0 / 479001600};
  constexpr int kDegree = kDouble ? 12 : 6;
  auto p = hn::Set(d, static_cast<Real>(kInverseFactorial[kDegree]));
  for (int k = kDegree - 1; k >= 0; --k)
    p = mulAdd(p, r, hn::Set(d, static_cast<Real>(kInverseFactorial[k])));
  const hn::RebindToSigned<D> di;
  const auto exponent = hn::ShiftLeft<kMantissaBits>(hn::BitCast(di, shifted));
  const auto scaled = hn::BitCast(d, hn::Add(hn::BitCast(di, p), exponent));
  return hn::IfThenZeroElse(underflow, scaled);
}

/** exp(x) for -1 <= x <= 0, relative error below 1.1e-6: a polynomial alone, half the work of the whole range. */
template <class D>
HWY_INLINE hn::Vec<D>
expGentle(D d, hn::Vec<D> x)
{
  constexpr double kCoefficients[] = {0.9999993271, 0.9999575166, 0.4995430672, 0.1648039266, 0.03810771922, 0.005009476548};
  auto p = hn::Set(d, static_cast<hn::TFromD<D>>(kCoefficients[5]));
  for (int k = 4; k >= 0; --k)
    p = mulAdd(p, x, hn::Set(d, static_cast<hn::TFromD<D>>(kCoefficients[k])));
  return p;
}

/** exp(-u^2) in shape: (1 - u^2 / 4)^4 for u < 2, else 0; 1 at 0, 0.32 at 1 (against 0.37), and four multiplications. */
template <class D>
HWY_INLINE hn::Vec<D>
bell(D d, hn::Vec<D> u)
{
  auto t = hn::Sub(hn::Set(d, hn::TFromD<D>(1)), hn::Mul(hn::Mul(u, u), hn::Set(d, hn::TFromD<D>(0.25))));
  t = hn::Max(t, hn::Zero(d));
  t = hn::Mul(t, t);
  return hn::Mul(t, t);
}

} // namespace HWY_NAMESPACE
} // namespace kernels
} // namespace pcl_gpf
HWY_AFTER_NAMESPACE();

#endif
