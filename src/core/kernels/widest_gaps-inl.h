// SPDX-License-Identifier: BSD-3-Clause
// Included once per instruction set (Highway's per-target include guard).
#if defined(PCL_GPF_WIDEST_GAPS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PCL_GPF_WIDEST_GAPS_INL_H_
#undef PCL_GPF_WIDEST_GAPS_INL_H_
#else
#define PCL_GPF_WIDEST_GAPS_INL_H_
#endif

#include "lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_gpf {
namespace kernels {
namespace HWY_NAMESPACE {

/** The gap search of one patch: candidates and neighbours are packed, so that every lane works; a lane of the inner loop is a base. */
class GapLoop {
public:
  using D = hn::CappedTag<float, kQueryBlock>;
  using Numbers = hn::RebindToUnsigned<D>;

  explicit HWY_INLINE
  GapLoop(const WidestGaps& arguments)
  : a_(arguments), lanes_(hn::Lanes(D()))
  {}

  HWY_INLINE void
  run()
  {
    const std::size_t candidates = collectCandidates();
    for (std::size_t k = a_.first; k < a_.last; ++k) {
      std::size_t count = collectNeighbors(k, candidates);
      if (count > GapScratch::kMostNeighbors)
        count = keepNearest(a_.scratch->neighbors, count);
      const std::size_t bases = collectBases(k, count);
      measure(k, count, bases);
      choose(k, bases);
    }
  }

private:
  /** Writes the lanes of the mask, one after another, and anything behind them. */
  template <class Tag>
  static HWY_INLINE void
  put(Tag d, AlignedArray<hn::TFromD<Tag>>& to, std::size_t at, hn::Vec<Tag> values, hn::Mask<Tag> mask)
  {
    hn::StoreU(hn::Compress(values, mask), d, to.data() + at);
  }

  /** Copies those of the runs that are in reach of the patch's box. */
  HWY_INLINE std::size_t
  collectCandidates()
  {
    const D d;
    const Numbers du;
    PointRows& to = a_.scratch->candidates;
    std::size_t count = 0;
    const auto reach_sq = hn::Set(d, a_.largest_radius_sq);
    for (std::size_t r = 0; r < a_.run_count; ++r)
      for (std::size_t j = a_.runs[r].begin; j < a_.runs[r].end; j += lanes_) {
        const Lanes3<D> p = loadQueries(d, a_.points, j);
        const auto gap_x = outside(p.x, 0), gap_y = outside(p.y, 1), gap_z = outside(p.z, 2);
        const auto gap_sq = mulAdd(gap_z, gap_z, mulAdd(gap_y, gap_y, hn::Mul(gap_x, gap_x)));
        const auto near = hn::And(hn::Le(gap_sq, reach_sq), hn::FirstN(d, a_.runs[r].end - j));
        put(d, to.x, count, p.x, near);
        put(d, to.y, count, p.y, near);
        put(d, to.z, count, p.z, near);
        put(d, to.nx, count, hn::LoadU(d, a_.normals.x + j), near);
        put(d, to.ny, count, hn::LoadU(d, a_.normals.y + j), near);
        put(d, to.nz, count, hn::LoadU(d, a_.normals.z + j), near);
        put(du, to.number, count, hn::LoadU(du, a_.numbers + j), hn::RebindMask(du, near));
        count += hn::CountTrue(d, near);
      }
    hn::StoreU(hn::Set(d, kBeyond), d, to.x.data() + count);
    return count;
  }

  HWY_INLINE hn::Vec<D>
  outside(hn::Vec<D> p, std::size_t axis) const
  {
    const D d;
    const auto beyond = hn::Max(hn::Sub(hn::Set(d, a_.box.min[axis]), p), hn::Sub(p, hn::Set(d, a_.box.max[axis])));
    return hn::Max(beyond, hn::Zero(d));
  }

  /** Copies the candidates within the radius of point k, relative to it, and k itself behind them. */
  HWY_INLINE std::size_t
  collectNeighbors(std::size_t k, std::size_t candidates)
  {
    const D d;
    const Numbers du;
    const PointRows& from = a_.scratch->candidates;
    PointRows& to = a_.scratch->neighbors;
    const auto x = hn::Set(d, a_.points.x[k]), y = hn::Set(d, a_.points.y[k]), z = hn::Set(d, a_.points.z[k]);
    const auto own = hn::Set(du, a_.numbers[k]);
    const auto radius_sq = hn::Set(d, a_.radius_sq[k - a_.first]);
    std::size_t count = 0;
    for (std::size_t j = 0; j < candidates; j += lanes_) {
      const auto dx = hn::Sub(hn::LoadU(d, from.x.data() + j), x), dy = hn::Sub(hn::LoadU(d, from.y.data() + j), y),
                 dz = hn::Sub(hn::LoadU(d, from.z.data() + j), z);
      const auto distance_sq = mulAdd(dz, dz, mulAdd(dy, dy, hn::Mul(dx, dx)));
      const auto number = hn::LoadU(du, from.number.data() + j);
      const auto near_numbers = hn::AndNot(hn::Eq(number, own), hn::RebindMask(du, hn::Lt(distance_sq, radius_sq)));
      const auto near = hn::RebindMask(d, near_numbers);
      put(d, to.x, count, dx, near);
      put(d, to.y, count, dy, near);
      put(d, to.z, count, dz, near);
      put(d, to.nx, count, hn::LoadU(d, from.nx.data() + j), near);
      put(d, to.ny, count, hn::LoadU(d, from.ny.data() + j), near);
      put(d, to.nz, count, hn::LoadU(d, from.nz.data() + j), near);
      put(du, to.number, count, number, near_numbers);
      count += hn::CountTrue(d, near);
    }
    return count;
  }

