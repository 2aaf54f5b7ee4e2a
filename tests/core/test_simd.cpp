// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/simd.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

namespace pcl_gpf {
namespace {

class Simd : public ::testing::Test {
protected:
  ~Simd() override { setSimdTarget(before_); }

private:
  std::string before_ = activeSimdTarget();
};

TEST_F(Simd, startsWithWhatTheEnvironmentAsksForOrTheBest)
{
  const char* forced = std::getenv("PCL_GPF_SIMD");
  EXPECT_EQ(activeSimdTarget(), forced ? std::string(forced) : availableSimdTargets().front());
}

TEST_F(Simd, alwaysHasTheScalarLoops)
{
  const auto targets = availableSimdTargets();
  EXPECT_EQ(std::count(targets.begin(), targets.end(), "scalar"), 1);
  EXPECT_EQ(targets.back(), "scalar");
}

TEST_F(Simd, runsOnEveryTargetThatItNames)
{
  for (const std::string& name : availableSimdTargets()) {
    setSimdTarget(name);
    EXPECT_EQ(activeSimdTarget(), name);
  }
  setSimdTarget("");
  EXPECT_EQ(activeSimdTarget(), availableSimdTargets().front());
}

TEST_F(Simd, refusesUnknownTargetsAndNamesTheKnownOnes)
{
  try {
    setSimdTarget("mmx");
    FAIL();
  } catch (const InvalidParameter& e) {
    EXPECT_NE(std::string(e.what()).find("mmx"), std::string::npos);
    EXPECT_NE(std::string(e.what()).find("scalar"), std::string::npos);
  }
}

} // namespace
} // namespace pcl_gpf
