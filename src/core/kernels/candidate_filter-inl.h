// SPDX-License-Identifier: BSD-3-Clause
// Included once per instruction set (Highway's per-target include guard).
#if defined(PCL_GPF_CANDIDATE_FILTER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PCL_GPF_CANDIDATE_FILTER_INL_H_
#undef PCL_GPF_CANDIDATE_FILTER_INL_H_
#else
#define PCL_GPF_CANDIDATE_FILTER_INL_H_
#endif

#include "lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_gpf {
namespace kernels {
namespace HWY_NAMESPACE {

/** Candidates whose distance from the box of some queries is within the largest of their radii; about half of what the cluster boxes
 * let through. */
template <class D>
class CandidateFilter {
public:
  using Real = hn::TFromD<D>;
  using Indices = hn::RebindToSigned<D>;
  using Index = hn::TFromD<Indices>;

  /** For the queries [first, end) of `count`; those beyond the count have no candidates. */
  HWY_INLINE
  CandidateFilter(const Vectors<Real>& queries, std::size_t first, std::size_t end, std::size_t count, const Radius<Real>& radius)
  {
    end = end < count ? end : count;
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
    radius_sq_ = first < count ? radius_sq * Real(1.0001) // rounding here must not cost a pair; the sums test each pair exactly
                               : Real(-1);
  }

  /** Writes the survivors of one vector of candidates, those before `end`, and anything behind them. \param[in] j the first of them
   * \return number of survivors */
  HWY_INLINE std::size_t
  filter(D d, const Lanes3<D>& position, std::size_t j, hn::Vec<Indices> indices, hn::Vec<Indices> end, Index* survivors) const
  {
    const Indices di;
    const auto gap_x = gap(d, position.x, 0), gap_y = gap(d, position.y, 1), gap_z = gap(d, position.z, 2);
    auto distance_sq = hn::Add(hn::Add(hn::Mul(gap_x, gap_x), hn::Mul(gap_y, gap_y)), hn::Mul(gap_z, gap_z));
    if (inverse_sq_) // in units of the datum's own radius
      distance_sq = hn::Mul(distance_sq, hn::LoadU(d, inverse_sq_ + j));
    const auto near = hn::And(hn::RebindMask(di, hn::Lt(distance_sq, hn::Set(d, radius_sq_))), hn::Lt(indices, end));
    hn::StoreU(hn::Compress(indices, near), di, survivors);
    return hn::CountTrue(di, near);
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

} // namespace HWY_NAMESPACE
} // namespace kernels
} // namespace pcl_gpf
HWY_AFTER_NAMESPACE();

#endif
