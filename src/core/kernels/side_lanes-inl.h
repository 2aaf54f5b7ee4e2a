// SPDX-License-Identifier: BSD-3-Clause
// Included once per instruction set (Highway's per-target include guard).
#if defined(PCL_GPF_SIDE_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PCL_GPF_SIDE_LANES_INL_H_
#undef PCL_GPF_SIDE_LANES_INL_H_
#else
#define PCL_GPF_SIDE_LANES_INL_H_
#endif

#include "exponential-inl.h"
#include "lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_gpf {
namespace kernels {
namespace HWY_NAMESPACE {

/** Sums of one side in registers: a stretch of the 16 lanes that data go to in turn. */
template <bool kSignInvariant>
struct SideRegisters {
  using D = hn::CappedTag<float, kQueryBlock>;
  using V = hn::Vec<D>;
  using Numbers = hn::RebindToUnsigned<D>;

  V weight, offset, largest;
  Lanes3<D> normal;
  hn::Vec<Numbers> nearest;

  HWY_INLINE
  SideRegisters()
  : weight(hn::Zero(D())), offset(hn::Zero(D())), largest(hn::Zero(D())), normal(zero3(D())), nearest(hn::Zero(Numbers()))
  {}

  /** \param[in] above heights of the query above the data's planes \param[in] near exponents of their distances */
  HWY_INLINE void
  add(const Lanes3<D>& direction, const Lanes3<D>& data_normal, hn::Vec<Numbers> number, V above, V near, hn::Mask<D> inside, float angle_falloff)
  {
    const D d;
    const V cosine = dot<D>(direction, data_normal);
    const V turn = hn::Mul(hn::Sub(hn::Set(d, 1.0f), kSignInvariant ? hn::Abs(cosine) : cosine), hn::Set(d, angle_falloff));
    const V w = hn::IfThenElseZero(inside, expNonPositive(d, hn::Sub(near, hn::Mul(turn, turn))));
    const V signed_weight = kSignInvariant ? hn::CopySign(w, cosine) : w;
    weight = hn::Add(weight, w);
    offset = mulAdd(signed_weight, above, offset);
    addScaled<D>(normal, signed_weight, data_normal);
    nearest = hn::IfThenElse(hn::RebindMask(Numbers(), hn::Gt(w, largest)), number, nearest);
    largest = hn::Max(w, largest);
  }
};

/** Sums of one side in all 16 lanes; what is told of them is the same for every width of vectors. */
class SideLanes {
public:
  using D = hn::CappedTag<float, kQueryBlock>;
  using V = hn::Vec<D>;
  using Numbers = hn::RebindToUnsigned<D>;

  template <bool kSignInvariant>
  HWY_INLINE void
  keep(const SideRegisters<kSignInvariant>& side, std::size_t part)
  {
    const D d;
    hn::StoreU(side.weight, d, weight_ + part);
    hn::StoreU(side.offset, d, offset_ + part);
    hn::StoreU(side.normal.x, d, x_ + part);
    hn::StoreU(side.normal.y, d, y_ + part);
    hn::StoreU(side.normal.z, d, z_ + part);
    hn::StoreU(side.largest, d, largest_ + part);
    hn::StoreU(side.nearest, Numbers(), nearest_ + part);
  }

  HWY_INLINE void
  write(const SideSums& to, std::size_t k, std::size_t place) const
  {
    to.weight[k][place] = total(weight_);
    to.offset[k][place] = total(offset_);
    to.normal[k].x[place] = total(x_);
    to.normal[k].y[place] = total(y_);
    to.normal[k].z[place] = total(z_);
    to.nearest[k][place] = numberOfLargest();
  }

private:
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
  numberOfLargest() const
  {
    const D d;
    const Numbers du;
    V largest = hn::LoadU(d, largest_);
    for (std::size_t part = hn::Lanes(d); part < kQueryBlock; part += hn::Lanes(d))
      largest = hn::Max(largest, hn::LoadU(d, largest_ + part));
    largest = hn::MaxOfLanes(d, largest);
    auto first = hn::Set(du, ~std::uint32_t{0});
    for (std::size_t part = 0; part < kQueryBlock; part += hn::Lanes(d)) {
      const auto lesser = hn::RebindMask(du, hn::Lt(hn::LoadU(d, largest_ + part), largest));
      first = hn::Min(first, hn::IfThenElse(lesser, first, hn::LoadU(du, nearest_ + part)));
    }
    return hn::GetLane(hn::MinOfLanes(du, first));
  }

  HWY_ALIGN float weight_[kQueryBlock], offset_[kQueryBlock], x_[kQueryBlock], y_[kQueryBlock], z_[kQueryBlock], largest_[kQueryBlock];
  HWY_ALIGN std::uint32_t nearest_[kQueryBlock];
};

} // namespace HWY_NAMESPACE
} // namespace kernels
} // namespace pcl_gpf
HWY_AFTER_NAMESPACE();

#endif
