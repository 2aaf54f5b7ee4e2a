// SPDX-License-Identifier: BSD-3-Clause
#include "experiment.h"
#include "rimls_variants.h"

#include <gtest/gtest.h>

#include <set>

namespace pcl_gpf::quality {
namespace {

constexpr std::size_t kSize = 4000;

NoisyCloud
sphere(double percent)
{
  return makeNoisyCloud(makeModel("sphere", kSize), kSize, {NoiseKind::Gaussian, percent, 0, 1});
}

TEST(RimlsVariants, FilterPointByPoint)
{
  const NoisyCloud cloud = sphere(1);
  MeasureOptions measuring;
  measuring.references = 1000;
  const Figures before = runMethod(cloud, makeMethod("input"), measuring).figures;
  MethodResult made;
  const Figures after = runMethod(cloud, makeMethod("rimls"), measuring, &made).figures;
  EXPECT_LT(after.mean, 0.5 * before.mean);
  EXPECT_LT(after.normal_error, 10);
  ASSERT_EQ(made.seeds.size(), kSize);
  for (std::size_t i = 0; i < kSize; ++i)
    EXPECT_EQ(made.seeds[i], i);
}

TEST(RimlsVariants, HardlyMoveCleanPoints)
{
  const NoisyCloud cloud = sphere(0);
  const double spacing = 1e4 * cloud.spacing / cloud.model.surface->diagonal();
  EXPECT_LT(runMethod(cloud, makeMethod("rimls"), {}).figures.mean, 0.1 * spacing);
}

TEST(RimlsVariants, BestHasAGridOfDifferentSettings)
{
  std::set<std::string> settings;
  for (const Variant& variant : rimlsVariants("rimls-best"))
    settings.insert(variant.setting);
  EXPECT_EQ(settings.size(), 18u);
  EXPECT_EQ(rimlsVariants("rimls").size(), 1u);
  EXPECT_TRUE(rimlsVariants("rimls-worst").empty());
}

} // namespace
} // namespace pcl_gpf::quality
