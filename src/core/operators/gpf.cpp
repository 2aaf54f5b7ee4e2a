// SPDX-License-Identifier: BSD-3-Clause
#include "../check_range.h"
#include "gpf_solver.h"

#include <pcl_gpf/core/errors.h>

#include <memory>
#include <utility>

namespace pcl_gpf {

GPFState::GPFState(std::unique_ptr<Implementation> implementation) : implementation_(std::move(implementation)) {}
GPFState::GPFState(GPFState&&) noexcept = default;
GPFState&
GPFState::operator=(GPFState&&) noexcept = default;
GPFState::~GPFState() = default;

std::size_t
GPFState::size() const
{
  return implementation_->size();
}

void
GPFState::positions(MutableVectorsView out) const
{
  implementation_->positions(out);
}

void
GPFState::displacements(MutableVectorsView out) const
{
  implementation_->displacements(out);
}

void
GPFState::normals(MutableVectorsView out) const
{
  implementation_->normals(out);
}

std::vector<std::uint8_t>
GPFState::isolated() const
{
  return implementation_->isolated();
}

GPFState
gpfInit(const GPFParameters& parameters, const GPFInput& input)
{
  validate(parameters);
  if (parameters.support_radius <= 0.0)
    throw InvalidParameter("support_radius must be set before the recursion starts; it is 0");
  for (std::size_t i = 0; input.samples && i < input.sample_count; ++i)
    if (input.samples[i] >= (input.index ? input.index->size() : input.points.size))
      throw InvalidParameter("a sample index is not below the number of points");
  GPFParameters bounded = parameters;
  bounded.support_radius = boundedRadius(parameters.support_radius);
  if (runsInDouble(bounded))
    return GPFState(std::make_unique<GPFSolver<double>>(bounded, input));
  return GPFState(std::make_unique<GPFSolver<float>>(bounded, input));
}

IterationStats
gpfStep(GPFState& state)
{
  return state.implementation().step();
}

std::vector<IterationStats>
gpfRun(GPFState& state, const ProgressCallback& progress)
{
  const GPFParameters& p = state.implementation().parameters;
  std::vector<IterationStats> history;
  const auto report = [&](double fraction) {
    if (progress && !progress(fraction))
      throw Cancelled();
  };
  report(0.0);
  while (history.size() < p.maximum_iterations) {
    history.push_back(gpfStep(state));
    report(static_cast<double>(history.size()) / p.maximum_iterations);
    if (history.back().mean_movement < p.convergence_threshold * p.support_radius)
      break;
  }
  state.implementation().releaseNeighborhoods();
  return history;
}

std::vector<IterationStats>
gpfFillGaps(GPFState& state, const ProgressCallback& progress)
{
  const unsigned rounds = state.implementation().parameters.gap_iterations;
  std::vector<IterationStats> history;
  const auto report = [&](double fraction) {
    if (progress && !progress(fraction))
      throw Cancelled();
  };
  while (history.size() < rounds) {
    report(static_cast<double>(history.size()) / rounds);
    history.push_back(state.implementation().fillGaps());
    if (!(history.back().max_movement > 0.0))
      break;
  }
  if (rounds > 0)
    report(1.0);
  return history;
}

double
gpfHaloWidth(const GPFParameters& parameters)
{
  return 2.0 * parameters.support_radius;
}

} // namespace pcl_gpf
