// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/** \file
 * \brief Floating-point operations that each kernel spends on a pair: additions, subtractions, multiplications, divisions, square
 * roots, minima and maxima in the kernels (src/core/kernels). Comparisons, masks, signs, integer work and loads are not counted, nor is
 * what the compiler takes out of the loop. The ideal loops of moments and fields spend less: there the distance serves the test alone.
 */
namespace pcl_gpf::benchmark_operations {

constexpr int kDifference = 3, kDot = 5, kAddScaled = 6;
constexpr int kDistanceSq = kDifference + kDot;
constexpr int kExpFloat = 1 + 3 + 4 + 2 * 6;   ///< clamp, rounding, remainder, polynomial of degree 6
constexpr int kExpDouble = 1 + 3 + 4 + 2 * 12; ///< the same of degree 12
constexpr int kExpGentle = 2 * 4; ///< polynomial of degree 4
constexpr int kBell = 5;

/** Distance, height, exponent, weight; deviation of the normals, squared; its weight; sum of weights; own plane's share; pull. */
constexpr int kProjectionDefault =
    kDistanceSq + kDot + 1 + kExpGentle + (kDot + 2) + (kBell + 2) + 1 + (kBell + 1 + kAddScaled + 1) + (1 + kAddScaled);
/** Distance, height, exponent, posterior; the sums of eq. 11; weight; sum of weights; pull. */
constexpr int kProjectionPaperDouble =
    kDistanceSq + kDot + 1 + kExpDouble + 1 + (1 + 1 + 2 + kAddScaled + 3 + 6 + 6) + 1 + 1 + (1 + kAddScaled);
/** Distance, cosine, deviation, exponent, weight, sum. */
constexpr int kBilateralNormals = kDistanceSq + kDot + 2 + 3 + kExpFloat + kAddScaled;
/** Distance, count, mean, scatter. */
constexpr int kMoments = kDistanceSq + 1 + 3 + 6 + 6;
/** Distance, count, deviation of the normals, squared; its weight; sum of weights; two fields. */
constexpr int kFieldSums = kDistanceSq + 1 + (kDot + 2) + (kBell + 1) + 1 + 2 * 2;
constexpr int kGaussianSums = kDistanceSq + 1 + kExpFloat + 1;
constexpr int kGaussianSumsDouble = kDistanceSq + 1 + kExpDouble + 1;
/** Distance, tangential part, its length, theta, division, sums. */
constexpr int kRepulsionWithoutExp = kDistanceSq + kDot + kAddScaled + kDot + 2 + 1 + 1 + 1 + kAddScaled;
constexpr int kRepulsion = kRepulsionWithoutExp + kExpFloat;
constexpr int kRepulsionDouble = kRepulsionWithoutExp + kExpDouble;

} // namespace pcl_gpf::benchmark_operations
