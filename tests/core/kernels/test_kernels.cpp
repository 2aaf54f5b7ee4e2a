// SPDX-License-Identifier: BSD-3-Clause
#include "kernel_cases.h"

#include <gtest/gtest.h>

#include <limits>
#include <numeric>

namespace pcl_gpf::test {
namespace {

struct Sizes {
  std::size_t queries, data;
};
const Sizes kSizes[] = {{1, 1}, {1, 300}, {15, 15}, {16, 16}, {16, 0}, {17, 1500}, {300, 17}, {500, 500}};

template <typename Real>
class Kernels : public ::testing::Test {};
using Reals = ::testing::Types<float, double>;
TYPED_TEST_SUITE(Kernels, Reals);

template <typename Visit>
void
forEveryLayout(const Visit& visit)
{
  for (const Sizes& sizes : kSizes)
    for (const bool lists : {false, true})
      visit(sizes, lists);
}

TYPED_TEST(Kernels, giveTheSameBitsOnEveryInstructionSet)
{
  using Real = TypeParam;
  const auto targets = usableKernels();
  ASSERT_STREQ(targets.back()->name, "scalar");
  forEveryLayout([&](const Sizes& sizes, bool lists) {
    const KernelInput<Real> in(sizes.queries, sizes.data, lists, sizes.queries + sizes.data);
    forEveryCase<Real>([&](const auto& kernel) {
      KernelOutput<Real> expected(in.query_count, kernel.channels());
      kernel.run(*targets.back()->set, in, expected);
      for (const auto* target : targets) {
        KernelOutput<Real> out(in.query_count, kernel.channels());
        kernel.run(*target->set, in, out);
        EXPECT_TRUE(out.sameBits(expected)) << kernel.name() << " on " << target->name << ", " << sizes.queries << " queries, "
                                            << sizes.data << " data, " << (lists ? "lists" : "runs");
      }
    });
  });
}

/** Compares the sums of one query; false when rounding leaves open whether a pair is within the radius. */
template <typename Real, typename Case>
bool
checkQuery(const KernelInput<Real>& in, const Case& kernel, const KernelOutput<Real>& out, std::size_t q)
{
  constexpr double kEpsilon = std::numeric_limits<Real>::epsilon();
  std::vector<Term> sums(kernel.channels(), Term{0, 0});
  std::size_t inside = 0;
  for (const std::uint32_t j : in.candidates[q]) {
    const double radius_sq = kernel.radiusSq(in, q, j);
    const Pair pair = pairOf(in, q, j, radius_sq);
    if (std::abs(pair.r_sq / radius_sq - 1) < 8 * kEpsilon)
      return false;
    if (pair.r_sq > radius_sq)
      continue;
    ++inside;
    const std::vector<Term> terms = kernel.terms(pair);
    for (std::size_t c = 0; c < terms.size(); ++c) {
      sums[c].value += terms[c].value;
      sums[c].scale += terms[c].scale;
    }
  }
  // A rounding for each addition and those within a term; an exponential below the range of Real is 0.
  const double roundings = (24 + 0.5 * static_cast<double>(inside)) * kEpsilon + kernel.exp_error;
  const double underflow = 2.0 * static_cast<double>(inside) * static_cast<double>(std::numeric_limits<Real>::min());
  for (std::size_t c = 0; c < sums.size(); ++c)
    EXPECT_NEAR(static_cast<double>(out.value(c, q)), sums[c].value, roundings * sums[c].scale + underflow)
        << kernel.name() << ", sum " << c << " of query " << q << ", " << inside << " pairs";
  return true;
}

TYPED_TEST(Kernels, agreeWithTheirFormulasWrittenOutInDouble)
{
  using Real = TypeParam;
  std::size_t checked = 0, undecided = 0;
  forEveryLayout([&](const Sizes& sizes, bool lists) {
    const KernelInput<Real> in(sizes.queries, sizes.data, lists, 3 * sizes.queries + sizes.data);
    forEveryCase<Real>([&](const auto& kernel) {
      KernelOutput<Real> out(in.query_count, kernel.channels());
      kernel.run(*usableKernels().front()->set, in, out);
      for (std::size_t q = 0; q < in.query_count && !::testing::Test::HasFailure(); ++q)
        ++(checkQuery(in, kernel, out, q) ? checked : undecided);
    });
  });
  EXPECT_GT(checked, 20000u);
  EXPECT_LT(undecided, checked / 500);
}

TYPED_TEST(Kernels, readButDoNotUseWhatLiesBehindThePaddedDatum)
{
  using Real = TypeParam;
  for (const bool lists : {false, true}) {
    const KernelInput<Real> in(100, 50, lists, 4);
    KernelInput<Real> poisoned(100, 50, lists, 4);
    for (std::size_t i = 51; i < 50 + kQueryBlock; ++i) // behind the datum that stands for none
      for (SortedVectors<Real>* arrays : {&poisoned.data, &poisoned.data_normals})
        for (AlignedArray<Real>* axis : {&arrays->x, &arrays->y, &arrays->z})
          (*axis)[i] = i % 2 == 0 ? std::numeric_limits<Real>::quiet_NaN() : Real(0.5);
    forEveryCase<Real>([&](const auto& kernel) {
      for (const auto* target : usableKernels()) {
        KernelOutput<Real> expected(in.query_count, kernel.channels()), out(in.query_count, kernel.channels());
        kernel.run(*target->set, in, expected);
        kernel.run(*target->set, poisoned, out);
        EXPECT_TRUE(out.sameBits(expected)) << kernel.name() << " on " << target->name;
      }
    });
  }
}

TYPED_TEST(Kernels, workOnPartOfTheBlocks)
{
  using Real = TypeParam;
  const KernelInput<Real> in(100, 50, false, 1);
  kernels::GaussianSums<Real> a;
  a.queries = in.queries.vectors();
  a.data = in.data.vectors();
  a.radius.radius_sq = Real(9);
  KernelOutput<Real> out(in.query_count, 1);
  a.out = out.channel(0);
  const auto& set = *usableKernels().front()->set;
  if constexpr (std::is_same<Real, float>::value)
    set.gaussian_sums_float(candidatesOf(in.near), a, 2, 4);
  else
    set.gaussian_sums_double(candidatesOf(in.near), a, 2, 4);
  for (std::size_t q = 0; q < in.query_count; ++q) // falloff 0: the sum counts the candidates
    EXPECT_EQ(out.value(0, q), q >= 32 && q < 64 ? static_cast<Real>(in.candidates[q].size()) : Real(-7));
}

/** Queries at r along x, each with one datum at 0: a sum is the exponential of -r^2, rounded once. */
template <typename Real>
struct ExpInput {
  static constexpr std::size_t kQueries = 1 << 18;
  SortedVectors<Real> queries{kQueries, Real(0)}, normals{kQueries, Real(0)}, data{1, Real(kFarAway)};
  Neighborhoods near;

