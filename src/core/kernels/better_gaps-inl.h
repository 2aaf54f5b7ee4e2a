// SPDX-License-Identifier: BSD-3-Clause
// Included once per instruction set (Highway's per-target include guard).
#if defined(PCL_GPF_BETTER_GAPS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PCL_GPF_BETTER_GAPS_INL_H_
#undef PCL_GPF_BETTER_GAPS_INL_H_
#else
#define PCL_GPF_BETTER_GAPS_INL_H_
#endif

#include "lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_gpf {
namespace kernels {
namespace HWY_NAMESPACE {

static void
betterGaps(const BetterGaps& a)
{
  const hn::CappedTag<float, kQueryBlock> d;
  const hn::RebindToUnsigned<decltype(d)> du;
  const std::size_t lanes = hn::Lanes(d);
  const auto steps = hn::Iota(du, 0);
  std::size_t count = 0;
  for (std::size_t k = a.first; k < a.last; ++k) {
    const auto x = hn::Set(d, a.bases.x[k]), y = hn::Set(d, a.bases.y[k]), z = hn::Set(d, a.bases.z[k]);
    const auto clearance_sq = hn::Set(d, a.clearance_sq[k]), priority = hn::Set(d, a.priority[k]);
    const auto own = hn::Set(du, static_cast<std::uint32_t>(k));
    for (std::size_t r = 0; r < a.run_count; ++r)
      for (std::size_t j = a.runs[r].begin; j < a.runs[r].end; j += lanes) {
        const auto dx = hn::Sub(hn::LoadU(d, a.bases.x + j), x), dy = hn::Sub(hn::LoadU(d, a.bases.y + j), y),
                   dz = hn::Sub(hn::LoadU(d, a.bases.z + j), z);
        const auto distance_sq = mulAdd(dz, dz, mulAdd(dy, dy, hn::Mul(dx, dx)));
        const auto other = hn::LoadU(d, a.priority + j);
        const auto number = hn::Add(steps, hn::Set(du, static_cast<std::uint32_t>(j)));
        const auto before = hn::RebindMask(d, hn::Lt(number, own));
        const auto better = hn::Or(hn::Gt(other, priority), hn::And(hn::Eq(other, priority), before));
        const auto within = hn::And(hn::And(hn::Lt(distance_sq, clearance_sq), better), hn::FirstN(d, a.runs[r].end - j));
        const auto found = hn::RebindMask(du, within);
        hn::StoreU(hn::Compress(number, found), du, a.better + count);
        count += hn::CountTrue(du, found);
      }
    a.row_end[k - a.first] = static_cast<std::uint32_t>(count);
  }
}

} // namespace HWY_NAMESPACE
} // namespace kernels
} // namespace pcl_gpf
HWY_AFTER_NAMESPACE();

#endif
