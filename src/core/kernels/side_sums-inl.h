// SPDX-License-Identifier: BSD-3-Clause
// Included once per instruction set (Highway's per-target include guard).
#if defined(PCL_GPF_SIDE_SUMS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PCL_GPF_SIDE_SUMS_INL_H_
#undef PCL_GPF_SIDE_SUMS_INL_H_
#else
#define PCL_GPF_SIDE_SUMS_INL_H_
#endif

#include "packed_points-inl.h"
#include "side_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_gpf {
namespace kernels {
namespace HWY_NAMESPACE {

/** Sums over the data near one query after another: balls are so small that one datum for a vector of queries would mostly miss. Data
 * are packed for a few queries, those in the ball of one again, and go to 16 lanes in turn, on narrower vectors to several of them, so
 * that sums are the same bits on every instruction set. */
template <bool kSignInvariant>
class SideLoop {
public:
  using D = hn::CappedTag<float, kQueryBlock>;
  using V = hn::Vec<D>;
  using Numbers = hn::RebindToUnsigned<D>;

  HWY_INLINE
  SideLoop(const Candidates& candidates, const SideSums& arguments)
  : candidates_(candidates), a_(arguments), lanes_(hn::Lanes(D()))
  {}

  HWY_INLINE void
  run(std::size_t begin, std::size_t end)
  {
    for (std::size_t block = begin; block < end; ++block) {
      std::size_t room = 0;
      for (std::size_t r = candidates_.run_offsets[block]; r < candidates_.run_offsets[block + 1]; ++r)
        room += candidates_.runs[r].end - candidates_.runs[r].begin;
      scratch_.reserve(room);
      const std::size_t last = HWY_MIN(candidates_.query_count, (block + 1) * kQueryBlock);
      for (std::size_t first = block * kQueryBlock; first < last; first += kTogether) {
        const std::size_t near = collect(block, first, HWY_MIN(last, first + kTogether));
        for (std::size_t q = first; q < HWY_MIN(last, first + kTogether); ++q)
          sum(q, collectInside(q, near));
      }
    }
  }

private:
  static constexpr std::size_t kTogether = 8;

  struct Scratch {
    PointRows near;   ///< in reach of a few queries
    PointRows inside; ///< of one: x is the squared distance, y the query's height above the datum's plane

    void
    reserve(std::size_t count)
    {
      constexpr std::size_t kWidest = 32;
      if (near.x.size() >= count + kWidest)
        return;
      near = PointRows(2 * (count + kWidest));
      inside = PointRows(2 * (count + kWidest));
    }
  };

  HWY_INLINE std::size_t
  collect(std::size_t block, std::size_t first, std::size_t last)
  {
    const D d;
    const Numbers du;
    const BoxDistance<D> box(a_.queries, first, last);
    const V radius_sq = hn::Set(d, a_.radius_sq);
    const auto steps = hn::Iota(du, 0);
    PointRows& to = scratch_.near;
    PackedWriter<D, 6> rows({to.x.data(), to.y.data(), to.z.data(), to.nx.data(), to.ny.data(), to.nz.data()}, to.number.data());
    for (std::size_t r = candidates_.run_offsets[block]; r < candidates_.run_offsets[block + 1]; ++r)
      for (std::size_t j = candidates_.runs[r].begin; j < candidates_.runs[r].end; j += lanes_) {
        const Lanes3<D> p = loadQueries(d, a_.data, j), n = loadQueries(d, a_.data_normals, j);
        const auto near = hn::And(hn::Lt(box.squared(p), radius_sq), hn::FirstN(d, candidates_.runs[r].end - j));
        rows.append({p.x, p.y, p.z, n.x, n.y, n.z}, hn::Add(steps, hn::Set(du, static_cast<std::uint32_t>(j))), near);
      }
    return rows.count();
  }

  HWY_INLINE std::size_t
  collectInside(std::size_t q, std::size_t near)
  {
    const D d;
    const Lanes3<D> query = {hn::Set(d, a_.queries.x[q]), hn::Set(d, a_.queries.y[q]), hn::Set(d, a_.queries.z[q])};
    const V radius_sq = hn::Set(d, a_.radius_sq);
    const PointRows& from = scratch_.near;
    const Vectors<float> positions = {from.x.data(), from.y.data(), from.z.data()}, normals = normalsOf(from);
    const std::uint32_t* const numbers = from.number.data();
    PointRows& to = scratch_.inside;
    PackedWriter<D, 5> rows({to.x.data(), to.y.data(), to.nx.data(), to.ny.data(), to.nz.data()}, to.number.data());
    for (std::size_t j = 0; j < near; j += lanes_) {
      const Lanes3<D> apart = minus<D>(query, loadQueries(d, positions, j)), n = loadQueries(d, normals, j);
      const V distance_sq = dot<D>(apart, apart);
      const auto inside = hn::And(hn::Lt(distance_sq, radius_sq), hn::FirstN(d, near - j));
      rows.append({distance_sq, dot<D>(apart, n), n.x, n.y, n.z}, hn::LoadU(Numbers(), numbers + j), inside);
    }
    return rows.count();
  }

  HWY_INLINE void
  sum(std::size_t q, std::size_t count)
  {
    const D d;
    Lanes3<D> directions[2];
    for (std::size_t k = 0; k < 2; ++k)
      directions[k] = {hn::Set(d, a_.directions[k].x[q]), hn::Set(d, a_.directions[k].y[q]), hn::Set(d, a_.directions[k].z[q])};
    SideLanes sides[2];
    for (std::size_t part = 0; part < kQueryBlock; part += lanes_)
      sumPart(directions, part, count, sides);
    for (std::size_t k = 0; k < 2; ++k)
      sides[k].write(a_, k, q - a_.first_output);
  }

  HWY_INLINE void
  sumPart(const Lanes3<D> (&directions)[2], std::size_t part, std::size_t count, SideLanes (&sums)[2]) const
  {
    const D d;
    const Numbers du;
    const float* const distance_sq = scratch_.inside.x.data();
    const float* const height = scratch_.inside.y.data();
    const std::uint32_t* const numbers = scratch_.inside.number.data();
    const Vectors<float> normals = normalsOf(scratch_.inside);
    const V scale = hn::Set(d, -a_.falloff / a_.radius_sq);
    SideRegisters<kSignInvariant> first, second;
    for (std::size_t j = part; j < count; j += kQueryBlock) {
      const auto inside = hn::FirstN(d, count - j);
      const V near = hn::Mul(hn::LoadU(d, distance_sq + j), scale), above = hn::LoadU(d, height + j);
      const Lanes3<D> normal = loadQueries(d, normals, j);
      const auto number = hn::LoadU(du, numbers + j);
      first.add(directions[0], normal, number, above, near, inside, a_.angle_falloff);
      second.add(directions[1], normal, number, above, near, inside, a_.angle_falloff);
    }
    sums[0].keep(first, part);
    sums[1].keep(second, part);
  }

  static HWY_INLINE Vectors<float>
  normalsOf(const PointRows& rows)
  {
    return {rows.nx.data(), rows.ny.data(), rows.nz.data()};
  }

  const Candidates& candidates_;
  const SideSums& a_;
  std::size_t lanes_;
  Scratch scratch_;
};

} // namespace HWY_NAMESPACE
} // namespace kernels
} // namespace pcl_gpf
HWY_AFTER_NAMESPACE();

#endif
