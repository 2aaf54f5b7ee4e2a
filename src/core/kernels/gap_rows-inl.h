// SPDX-License-Identifier: BSD-3-Clause
// Included once per instruction set (Highway's per-target include guard).
#if defined(PCL_GPF_GAP_ROWS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PCL_GPF_GAP_ROWS_INL_H_
#undef PCL_GPF_GAP_ROWS_INL_H_
#else
#define PCL_GPF_GAP_ROWS_INL_H_
#endif

#include "lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_gpf {
namespace kernels {
namespace HWY_NAMESPACE {

/** The points that the gap search of one patch looks at, packed, so that every lane works. */
class GapRows {
public:
  using D = hn::CappedTag<float, kQueryBlock>;
  using Numbers = hn::RebindToUnsigned<D>;

  explicit HWY_INLINE
  GapRows(const WidestGaps& arguments)
  : a_(arguments), lanes_(hn::Lanes(D()))
  {}

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
        count += putRows(to, count, p, loadQueries(d, a_.normals, j), hn::LoadU(du, a_.numbers + j), near);
      }
    hn::StoreU(hn::Set(d, kBeyond), d, to.x.data() + count);
    return count;
  }

  /** Copies the candidates within the radius of point k, relative to it; k itself is none of them. */
  HWY_INLINE std::size_t
  collectNeighbors(std::size_t k, std::size_t candidates)
  {
    const D d;
    const Numbers du;
    const PointRows& from = a_.scratch->candidates;
    PointRows& to = a_.scratch->neighbors;
    const Lanes3<D> point = {hn::Set(d, a_.points.x[k]), hn::Set(d, a_.points.y[k]), hn::Set(d, a_.points.z[k])};
    const auto own = hn::Set(du, a_.numbers[k]);
    const auto radius_sq = hn::Set(d, a_.radius_sq[k - a_.first]);
    std::size_t count = 0;
    for (std::size_t j = 0; j < candidates; j += lanes_) {
      const Lanes3<D> offset = minus<D>(positions(from, j), point);
      const auto number = hn::LoadU(du, from.number.data() + j);
      const auto near = hn::AndNot(hn::Eq(number, own), hn::RebindMask(du, hn::Lt(dot<D>(offset, offset), radius_sq)));
      count += putRows(to, count, offset, normals(from, j), number, hn::RebindMask(d, near));
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
      const auto mine = hn::And(hn::Not(hn::Xor(odd, hn::Lt(own, number))), hn::FirstN(du, count - j));
      const Lanes3<D> p = positions(from, j);
      bases += putRows(to, bases, {hn::Mul(half, p.x), hn::Mul(half, p.y), hn::Mul(half, p.z)}, normals(from, j), number,
                       hn::RebindMask(d, mine));
    }
    return bases;
  }

  static HWY_INLINE Lanes3<D>
  positions(const PointRows& from, std::size_t j)
  {
    const D d;
    return {hn::LoadU(d, from.x.data() + j), hn::LoadU(d, from.y.data() + j), hn::LoadU(d, from.z.data() + j)};
  }

  static HWY_INLINE Lanes3<D>
  normals(const PointRows& from, std::size_t j)
  {
    const D d;
    return {hn::LoadU(d, from.nx.data() + j), hn::LoadU(d, from.ny.data() + j), hn::LoadU(d, from.nz.data() + j)};
  }

private:
  /** Writes the lanes of the mask, one after another, and anything behind them. */
  template <class Tag>
  static HWY_INLINE void
  put(Tag d, AlignedArray<hn::TFromD<Tag>>& to, std::size_t at, hn::Vec<Tag> values, hn::Mask<Tag> mask)
  {
    hn::StoreU(hn::Compress(values, mask), d, to.data() + at);
  }

  /** The same for whole rows. \return how many were written */
  HWY_INLINE std::size_t
  putRows(PointRows& to, std::size_t at, const Lanes3<D>& p, const Lanes3<D>& n, hn::Vec<Numbers> number, hn::Mask<D> mask)
  {
    const D d;
    const Numbers du;
    put(d, to.x, at, p.x, mask);
    put(d, to.y, at, p.y, mask);
    put(d, to.z, at, p.z, mask);
    put(d, to.nx, at, n.x, mask);
    put(d, to.ny, at, n.y, mask);
    put(d, to.nz, at, n.z, mask);
    put(du, to.number, at, number, hn::RebindMask(du, mask));
    return hn::CountTrue(d, mask);
  }

  HWY_INLINE hn::Vec<D>
  outside(hn::Vec<D> p, std::size_t axis) const
  {
    const D d;
    const auto beyond = hn::Max(hn::Sub(hn::Set(d, a_.box.min[axis]), p), hn::Sub(p, hn::Set(d, a_.box.max[axis])));
    return hn::Max(beyond, hn::Zero(d));
  }

  static constexpr float kBeyond = 1e18f; ///< farther than any radius, its square still finite

  const WidestGaps& a_;
  std::size_t lanes_;
};

} // namespace HWY_NAMESPACE
} // namespace kernels
} // namespace pcl_gpf
HWY_AFTER_NAMESPACE();

#endif
