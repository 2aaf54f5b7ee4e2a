// SPDX-License-Identifier: BSD-3-Clause
// Included once per instruction set (Highway's per-target include guard).
#if defined(PCL_GPF_BETTER_GAPS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PCL_GPF_BETTER_GAPS_INL_H_
#undef PCL_GPF_BETTER_GAPS_INL_H_
#else
#define PCL_GPF_BETTER_GAPS_INL_H_
#endif

#include "packed_points-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_gpf {
namespace kernels {
namespace HWY_NAMESPACE {

/** The search for better gaps of one patch: rivals are packed once for the patch and again for a few gaps, so that every lane works. */
class BetterLoop {
public:
  using D = hn::CappedTag<float, kQueryBlock>;
  using Numbers = hn::RebindToUnsigned<D>;

  explicit HWY_INLINE
  BetterLoop(const BetterGaps& arguments)
  : a_(arguments), lanes_(hn::Lanes(D()))
  {}

  HWY_INLINE void
  run()
  {
    const std::size_t rivals = collectRivals();
    std::size_t count = 0;
    for (std::size_t first = a_.first; first < a_.last; first += kTogether) {
      const std::size_t last = HWY_MIN(a_.last, first + kTogether), near = narrow(first, last, rivals);
      for (std::size_t k = first; k < last; ++k) {
        count += better(k, near, a_.better + count);
        a_.row_end[k - a_.first] = static_cast<std::uint32_t>(count);
      }
    }
  }

private:
  static constexpr std::size_t kTogether = 8;

  using Rows = PackedWriter<D, 4>;

  /** Copies those of the runs that are within the clearances of the patch. */
  HWY_INLINE std::size_t
  collectRivals()
  {
    const D d;
    const Numbers du;
    const BoxDistance<D> box(a_.bases, a_.first, a_.last);
    const auto widest_sq = hn::Set(d, widestSq(a_.first, a_.last));
    const auto steps = hn::Iota(du, 0);
    RivalRows& wide = a_.scratch->wide;
    Rows rows({wide.x.data(), wide.y.data(), wide.z.data(), wide.priority.data()}, wide.number.data());
    for (std::size_t r = 0; r < a_.run_count; ++r)
      for (std::size_t j = a_.runs[r].begin; j < a_.runs[r].end; j += lanes_) {
        const Lanes3<D> base = loadQueries(d, a_.bases, j);
        const auto near = hn::And(hn::Lt(box.squared(base), widest_sq), hn::FirstN(d, a_.runs[r].end - j));
        rows.append({base.x, base.y, base.z, hn::LoadU(d, a_.priority + j)},
                    hn::Add(steps, hn::Set(du, static_cast<std::uint32_t>(j))), near);
      }
    return rows.count();
  }

  /** Copies those within the clearances of a few gaps. */
  HWY_INLINE std::size_t
  narrow(std::size_t first, std::size_t last, std::size_t rivals)
  {
    const D d;
    const BoxDistance<D> box(a_.bases, first, last);
    const auto widest_sq = hn::Set(d, widestSq(first, last));
    const RivalRows& from = a_.scratch->wide;
    const Vectors<float> bases = {from.x.data(), from.y.data(), from.z.data()};
    const float* const priorities = from.priority.data();
    const std::uint32_t* const numbers = from.number.data();
    RivalRows& to = a_.scratch->narrow;
    Rows rows({to.x.data(), to.y.data(), to.z.data(), to.priority.data()}, to.number.data());
    for (std::size_t j = 0; j < rivals; j += lanes_) {
      const Lanes3<D> base = loadQueries(d, bases, j);
      const auto near = hn::And(hn::Lt(box.squared(base), widest_sq), hn::FirstN(d, rivals - j));
      rows.append({base.x, base.y, base.z, hn::LoadU(d, priorities + j)}, hn::LoadU(Numbers(), numbers + j), near);
    }
    return rows.count();
  }

  HWY_INLINE float
  widestSq(std::size_t first, std::size_t last) const
  {
    float widest_sq = a_.clearance_sq[first];
    for (std::size_t k = first + 1; k < last; ++k)
      widest_sq = HWY_MAX(widest_sq, a_.clearance_sq[k]);
    return widest_sq;
  }

  /** The row of one gap. */
  HWY_INLINE std::size_t
  better(std::size_t k, std::size_t near, std::uint32_t* to) const
  {
    const D d;
    const Numbers du;
    const RivalRows& from = a_.scratch->narrow;
    const Vectors<float> bases = {from.x.data(), from.y.data(), from.z.data()};
    const Lanes3<D> own_base = {hn::Set(d, a_.bases.x[k]), hn::Set(d, a_.bases.y[k]), hn::Set(d, a_.bases.z[k])};
    const auto clearance_sq = hn::Set(d, a_.clearance_sq[k]), priority = hn::Set(d, a_.priority[k]);
    const auto own = hn::Set(du, static_cast<std::uint32_t>(k));
    std::size_t count = 0;
    for (std::size_t j = 0; j < near; j += lanes_) {
      const Lanes3<D> apart = minus<D>(loadQueries(d, bases, j), own_base);
      const auto other = hn::LoadU(d, from.priority.data() + j);
      const auto number = hn::LoadU(du, from.number.data() + j);
      const auto before = hn::RebindMask(d, hn::Lt(number, own));
      const auto is_better = hn::Or(hn::Gt(other, priority), hn::And(hn::Eq(other, priority), before));
      const auto within = hn::And(hn::And(hn::Lt(dot<D>(apart, apart), clearance_sq), is_better), hn::FirstN(d, near - j));
      const auto found = hn::RebindMask(du, within);
      hn::StoreU(hn::Compress(number, found), du, to + count);
      count += hn::CountTrue(du, found);
    }
    return count;
  }

  const BetterGaps& a_;
  std::size_t lanes_;
};

static void
betterGaps(const BetterGaps& a)
{
  BetterLoop(a).run();
}

} // namespace HWY_NAMESPACE
} // namespace kernels
} // namespace pcl_gpf
HWY_AFTER_NAMESPACE();

#endif
