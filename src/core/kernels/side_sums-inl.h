// SPDX-License-Identifier: BSD-3-Clause
// Included once per instruction set (Highway's per-target include guard).
#if defined(PCL_GPF_SIDE_SUMS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PCL_GPF_SIDE_SUMS_INL_H_
#undef PCL_GPF_SIDE_SUMS_INL_H_
#else
#define PCL_GPF_SIDE_SUMS_INL_H_
#endif

#include "exponential-inl.h"
#include "packed_points-inl.h"

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

  /** Sums of one side, a lane a stretch of memory each. */
  struct Lanes {
    HWY_ALIGN float weight[kQueryBlock], offset[kQueryBlock], x[kQueryBlock], y[kQueryBlock], z[kQueryBlock], largest[kQueryBlock];
    HWY_ALIGN std::uint32_t nearest[kQueryBlock];
  };

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
    Lanes sides[2];
    for (std::size_t part = 0; part < kQueryBlock; part += lanes_)
      sumPart(directions, part, count, sides);
    for (std::size_t k = 0; k < 2; ++k) {
      const std::size_t out = q - a_.first_output;
      a_.weight[k][out] = total(sides[k].weight);
      a_.offset[k][out] = total(sides[k].offset);
      a_.normal[k].x[out] = total(sides[k].x);
      a_.normal[k].y[out] = total(sides[k].y);
      a_.normal[k].z[out] = total(sides[k].z);
      a_.nearest[k][out] = numberOfLargest(sides[k]);
    }
  }

  /** One side in registers. */
  struct Side {
    V weight, offset, largest;
    Lanes3<D> normal;
    hn::Vec<Numbers> nearest;
  };

  HWY_INLINE void
  sumPart(const Lanes3<D> (&directions)[2], std::size_t part, std::size_t count, Lanes (&sums)[2]) const
  {
    const D d;
    const Numbers du;
    const float* const distance_sq = scratch_.inside.x.data();
    const float* const height = scratch_.inside.y.data();
    const std::uint32_t* const numbers = scratch_.inside.number.data();
    const Vectors<float> normals = normalsOf(scratch_.inside);
    const V scale = hn::Set(d, -a_.falloff / a_.radius_sq);
    Side first = {hn::Zero(d), hn::Zero(d), hn::Zero(d), zero3(d), hn::Zero(du)}, second = first;
    for (std::size_t j = part; j < count; j += kQueryBlock) {
      const auto inside = hn::FirstN(d, count - j);
      const V near = hn::Mul(hn::LoadU(d, distance_sq + j), scale), above = hn::LoadU(d, height + j);
      const Lanes3<D> normal = loadQueries(d, normals, j);
      const auto number = hn::LoadU(du, numbers + j);
      add(directions[0], normal, number, above, near, inside, first);
      add(directions[1], normal, number, above, near, inside, second);
    }
    keep(first, part, sums[0]);
    keep(second, part, sums[1]);
  }

  HWY_INLINE void
  add(const Lanes3<D>& direction, const Lanes3<D>& normal, hn::Vec<Numbers> number, V above, V near, hn::Mask<D> inside, Side& side) const
  {
    const D d;
    const V cosine = dot<D>(direction, normal);
    const V turn = hn::Mul(hn::Sub(hn::Set(d, 1.0f), kSignInvariant ? hn::Abs(cosine) : cosine), hn::Set(d, a_.angle_falloff));
    const V weight = hn::IfThenElseZero(inside, expNonPositive(d, hn::Sub(near, hn::Mul(turn, turn))));
    const V signed_weight = kSignInvariant ? hn::CopySign(weight, cosine) : weight;
    side.weight = hn::Add(side.weight, weight);
    side.offset = mulAdd(signed_weight, above, side.offset);
    addScaled<D>(side.normal, signed_weight, normal);
    side.nearest = hn::IfThenElse(hn::RebindMask(Numbers(), hn::Gt(weight, side.largest)), number, side.nearest);
    side.largest = hn::Max(weight, side.largest);
  }

  static HWY_INLINE void
  keep(const Side& side, std::size_t part, Lanes& to)
  {
    const D d;
    hn::StoreU(side.weight, d, to.weight + part);
    hn::StoreU(side.offset, d, to.offset + part);
    hn::StoreU(side.normal.x, d, to.x + part);
    hn::StoreU(side.normal.y, d, to.y + part);
    hn::StoreU(side.normal.z, d, to.z + part);
    hn::StoreU(side.largest, d, to.largest + part);
    hn::StoreU(side.nearest, Numbers(), to.nearest + part);
  }

  /** In one order for every width of vectors. */
  static HWY_INLINE float
  total(const float* lanes)
  {
    const hn::CappedTag<float, 4> d;
    HWY_ALIGN float quarters[4];
    for (std::size_t k = 0; k < 4; k += hn::Lanes(d))
      hn::StoreU(hn::Add(hn::Add(hn::LoadU(d, lanes + k), hn::LoadU(d, lanes + k + 8)),
                         hn::Add(hn::LoadU(d, lanes + k + 4), hn::LoadU(d, lanes + k + 12))), d, quarters + k);
    return (quarters[0] + quarters[2]) + (quarters[1] + quarters[3]);
  }

  /** The first of the data that weigh most. */
  HWY_INLINE std::uint32_t
  numberOfLargest(const Lanes& side) const
  {
    const D d;
    const Numbers du;
    V largest = hn::LoadU(d, side.largest);
    for (std::size_t part = lanes_; part < kQueryBlock; part += lanes_)
      largest = hn::Max(largest, hn::LoadU(d, side.largest + part));
    largest = hn::MaxOfLanes(d, largest);
    auto first = hn::Set(du, ~std::uint32_t{0});
    for (std::size_t part = 0; part < kQueryBlock; part += lanes_) {
      const auto lesser = hn::RebindMask(du, hn::Lt(hn::LoadU(d, side.largest + part), largest));
      first = hn::Min(first, hn::IfThenElse(lesser, first, hn::LoadU(du, side.nearest + part)));
    }
    return hn::GetLane(hn::MinOfLanes(du, first));
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
