// SPDX-License-Identifier: BSD-3-Clause
// Included once per instruction set (Highway's per-target include guard).
#if defined(PCL_GPF_PAIR_LOOP_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PCL_GPF_PAIR_LOOP_INL_H_
#undef PCL_GPF_PAIR_LOOP_INL_H_
#else
#define PCL_GPF_PAIR_LOOP_INL_H_
#endif

#include "candidate_filter-inl.h"
#include "exponential-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_gpf {
namespace kernels {
namespace HWY_NAMESPACE {

/** Vectors of queries: one query a lane, never wider than a block. */
template <typename Real>
using QueryTag = hn::CappedTag<Real, kQueryBlock>;

/** Vectors of 16 queries are served by two lists of candidates, one for each half: a ball holds a larger share of the neighbours of
 * 8 queries than of 16, which saves a fifth of the steps for one more operation an array and step. */
template <class D>
constexpr std::size_t
partsOf()
{
  return HWY_MAX_BYTES / sizeof(hn::TFromD<D>) >= 16 && kQueryBlock >= 16 ? 2 : 1;
}

/** One datum for all lanes, or one for each half of them: the candidates of runs, in order. */
template <class D, std::size_t kParts>
struct SharedDatum {
  std::size_t index[kParts];
  hn::Mask<D> upper;

  HWY_INLINE hn::Vec<D>
  operator()(D d, const hn::TFromD<D>* array) const
  {
    const auto lower_value = hn::Set(d, array[index[0]]);
    if constexpr (kParts == 1)
      return lower_value;
    else
      return hn::IfThenElse(upper, hn::Set(d, array[index[1]]), lower_value);
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

/** Candidates of a vector of queries that survived their filters: indices in small arrays that stay in the first cache. */
template <class D>
class Survivors {
public:
  static constexpr std::size_t kParts = partsOf<D>();
  using Filter = CandidateFilter<D>;

  explicit HWY_INLINE
  Survivors(D d)
  : steps_(hn::Iota(typename Filter::Indices(), 0)) // Highway makes it in memory: not in the loop
  , upper_(hn::Not(hn::FirstN(d, hn::Lanes(d) / 2)))
  {}

  /** Passes the candidates of a block's runs to `sum`, for the queries of one vector. */
  template <class Sum, class Arguments>
  HWY_INLINE void
  stream(D d, const Candidates& candidates, const Arguments& a, std::size_t block, std::size_t first, Sum& sum)
  {
    const std::size_t lanes = hn::Lanes(d), half = first + lanes / 2, last = first + lanes, count = candidates.query_count;
    const Filter filters[2] = {Filter(a.queries, first, kParts == 2 ? half : last, count, a.radius),
                               Filter(a.queries, kParts == 2 ? half : first, last, count, a.radius)};
    std::size_t found_0 = 0, found_1 = 0; // not an array: they stay in registers
    const typename Filter::Indices di;
    for (std::size_t r = candidates.run_offsets[block]; r < candidates.run_offsets[block + 1]; ++r) {
      const auto end = hn::Set(di, static_cast<Index>(candidates.runs[r].end));
      for (std::size_t j = candidates.runs[r].begin; j < candidates.runs[r].end; j += lanes) {
        const Lanes3<D> position = loadQueries(d, a.data, j);
        const auto indices = hn::Add(hn::Set(di, static_cast<Index>(j)), steps_);
        found_0 += filters[0].filter(d, position, j, indices, end, indices_[0] + found_0);
        if (kParts == 2)
          found_1 += filters[1].filter(d, position, j, indices, end, indices_[kParts - 1] + found_1);
        if ((found_0 > found_1 ? found_0 : found_1) > kCapacity - lanes) {
          pass(found_0, found_1, candidates, sum);
          found_0 = found_1 = 0;
        }
      }
    }
    pass(found_0, found_1, candidates, sum);
  }

private:
  static constexpr std::size_t kCapacity = 512;
  using Index = typename Filter::Index;

  template <class Sum>
  HWY_INLINE void
  pass(std::size_t found_0, std::size_t found_1, const Candidates& candidates, Sum& sum)
  {
    for (std::size_t k = found_0; k < found_1; ++k)
      indices_[0][k] = static_cast<Index>(candidates.absent);
    for (std::size_t k = found_1; kParts == 2 && k < found_0; ++k)
      indices_[kParts - 1][k] = static_cast<Index>(candidates.absent);
    const std::size_t longest = found_0 > found_1 ? found_0 : found_1;
    for (std::size_t k = 0; k < longest; ++k) {
      SharedDatum<D, kParts> datum;
      for (std::size_t part = 0; part < kParts; ++part)
        datum.index[part] = static_cast<std::size_t>(indices_[part][k]);
      datum.upper = upper_;
      sum.pair(datum);
    }
  }

  HWY_ALIGN Index indices_[kParts][kCapacity + kQueryBlock];
  hn::Vec<typename Filter::Indices> steps_; ///< 0, 1, 2 ...
  hn::Mask<D> upper_;
};

/** Streams the candidates of blocks [begin, end) through an accumulator: Sum(arguments, d, first query), pair(datum), store(). The
 * sum of each lane runs over the candidates in their order, whatever the width of a vector. */
template <template <class> class Sum, typename Real, class Arguments>
HWY_INLINE void
streamPairs(const Candidates& candidates, const Arguments& arguments, std::size_t begin, std::size_t end)
{
  const QueryTag<Real> d;
  using D = QueryTag<Real>;
  const std::size_t lanes = hn::Lanes(d);
  Survivors<D> survivors(d);
  for (std::size_t block = begin; block < end; ++block)
    for (std::size_t first = block * kQueryBlock; first < (block + 1) * kQueryBlock; first += lanes) {
      Sum<D> sum(arguments, d, first);
      if (candidates.lane_offsets)
        for (std::size_t row = candidates.lane_offsets[block]; row < candidates.lane_offsets[block + 1]; ++row)
          sum.pair(LaneDatum<D>{candidates.lanes + row * kQueryBlock + first % kQueryBlock});
      else if (first < candidates.query_count)
        survivors.stream(d, candidates, arguments, block, first, sum);
      sum.store();
    }
}

/** Whether a step without a pair in reach is worth a branch: not where the branch is unpredictable and the work is short. */
template <class D>
HWY_INLINE bool
skips(D d, hn::Mask<D> inside)
{
  return sizeof(hn::TFromD<D>) == sizeof(double) && hn::AllFalse(d, inside);
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
