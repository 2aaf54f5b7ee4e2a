// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/local_cloud.h"

#include <pcl_gpf/core/operators/gpf.h>

#include <vector>

namespace pcl_gpf::test {

/** \brief The input arrays of a cloud; `samples` must live as long as the result. */
inline GPFInput
inputOf(const LocalCloud& cloud, const std::vector<std::uint32_t>* samples = nullptr, NeighborSearch search = {})
{
  GPFInput input;
  input.points = cloud.points.view();
  input.normals = cloud.normals.view();
  input.samples = samples ? samples->data() : nullptr;
  input.sample_count = samples ? samples->size() : 0;
  input.search = std::move(search);
  return input;
}

inline SoaBuffer
positionsOf(const GPFState& state)
{
  SoaBuffer positions(state.size());
  state.positions(positions.view());
  return positions;
}

inline SoaBuffer
displacementsOf(const GPFState& state)
{
  SoaBuffer displacements(state.size());
  state.displacements(displacements.view());
  return displacements;
}

/** \brief Positions after some steps. */
inline SoaBuffer
runSteps(const GPFParameters& parameters, const GPFInput& input, int steps)
{
  GPFState state = gpfInit(parameters, input);
  for (int step = 0; step < steps; ++step)
    gpfStep(state);
  return positionsOf(state);
}

/** \brief Shapes that tests run over: oblique, so that nothing is parallel to the axes, with noise that is no multiple of anything. */
struct NamedCloud {
  const char* name;
  LocalCloud cloud;
};

inline std::vector<NamedCloud>
threeClouds(std::size_t size)
{
  std::vector<NamedCloud> clouds;
  clouds.push_back({"cube", toLocalCloud(turned(cube(size, 0.012, 1)))});
  clouds.push_back({"sphere", toLocalCloud(turned(sphere(size, 0.008, 2)))});
  clouds.push_back({"edge", toLocalCloud(turned(edge(size, 0.01, 3)))});
  return clouds;
}

} // namespace pcl_gpf::test
