// SPDX-License-Identifier: BSD-3-Clause
// A program of a user without PCL: the core on plain arrays.
#include <pcl_gpf/core/operators/gpf.h>
#include <pcl_gpf/core/sampling.h>
#include <pcl_gpf/core/simd.h>

#include <cmath>
#include <cstdio>
#include <vector>

#if defined(__has_include)
#if __has_include(<pcl/point_types.h>)
#error "PCL must not be on the include path of a program that uses the core only"
#endif
#endif

static double
rms(const std::vector<float>& values)
{
  double sum = 0;
  for (const float value : values)
    sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

int
main()
{
  constexpr int kSide = 50;
  std::vector<float> x, y, z;
  pcl_gpf::SplitMix64 random(1);
  for (int row = 0; row < kSide; ++row)
    for (int column = 0; column < kSide; ++column) {
      x.push_back(0.014f * static_cast<float>(column));
      y.push_back(0.014f * static_cast<float>(row));
      z.push_back(0.005f * static_cast<float>(random.normal()));
    }
  const std::vector<float> zeros(x.size(), 0.0f), ones(x.size(), 1.0f);

  pcl_gpf::GPFInput input;
  input.points = {x.data(), y.data(), z.data(), x.size()};
  input.normals = {zeros.data(), zeros.data(), ones.data(), x.size()};
  pcl_gpf::GPFParameters parameters;
  parameters.support_radius = 0.12;
  pcl_gpf::GPFState state = pcl_gpf::gpfInit(parameters, input);
  pcl_gpf::gpfRun(state);

  std::vector<float> out_x(state.size()), out_y(state.size()), out_z(state.size());
  state.positions({out_x.data(), out_y.data(), out_z.data(), state.size()});
  std::printf("%s: rms %.5f -> %.5f\n", pcl_gpf::activeSimdTarget().c_str(), rms(z), rms(out_z));
  return state.size() == x.size() && rms(out_z) < 0.5 * rms(z) ? 0 : 1;
}
