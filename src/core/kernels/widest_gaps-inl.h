// SPDX-License-Identifier: BSD-3-Clause
// Included once per instruction set (Highway's per-target include guard).
#if defined(PCL_GPF_WIDEST_GAPS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PCL_GPF_WIDEST_GAPS_INL_H_
#undef PCL_GPF_WIDEST_GAPS_INL_H_
#else
#define PCL_GPF_WIDEST_GAPS_INL_H_
#endif

#include "gap_rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_gpf {
namespace kernels {
namespace HWY_NAMESPACE {

/** The gap search of one patch: a lane of the inner loop is a base. */
class GapLoop {
public:
  using D = GapRows::D;

  explicit HWY_INLINE
  GapLoop(const WidestGaps& arguments)
  : a_(arguments), rows_(arguments), lanes_(hn::Lanes(D()))
  {}

  HWY_INLINE void
  run()
  {
    const std::size_t candidates = rows_.collectCandidates();
    for (std::size_t k = a_.first; k < a_.last; ++k) {
      GapRows::Counts counts = rows_.collectNeighbors(k, a_.radius_sq[k - a_.first], candidates);
      if (counts.neighbors > GapScratch::kMostNeighbors)
        counts = rows_.collectNeighbors(k, radiusSqOfNearest(*a_.scratch, counts.neighbors, rows_.position(k)), candidates);
      measure(k, counts);
      choose(k, counts.bases);
    }
  }

private:
  /** The clearance of each base, 0 for those that are none, and the cosine between the normals of the pair. */
  HWY_INLINE void
  measure(std::size_t k, GapRows::Counts counts)
  {
    const D d;
    const Vectors<float> bases = GapRows::positionsOf(a_.scratch->bases), others = GapRows::normalsOf(a_.scratch->bases);
    const Vectors<float> s = GapRows::positionsOf(a_.scratch->candidates), n = GapRows::normalsOf(a_.scratch->candidates);
    const std::uint32_t* const neighbors = a_.scratch->neighbors.data();
    const std::array<float, 3> v = rows_.position(k);
    const Lanes3<D> point = {hn::Set(d, v[0]), hn::Set(d, v[1]), hn::Set(d, v[2])};
    const Lanes3<D> normal = {hn::Set(d, a_.normals.x[k]), hn::Set(d, a_.normals.y[k]), hn::Set(d, a_.normals.z[k])};
    for (std::size_t t = 0; t < counts.bases; t += lanes_) {
      const Lanes3<D> base = loadQueries(d, bases, t), to_base = minus<D>(base, point);
      const auto to_base_sq = dot<D>(to_base, to_base);
      const auto above = dot<D>(to_base, normal);
      auto least_sq = hn::Sub(to_base_sq, hn::Mul(above, above)); // from k's own line
      for (std::size_t i = 0; i < counts.neighbors; ++i) {
        const std::size_t j = neighbors[i];
        const Lanes3<D> e = {hn::Sub(base.x, hn::Set(d, s.x[j])), hn::Sub(base.y, hn::Set(d, s.y[j])), hn::Sub(base.z, hn::Set(d, s.z[j]))};
        const auto along = dot<D>(e, {hn::Set(d, n.x[j]), hn::Set(d, n.y[j]), hn::Set(d, n.z[j])});
        least_sq = hn::Min(least_sq, hn::Sub(dot<D>(e, e), hn::Mul(along, along)));
      }
      const auto cosine = dot<D>(normal, loadQueries(d, others, t)), aligned = hn::Abs(cosine);
      auto none = hn::And(hn::Gt(aligned, hn::Set(d, a_.parallel)),
                          hn::Gt(hn::Mul(above, above), hn::Mul(hn::Set(d, a_.steep_sq), to_base_sq)));
      if (!a_.sign_invariant)
        none = hn::Or(none, hn::Lt(cosine, hn::Set(d, a_.opposite)));
      hn::StoreU(hn::IfThenZeroElse(none, least_sq), d, a_.scratch->clearance_sq.data() + t);
      hn::StoreU(a_.sign_invariant ? aligned : cosine, d, a_.scratch->cosine.data() + t);
    }
  }

  /** The best gap, and the best of those outside of whose clearance it lies. */
  HWY_INLINE void
  choose(std::size_t k, std::size_t bases)
  {
    const D d;
    const GapScratch& s = *a_.scratch;
    float* priority = a_.scratch->priority.data();
    if (a_.largest_factor > 1.0f)
      for (std::size_t t = 0; t < bases; ++t)
        priority[t] = s.clearance_sq[t] * edgeFactor(a_.edge_factors, s.cosine[t]);
    else
      for (std::size_t t = 0; t < bases; t += lanes_)
        hn::StoreU(hn::LoadU(d, s.clearance_sq.data() + t), d, priority + t);
    Gap* gaps = a_.gaps + kGapsOfPoint * (k - a_.first);
    const std::size_t first = firstOfMost(bases);
    gaps[0] = gap(first, bases);
    if (first < bases) {
      const Lanes3<D> best = {hn::Set(d, s.bases.x[first]), hn::Set(d, s.bases.y[first]), hn::Set(d, s.bases.z[first])};
      for (std::size_t t = 0; t < bases; t += lanes_) {
        const Lanes3<D> offset = minus<D>(loadQueries(d, GapRows::positionsOf(s.bases), t), best);
        const auto apart = hn::Ge(dot<D>(offset, offset), hn::LoadU(d, s.clearance_sq.data() + t));
        hn::StoreU(hn::IfThenElseZero(apart, hn::LoadU(d, priority + t)), d, priority + t);
      }
    }
    gaps[1] = gap(firstOfMost(bases), bases);
  }

  /** The first of the bases that have the greatest priority, above 0; `bases` when there is none. */
  HWY_INLINE std::size_t
  firstOfMost(std::size_t bases) const
  {
    const D d;
    float most = 0.0f;
    std::size_t place = bases;
    for (std::size_t t = 0; t < bases; t += lanes_) {
      const auto priority = hn::IfThenElseZero(hn::FirstN(d, bases - t), hn::LoadU(d, a_.scratch->priority.data() + t));
      const float here = hn::GetLane(hn::MaxOfLanes(d, priority));
      if (!(here > most))
        continue;
      most = here;
      place = t + static_cast<std::size_t>(hn::FindFirstTrue(d, hn::Eq(priority, hn::Set(d, here))));
    }
    return place;
  }

  HWY_INLINE Gap
  gap(std::size_t t, std::size_t bases) const
  {
    const GapScratch& s = *a_.scratch;
    if (t == bases)
      return Gap();
    const float* const middle = rows_.middle();
    return {{middle[0] + s.bases.x[t], middle[1] + s.bases.y[t], middle[2] + s.bases.z[t]},
            s.clearance_sq[t], s.priority[t], s.bases.number[t]};
  }

  const WidestGaps& a_;
  GapRows rows_;
  std::size_t lanes_;
};

static void
widestGaps(const WidestGaps& a)
{
  GapLoop(a).run();
}

} // namespace HWY_NAMESPACE
} // namespace kernels
} // namespace pcl_gpf
HWY_AFTER_NAMESPACE();

#endif
