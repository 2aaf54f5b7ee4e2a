// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/simd.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

/** \file
 * \brief Skips every test of the program when PCL_GPF_SIMD names an instruction set that this processor does not have.
 */
namespace {

class SimdEnvironment : public ::testing::Environment {
public:
  void
  SetUp() override
  {
    const char* forced = std::getenv("PCL_GPF_SIMD");
    const auto available = pcl_gpf::availableSimdTargets();
    if (forced && *forced && std::find(available.begin(), available.end(), forced) == available.end())
      GTEST_SKIP() << "this processor has no " << forced;
  }
};

const auto* const kRegistered = ::testing::AddGlobalTestEnvironment(new SimdEnvironment);

} // namespace