  explicit ExpInput(double longest_argument)
  {
    data.x[0] = data.y[0] = data.z[0] = Real(0);
    SplitMix64 random(1);
    for (std::size_t q = 0; q < kQueries; ++q) {
      // Half of the arguments evenly spread, half of them by magnitude, down to 1e-20.
      const double u = random.uniform();
      const double argument = q % 2 == 0 ? u * longest_argument : longest_argument * std::pow(10.0, -20.0 * u);
      queries.x[q] = static_cast<Real>(std::sqrt(argument));
    }
    near.query_count = kQueries;
    near.absent = 1;
    near.runs.assign(blockCount(kQueries), Run{0, 1});
    near.run_offsets.resize(blockCount(kQueries) + 1);
    std::iota(near.run_offsets.begin(), near.run_offsets.end(), std::size_t{0});
  }

  double
  largestError(const AlignedArray<Real>& out) const
  {
    double largest = 0;
    for (std::size_t q = 0; q < kQueries; ++q) {
      const Real argument = queries.x[q] * queries.x[q];
      const long double exact = std::exp(-static_cast<long double>(argument));
      largest = std::max(largest, static_cast<double>(std::abs((out[q] - exact) / exact)));
    }
    return largest;
  }
};

template <typename Real>
double
largestExpError(const kernels::KernelSet& set, double longest_argument)
{
  const ExpInput<Real> in(longest_argument);
  AlignedArray<Real> out(in.kQueries + kQueryBlock);
  kernels::GaussianSums<Real> a;
  a.queries = in.queries.vectors();
  a.data = in.data.vectors();
  a.radius.radius_sq = a.falloff = Real(1024); // their quotient is exactly 1
  a.out = out.data();
  if constexpr (std::is_same<Real, float>::value)
    set.gaussian_sums_float(candidatesOf(in.near), a, 0, blockCount(in.kQueries));
  else
    set.gaussian_sums_double(candidatesOf(in.near), a, 0, blockCount(in.kQueries));
  return in.largestError(out);
}

/** Of the short exponential, by which the projection weighs where sigma^2 is no narrower than the ball. */
double
largestGentleExpError(const kernels::KernelSet& set)
{
  const ExpInput<float> in(0.4999);
  AlignedArray<float> out(in.kQueries + kQueryBlock);
  SortedVectors<float> pull(in.kQueries);
  kernels::Projection<float> a;
  a.queries = in.queries.vectors();
  a.data = in.data.vectors();
  a.query_normals = a.data_normals = in.normals.vectors();
  a.radius.radius_sq = a.falloff = 0.5f; // their quotient is exactly 1
  a.weight_sum = out.data();
  a.pull = pull.vectors();
  set.projection_float(candidatesOf(in.near), a, 0, blockCount(in.kQueries));
  return in.largestError(out);
}

TEST(KernelExp, isAsAccurateAsItsCommentSays)
{
  for (const auto* target : usableKernels()) {
    const double errors[] = {largestExpError<float>(*target->set, 87.2), largestExpError<double>(*target->set, 708.3),
                             largestGentleExpError(*target->set)};
    EXPECT_LT(errors[0], 3e-7) << target->name;
    EXPECT_LT(errors[1], 4e-16) << target->name;
    EXPECT_LT(errors[2], 8e-7) << target->name;
    EXPECT_GT(errors[0], 1e-9) << "nothing was measured";
    RecordProperty(std::string(target->name) + "_float_1e-9", static_cast<int>(errors[0] * 1e9));
    RecordProperty(std::string(target->name) + "_double_1e-18", static_cast<int>(errors[1] * 1e18));
    RecordProperty(std::string(target->name) + "_gentle_1e-9", static_cast<int>(errors[2] * 1e9));
  }
}

} // namespace
} // namespace pcl_gpf::test
