// SPDX-License-Identifier: BSD-3-Clause
#include "support/columns.h"

#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/pipeline/denoise.h>
#include <pcl_gpf/pipeline/upsample.h>

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

namespace pcl_gpf::test {
namespace {

/** The whole cloud in every ball: pairs explode. */
constexpr double kMistake = 1000.0;

/** Runs, and expects a refusal of `parameter` before any stage has begun. */
void
expectRefusal(const std::function<void(const StageProgress&)>& run, const std::string& parameter)
{
  bool begun = false;
  try {
    run([&](const std::string&, double) { return begun = true; });
    ADD_FAILURE() << parameter << " was not refused";
  } catch (const ExcessiveWork& error) {
    for (const std::string& part :
         {parameter, std::string("billion pairs"), std::string(" s and "), std::string(" MB")})
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
  EXPECT_FALSE(begun) << parameter;
}

TEST(Foresight, refusesEveryRadiusThatExplodesBeforeTheFirstStage)
{
  const Columns cloud(cube(100000, 0.01, 3).points);
  const auto refused = [&](const char* parameter, const std::function<void(DenoiseParameters&)>& change) {
    DenoiseParameters p;
    change(p);
    expectRefusal([&](const StageProgress& progress) { denoise(cloud.input(), p, progress); }, parameter);
  };
  refused("gpf.support_radius", [](DenoiseParameters& p) {
    p.gpf = GPFParameters::paper();
    p.gpf.support_radius = kMistake;
  });
  refused("gpf.support_radius", [](DenoiseParameters& p) {
    p.gpf.repulsion_weight = 0.3;
    p.gpf.maximum_iterations = 20;
    p.gpf.support_radius = kMistake;
  });
  refused("bilateral.radius", [](DenoiseParameters& p) {
    p.bilateral.merge_above = 0;
    p.bilateral.radius = kMistake;
  });
  DenoiseParameters oriented;
  oriented.bilateral.sign_invariant = false;
  oriented.bilateral.radius = kMistake;
  expectRefusal([&](const StageProgress& progress) { denoiseNormals(cloud.input(), oriented, progress); },
                "bilateral.radius");
}

TEST(Foresight, refusesPlaneFitsOverTheWholeCloud)
{
  const Columns cloud(cube(400000, 0.01, 3).points);
  DenoiseParameters p;
  p.normals.radius = kMistake;
  p.normals.merge_above = 0;
  expectRefusal([&](const StageProgress& progress) { denoiseNormals(cloud.input(), p, progress); }, "normals.radius");
}

TEST(Foresight, refusesUpsamplingRadiusBeforeNormalsAreEstimated)
{
  const Columns cloud(cube(100000, 0.01, 3).points);
  UpsampleParameters p;
  p.edge_aware.radius = kMistake;
  expectRefusal([&](const StageProgress& progress) { upsample(cloud.input(), p, progress); }, "upsampling.radius");
  EXPECT_THROW(checkUpsamplable(cloud.input(), p), ExcessiveWork);
}

TEST(Foresight, refusesMoreRowsThanIndicesTellApartBeforeReadingOne)
{
  const double none = 0.0;
  DenoiseInput in;
  in.x = in.y = in.z = &none;
  in.size = std::size_t{1} << 32;
  EXPECT_THROW(denoise(in, {}), ExcessiveWork);
  EXPECT_THROW(denoiseNormals(in, {}), ExcessiveWork);
}

} // namespace
} // namespace pcl_gpf::test