  /** Makes the bases between k and those neighbours that are k's to look at: of each pair one end looks. */
  HWY_INLINE std::size_t
  collectBases(std::size_t k, std::size_t count)
  {
    const D d;
    const Numbers du;
    const PointRows& from = a_.scratch->neighbors;
    PointRows& to = a_.scratch->bases;
    const auto own = hn::Set(du, a_.numbers[k]), one = hn::Set(du, 1u);
    const auto half = hn::Set(d, 0.5f);
    std::size_t bases = 0;
    for (std::size_t j = 0; j < count; j += lanes_) {
      const auto number = hn::LoadU(du, from.number.data() + j);
      const auto odd = hn::Eq(hn::And(hn::Xor(number, own), one), one);
      const auto mine_numbers = hn::And(hn::Not(hn::Xor(odd, hn::Lt(own, number))), hn::FirstN(du, count - j));
      const auto mine = hn::RebindMask(d, mine_numbers);
      put(d, to.x, bases, hn::Mul(half, hn::LoadU(d, from.x.data() + j)), mine);
      put(d, to.y, bases, hn::Mul(half, hn::LoadU(d, from.y.data() + j)), mine);
      put(d, to.z, bases, hn::Mul(half, hn::LoadU(d, from.z.data() + j)), mine);
      put(d, to.nx, bases, hn::LoadU(d, from.nx.data() + j), mine);
      put(d, to.ny, bases, hn::LoadU(d, from.ny.data() + j), mine);
      put(d, to.nz, bases, hn::LoadU(d, from.nz.data() + j), mine);
      put(du, to.number, bases, number, mine_numbers);
      bases += hn::CountTrue(d, mine);
    }
    return bases;
  }

  /** The clearance of each base, 0 for those that are none, and the cosine between the normals of the pair. */
  HWY_INLINE void
  measure(std::size_t k, std::size_t count, std::size_t bases)
  {
    const D d;
    const PointRows& s = a_.scratch->neighbors;
    const PointRows& b = a_.scratch->bases;
    const float own[3] = {a_.normals.x[k], a_.normals.y[k], a_.normals.z[k]};
    const Lanes3<D> normal = {hn::Set(d, own[0]), hn::Set(d, own[1]), hn::Set(d, own[2])};
    for (std::size_t t = 0; t < bases; t += lanes_) {
      const Lanes3<D> base = {hn::LoadU(d, b.x.data() + t), hn::LoadU(d, b.y.data() + t), hn::LoadU(d, b.z.data() + t)};
      const auto to_base_sq = dot<D>(base, base);
      const auto above = dot<D>(base, normal);
      auto least_sq = hn::Sub(to_base_sq, hn::Mul(above, above)); // from k's own line
      for (std::size_t j = 0; j < count; ++j) {
        const Lanes3<D> e = {hn::Sub(base.x, hn::Set(d, s.x[j])), hn::Sub(base.y, hn::Set(d, s.y[j])), hn::Sub(base.z, hn::Set(d, s.z[j]))};
        const Lanes3<D> n = {hn::Set(d, s.nx[j]), hn::Set(d, s.ny[j]), hn::Set(d, s.nz[j])};
        const auto along = dot<D>(e, n);
        least_sq = hn::Min(least_sq, hn::Sub(dot<D>(e, e), hn::Mul(along, along)));
      }
      const Lanes3<D> other = {hn::LoadU(d, b.nx.data() + t), hn::LoadU(d, b.ny.data() + t), hn::LoadU(d, b.nz.data() + t)};
      const auto cosine = dot<D>(normal, other), aligned = hn::Abs(cosine);
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
    gaps[0] = gap(k, first, bases);
    if (first < bases) {
      const auto x = hn::Set(d, s.bases.x[first]), y = hn::Set(d, s.bases.y[first]), z = hn::Set(d, s.bases.z[first]);
      for (std::size_t t = 0; t < bases; t += lanes_) {
        const auto dx = hn::Sub(hn::LoadU(d, s.bases.x.data() + t), x), dy = hn::Sub(hn::LoadU(d, s.bases.y.data() + t), y),
                   dz = hn::Sub(hn::LoadU(d, s.bases.z.data() + t), z);
        const auto distance_sq = mulAdd(dz, dz, mulAdd(dy, dy, hn::Mul(dx, dx)));
        const auto apart = hn::Ge(distance_sq, hn::LoadU(d, s.clearance_sq.data() + t));
        hn::StoreU(hn::IfThenElseZero(apart, hn::LoadU(d, priority + t)), d, priority + t);
      }
    }
    gaps[1] = gap(k, firstOfMost(bases), bases);
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
  gap(std::size_t k, std::size_t t, std::size_t bases) const
  {
    const GapScratch& s = *a_.scratch;
    if (t == bases)
      return Gap();
    return {{a_.points.x[k] + s.bases.x[t], a_.points.y[k] + s.bases.y[t], a_.points.z[k] + s.bases.z[t]},
            s.clearance_sq[t], s.priority[t], s.bases.number[t]};
  }

  static constexpr float kBeyond = 1e18f; ///< farther than any radius, its square still finite

  const WidestGaps& a_;
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
