// SPDX-License-Identifier: BSD-3-Clause
// Included once per instruction set (Highway's per-target include guard).
#if defined(PCL_GPF_GAP_ROWS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PCL_GPF_GAP_ROWS_INL_H_
#undef PCL_GPF_GAP_ROWS_INL_H_
#else
#define PCL_GPF_GAP_ROWS_INL_H_
#endif

#include "packed_points-inl.h"

#include <array>

HWY_BEFORE_NAMESPACE();
namespace pcl_gpf {
namespace kernels {
namespace HWY_NAMESPACE {

/** The points that the gap search of one patch looks at, packed, so that every lane works; positions count from the patch's middle. */
class GapRows {
public:
  using D = hn::CappedTag<float, kQueryBlock>;
  using Numbers = hn::RebindToUnsigned<D>;
  using Rows = PackedWriter<D, 6>;

  struct Counts {
    std::size_t neighbors, bases;
  };

  explicit HWY_INLINE
  GapRows(const WidestGaps& arguments)
  : a_(arguments), lanes_(hn::Lanes(D()))
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
      middle_[axis] = 0.5f * (a_.box.min[axis] + a_.box.max[axis]);
  }

  const float* middle() const { return middle_; }
  std::array<float, 3>
  position(std::size_t k) const
  {
    return {a_.points.x[k] - middle_[0], a_.points.y[k] - middle_[1], a_.points.z[k] - middle_[2]};
  }

  /** Copies those of the runs that are in reach of the patch's box. */
  HWY_INLINE std::size_t
  collectCandidates()
  {
    const D d;
    const BoxDistance<D> box(a_.box);
    const auto reach_sq = hn::Set(d, a_.largest_radius_sq);
    const Lanes3<D> middle = {hn::Set(d, middle_[0]), hn::Set(d, middle_[1]), hn::Set(d, middle_[2])};
    Rows rows = writerTo(a_.scratch->candidates);
    for (std::size_t r = 0; r < a_.run_count; ++r)
      for (std::size_t j = a_.runs[r].begin; j < a_.runs[r].end; j += lanes_) {
        const Lanes3<D> p = loadQueries(d, a_.points, j), n = loadQueries(d, a_.normals, j), from_middle = minus<D>(p, middle);
        const auto near = hn::And(hn::Le(box.squared(p), reach_sq), hn::FirstN(d, a_.runs[r].end - j));
        rows.append({from_middle.x, from_middle.y, from_middle.z, n.x, n.y, n.z}, hn::LoadU(Numbers(), a_.numbers + j), near);
      }
    hn::StoreU(hn::Set(d, kBeyond), d, a_.scratch->candidates.x.data() + rows.count());
    return rows.count();
  }

  /** The candidates within the radius of point k, which is none of them, and the bases between k and those that are k's to look at:
   * of each pair one end looks. */
  HWY_INLINE Counts
  collectNeighbors(std::size_t k, float radius_sq, std::size_t candidates)
  {
    const D d;
    const Numbers du;
    const std::array<float, 3> own_position = position(k);
    const Lanes3<D> point = {hn::Set(d, own_position[0]), hn::Set(d, own_position[1]), hn::Set(d, own_position[2])};
    const auto own = hn::Set(du, a_.numbers[k]), one = hn::Set(du, 1u), steps = hn::Iota(du, 0);
    const auto half = hn::Set(d, 0.5f), limit_sq = hn::Set(d, radius_sq);
    const Vectors<float> positions = positionsOf(a_.scratch->candidates), normals = normalsOf(a_.scratch->candidates);
    const std::uint32_t* const numbers = a_.scratch->candidates.number.data();
    std::uint32_t* const neighbors = a_.scratch->neighbors.data();
    std::size_t count = 0;
    Rows bases = writerTo(a_.scratch->bases);
    for (std::size_t j = 0; j < candidates; j += lanes_) {
      const Lanes3<D> offset = minus<D>(loadQueries(d, positions, j), point);
      const auto number = hn::LoadU(du, numbers + j);
      const auto near = hn::AndNot(hn::Eq(number, own), hn::RebindMask(du, hn::Lt(dot<D>(offset, offset), limit_sq)));
      hn::StoreU(hn::Compress(hn::Add(steps, hn::Set(du, static_cast<std::uint32_t>(j))), near), du, neighbors + count);
      count += hn::CountTrue(du, near);
      const auto odd = hn::Eq(hn::And(hn::Xor(number, own), one), one);
      const auto mine = hn::AndNot(hn::Xor(odd, hn::Lt(own, number)), near);
      const Lanes3<D> n = loadQueries(d, normals, j);
      bases.append({mulAdd(half, offset.x, point.x), mulAdd(half, offset.y, point.y), mulAdd(half, offset.z, point.z), n.x, n.y, n.z},
                   number, hn::RebindMask(d, mine));
    }
    return {count, bases.count()};
  }

  static Vectors<float>
  positionsOf(const PointRows& rows)
  {
    return {rows.x.data(), rows.y.data(), rows.z.data()};
  }
  static Vectors<float>
  normalsOf(const PointRows& rows)
  {
    return {rows.nx.data(), rows.ny.data(), rows.nz.data()};
  }

private:
  static HWY_INLINE Rows
  writerTo(PointRows& to)
  {
    return Rows({to.x.data(), to.y.data(), to.z.data(), to.nx.data(), to.ny.data(), to.nz.data()}, to.number.data());
  }

  static constexpr float kBeyond = 1e18f; ///< farther than any radius, its square still finite

  const WidestGaps& a_;
  std::size_t lanes_;
  float middle_[3];
};

} // namespace HWY_NAMESPACE
} // namespace kernels
} // namespace pcl_gpf
HWY_AFTER_NAMESPACE();

#endif
