// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/local_frame.h>
#include <pcl_gpf/core/sampling.h>

#include <gtest/gtest.h>

#include <cmath>

namespace pcl_gpf {
namespace {

BoundingBox
boxFromTo(double from, double to)
{
  BoundingBox box;
  box.add(from, from, from);
  box.add(to, to, to);
  return box;
}

TEST(BoundingBox, holdsItsPoints)
{
  BoundingBox box;
  EXPECT_EQ(box.diagonal(), 0.0);
  box.add(1, -2, 3);
  EXPECT_EQ(box.diagonal(), 0.0) << "one point has no extent";
  EXPECT_EQ(box.min, (std::array<double, 3>{1, -2, 3}));
  box.add(4, 2, 3);
  box.add(2, 0, 3);
  EXPECT_EQ(box.min, (std::array<double, 3>{1, -2, 3}));
  EXPECT_EQ(box.max, (std::array<double, 3>{4, 2, 3}));
  EXPECT_EQ(box.count, 3u);
  EXPECT_DOUBLE_EQ(box.diagonal(), 5.0);
}

TEST(BoundingBox, neitherOverflowsNorUnderflows)
{
  EXPECT_NEAR(boxFromTo(0, 1e300).diagonal() / 1e300, std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(boxFromTo(0, 1e-300).diagonal() / 1e-300, std::sqrt(3.0), 1e-12);
}

TEST(LocalFrame, putsTheCentreAtTheOriginAndTheCornersAtOneHalf)
{
  for (const double size : {1e-300, 1e-6, 1.0, 1e6, 1e300}) {
    const LocalFrame frame = localFrame(boxFromTo(size, 3 * size));
    EXPECT_NEAR(frame.toLocal(size, 0), -0.5 / std::sqrt(3.0), 1e-7);
    EXPECT_NEAR(frame.toLocal(2 * size, 1), 0.0, 1e-7);
    EXPECT_NEAR(frame.toLocal(3 * size, 2), 0.5 / std::sqrt(3.0), 1e-7);
    EXPECT_NEAR(frame.lengthToLocal(frame.scale), 1.0, 1e-15);
    EXPECT_NEAR(frame.lengthToWorld(frame.lengthToLocal(size)) / size, 1.0, 1e-15);
  }
}

TEST(LocalFrame, keepsMillimetresOfUtmCoordinates)
{
  BoundingBox box;
  box.add(500000.0, 4000000.0, 100.0);
  box.add(500080.0, 4000060.0, 120.0); // 102 m: a float ulp of half of it is 4 micrometres
  const LocalFrame frame = localFrame(box);
  SplitMix64 random(1);
  for (int i = 0; i < 1000; ++i) {
    const double x = 500000.0 + 0.001 * static_cast<double>(random.below(80000));
    const double y = 4000000.0 + 0.001 * static_cast<double>(random.below(60000));
    EXPECT_NEAR(frame.toWorld(frame.toLocal(x, 0), 0), x, 4e-6);
    EXPECT_NEAR(frame.toWorld(frame.toLocal(y, 1), 1), y, 4e-6);
  }
}

TEST(LocalFrame, mapsDegenerateDataToTheOrigin)
{
  const LocalFrame frame = localFrame(boxFromTo(1e9, 1e9));
  EXPECT_EQ(frame.scale, 1.0);
  EXPECT_EQ(frame.toLocal(1e9, 0), 0.0f);
  EXPECT_EQ(localFrame(BoundingBox{}).scale, 1.0);
}

} // namespace
} // namespace pcl_gpf
