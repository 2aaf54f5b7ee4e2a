// SPDX-License-Identifier: BSD-3-Clause
// Included once per instruction set (Highway's per-target include guard).
#if defined(PCL_GPF_PACKED_POINTS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PCL_GPF_PACKED_POINTS_INL_H_
#undef PCL_GPF_PACKED_POINTS_INL_H_
#else
#define PCL_GPF_PACKED_POINTS_INL_H_
#endif

#include "lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_gpf {
namespace kernels {
namespace HWY_NAMESPACE {

/** Distances from a box. Rounding is monotone: no more than those from any point inside, computed by dot() of differences. */
template <class D>
class BoxDistance {
public:
  explicit HWY_INLINE
  BoxDistance(const FloatBox& box)
  {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      min_[axis] = box.min[axis];
      max_[axis] = box.max[axis];
    }
  }

  /** From the box of points [first, last). */
  HWY_INLINE
  BoxDistance(const Vectors<float>& points, std::size_t first, std::size_t last)
  : min_{points.x[first], points.y[first], points.z[first]}, max_{min_[0], min_[1], min_[2]}
  {
    for (std::size_t k = first + 1; k < last; ++k) {
      const float p[3] = {points.x[k], points.y[k], points.z[k]};
      for (int axis = 0; axis < 3; ++axis) {
        min_[axis] = HWY_MIN(min_[axis], p[axis]);
        max_[axis] = HWY_MAX(max_[axis], p[axis]);
      }
    }
  }

  HWY_INLINE hn::Vec<D>
  squared(const Lanes3<D>& p) const
  {
    const Lanes3<D> outside = {beyond(p.x, 0), beyond(p.y, 1), beyond(p.z, 2)};
    return dot<D>(outside, outside);
  }

private:
  HWY_INLINE hn::Vec<D>
  beyond(hn::Vec<D> p, int axis) const
  {
    const D d;
    return hn::Max(hn::Max(hn::Sub(hn::Set(d, min_[axis]), p), hn::Sub(p, hn::Set(d, max_[axis]))), hn::Zero(d));
  }

  float min_[3], max_[3];
};

/** Appends the lanes of a mask to arrays, one after another, and anything behind them. Holds copies of the arrays' addresses, which
 * otherwise would be read again after each store. */
template <class D, std::size_t kArrays>
class PackedWriter {
public:
  using Numbers = hn::RebindToUnsigned<D>;

  HWY_INLINE
  PackedWriter(float* const (&arrays)[kArrays], std::uint32_t* numbers)
  : numbers_(numbers)
  {
    for (std::size_t k = 0; k < kArrays; ++k)
      arrays_[k] = arrays[k];
  }

  HWY_INLINE void
  append(const hn::Vec<D> (&values)[kArrays], hn::Vec<Numbers> number, hn::Mask<D> mask)
  {
    for (std::size_t k = 0; k < kArrays; ++k)
      hn::StoreU(hn::Compress(values[k], mask), D(), arrays_[k] + count_);
    const Numbers du;
    hn::StoreU(hn::Compress(number, hn::RebindMask(du, mask)), du, numbers_ + count_);
    count_ += hn::CountTrue(D(), mask);
  }

  std::size_t count() const { return count_; }

private:
  float* arrays_[kArrays];
  std::uint32_t* numbers_;
  std::size_t count_ = 0;
};

} // namespace HWY_NAMESPACE
} // namespace kernels
} // namespace pcl_gpf
HWY_AFTER_NAMESPACE();

#endif
