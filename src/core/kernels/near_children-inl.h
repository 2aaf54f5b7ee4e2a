// SPDX-License-Identifier: BSD-3-Clause
// Included once per instruction set (Highway's per-target include guard).
#if defined(PCL_GPF_NEAR_CHILDREN_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PCL_GPF_NEAR_CHILDREN_INL_H_
#undef PCL_GPF_NEAR_CHILDREN_INL_H_
#else
#define PCL_GPF_NEAR_CHILDREN_INL_H_
#endif

#include "kernels.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace pcl_gpf {
namespace kernels {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/** The boxes of one node are tested together; empty ones lie at infinity and never are near. */
static void
nearChildren(const NearChildren& a)
{
  const hn::CappedTag<float, BoxPack::kBoxes> d;
  const std::size_t lanes = hn::Lanes(d);
  const auto radius_sq = hn::Set(d, a.radius_sq);
  for (std::size_t k = 0; k < a.count; ++k) {
    const BoxPack& pack = a.packs[a.nodes[k]];
    unsigned near = 0;
    for (std::size_t c = 0; c < BoxPack::kBoxes; c += lanes) {
      auto gap_sq = hn::Zero(d);
      for (int axis = 0; axis < 3; ++axis) {
        const auto above = hn::Sub(hn::LoadU(d, pack.min[axis] + c), hn::Set(d, a.box.max[static_cast<std::size_t>(axis)]));
        const auto below = hn::Sub(hn::Set(d, a.box.min[static_cast<std::size_t>(axis)]), hn::LoadU(d, pack.max[axis] + c));
        const auto gap = hn::Max(hn::Max(above, below), hn::Zero(d));
        gap_sq = hn::Add(gap_sq, hn::Mul(gap, gap));
      }
      std::uint8_t bits[8] = {};
      hn::StoreMaskBits(d, hn::Le(gap_sq, radius_sq), bits);
      near |= static_cast<unsigned>(bits[0]) << c;
    }
    a.near[k] = static_cast<std::uint8_t>(near);
  }
}

} // namespace HWY_NAMESPACE
} // namespace kernels
} // namespace pcl_gpf
HWY_AFTER_NAMESPACE();

#endif
