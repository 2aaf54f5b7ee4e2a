// SPDX-License-Identifier: BSD-3-Clause
// Included once per instruction set (Highway's per-target include guard).
#if defined(PCL_GPF_EXPONENTIAL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PCL_GPF_EXPONENTIAL_INL_H_
#undef PCL_GPF_EXPONENTIAL_INL_H_
#else
#define PCL_GPF_EXPONENTIAL_INL_H_
#endif

#include "lanes-inl.h"

#include <cmath>

HWY_BEFORE_NAMESPACE();
namespace pcl_gpf {
namespace kernels {
namespace HWY_NAMESPACE {

/** exp(x) for x <= 0. Relative error below 3e-7 in float and 4e-16 in double; 0 below -87.3 and -708.4.
 *
 * x = n ln 2 + r with |r| <= ln 2 / 2; Taylor polynomial of exp(r); n goes into the exponent bits. Adding and subtracting 1.5 * 2^23
 * (2^52) rounds to an integer, which is then found in the low bits of the sum. */
template <class D>
HWY_INLINE hn::Vec<D>
expNonPositive(D d, hn::Vec<D> x)
{
  using Real = hn::TFromD<D>;
  constexpr bool kDouble = sizeof(Real) == 8;
  constexpr int kMantissaBits = kDouble ? 52 : 23;
  const auto lowest = hn::Set(d, static_cast<Real>(kDouble ? -708.4 : -87.3));
  const auto rounding = hn::Set(d, static_cast<Real>(kDouble ? 6755399441055744.0 : 12582912.0));
  const auto underflow = hn::Lt(x, lowest);
  x = hn::Max(x, lowest);
  const auto shifted = mulAdd(x, hn::Set(d, static_cast<Real>(1.4426950408889634)), rounding);
  const auto n = hn::Sub(shifted, rounding);
  // ln 2 in two parts; the first has so few bits that its product with n is exact.
  const Real ln2_high = static_cast<Real>(kDouble ? 6.93147180369123816490e-01 : 0.693359375);
  const Real ln2_low = static_cast<Real>(kDouble ? 1.90821492927058770002e-10 : -2.12194440e-4);
  auto r = hn::Sub(x, hn::Mul(n, hn::Set(d, ln2_high)));
  r = hn::Sub(r, hn::Mul(n, hn::Set(d, ln2_low)));
  constexpr double kInverseFactorial[] = {1.0,
                                          1.0,
                                          0.5,
                                          1.0 / 6,
                                          1.0 / 24,
                                          1.0 / 120,
                                          1.0 / 720,
                                          1.0 / 5040,
                                          1.0 / 40320,
                                          1.0 / 362880,
                                          1.0 / 3628800,
                                          1.0 / 39916800,
                                          1.0 / 479001600};
  constexpr int kDegree = kDouble ? 12 : 6;
  auto p = hn::Set(d, static_cast<Real>(kInverseFactorial[kDegree]));
  for (int k = kDegree - 1; k >= 0; --k)
    p = mulAdd(p, r, hn::Set(d, static_cast<Real>(kInverseFactorial[k])));
  const hn::RebindToSigned<D> di;
  const auto exponent = hn::ShiftLeft<kMantissaBits>(hn::BitCast(di, shifted));
  const auto scaled = hn::BitCast(d, hn::Add(hn::BitCast(di, p), exponent));
  return hn::IfThenZeroElse(underflow, scaled);
}

/** Largest falloff that expGentle() serves; a hair above one half, which the default is, for the sake of rounding. */
constexpr double kGentlest = 0.50001;

/** exp(x) for -kGentlest <= x <= 0, relative error below 8e-7: a polynomial alone, a third of the work of the whole range. */
template <class D>
HWY_INLINE hn::Vec<D>
expGentle(D d, hn::Vec<D> x)
{
  constexpr double kCoefficients[] = {0.9999994987, 0.9999531223, 0.4992755926, 0.1626664295, 0.03235888947};
  auto p = hn::Set(d, static_cast<hn::TFromD<D>>(kCoefficients[4]));
  for (int k = 3; k >= 0; --k)
    p = mulAdd(p, x, hn::Set(d, static_cast<hn::TFromD<D>>(kCoefficients[k])));
  return p;
}

/** share * exp(-u^2) in shape: share (1 - u^2 / 4)^4 for u < 2, else 0, of u = falloff * x; share at 0, 0.32 share at u = 1 (exp:
 * 0.37). Share and falloff are drawn into the fourth power, which leaves five operations. */
template <class D>
struct Bell {
  hn::Vec<D> top, slope;

  HWY_INLINE
  Bell(D d, double share, double falloff)
  : top(hn::Set(d, static_cast<hn::TFromD<D>>(std::sqrt(std::sqrt(share)))))
  , slope(hn::Set(d, static_cast<hn::TFromD<D>>(std::sqrt(std::sqrt(share)) * 0.25 * falloff * falloff)))
  {}

  HWY_INLINE hn::Vec<D>
  operator()(D d, hn::Vec<D> x_sq) const
  {
    const auto t = hn::Max(hn::Sub(top, hn::Mul(x_sq, slope)), hn::Zero(d));
    const auto t_sq = hn::Mul(t, t);
    return hn::Mul(t_sq, t_sq);
  }
};

} // namespace HWY_NAMESPACE
} // namespace kernels
} // namespace pcl_gpf
HWY_AFTER_NAMESPACE();

#endif
