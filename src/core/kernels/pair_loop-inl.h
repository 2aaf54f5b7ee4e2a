// SPDX-License-Identifier: BSD-3-Clause
// Included once per instruction set (Highway's per-target include guard).
#if defined(PCL_GPF_PAIR_LOOP_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PCL_GPF_PAIR_LOOP_INL_H_
#undef PCL_GPF_PAIR_LOOP_INL_H_
#else
#define PCL_GPF_PAIR_LOOP_INL_H_
#endif

#include "exponential-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_gpf {
namespace kernels {
namespace HWY_NAMESPACE {

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
    inverse_sq_ = radius.inverse_sq_per_datum;
    Real radius_sq = inverse_sq_ ? Real(1) : radius.radius_sq;
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
      auto distance_sq = hn::Add(hn::Add(hn::Mul(gap_x, gap_x), hn::Mul(gap_y, gap_y)), hn::Mul(gap_z, gap_z));
      if (inverse_sq_) // in units of the datum's own radius
        distance_sq = hn::Mul(distance_sq, hn::LoadU(d, inverse_sq_ + j));
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
  const Real* inverse_sq_;
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

template <class D>
HWY_INLINE hn::Vec<D>
loadRadiusSq(D d, const Radius<hn::TFromD<D>>& radius, std::size_t q)
{
  return radius.per_query ? hn::LoadU(d, radius.per_query + q) : hn::Set(d, radius.radius_sq);
}

} // namespace HWY_NAMESPACE
} // namespace kernels
} // namespace pcl_gpf
HWY_AFTER_NAMESPACE();

#endif
