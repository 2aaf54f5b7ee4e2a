// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/errors.h>

#include "rimls_surface.h"
#include "rimls_work.h"

#include <cmath>
#include <limits>

namespace pcl_gpf {

namespace {

/** \brief Positions on their way to the surface, sorted so that neighbours share candidates. */
struct Walk {
  Walk(PointsView positions, std::size_t threads)
  : order(hilbertOrder(positions, threads))
  , start(gather<float>(positions, {}, order, 0.0f))
  , at(gather<float>(positions, {}, order, 0.0f))
  , best(gather<float>(positions, {}, order, 0.0f))
  , normal(order.size())
  , least(order.size(), std::numeric_limits<float>::infinity())
  , state(order.size(), RimlsState::TooManySteps)
  , walking(order.size(), 1)
  {}

  std::vector<std::uint32_t> order; ///< the caller's place of each
  SortedVectors<float> start, at, best, normal;
  std::vector<float> least; ///< |f| at `best`
  std::vector<RimlsState> state;
  std::vector<std::uint8_t> walking;
};

void
copyPoint(const SortedVectors<float>& from, SortedVectors<float>& to, std::size_t i)
{
  to.x[i] = from.x[i];
  to.y[i] = from.y[i];
  to.z[i] = from.z[i];
}

void
stop(Walk& walk, std::size_t w, RimlsState state)
{
  walk.walking[w] = 0;
  walk.state[w] = state;
}

/** One step of position w, whose fit is the i-th of its batch. */
void
step(Walk& walk, std::size_t w, const RimlsFit& fit, std::size_t i, float accuracy)
{
  if (!fit.inside(i)) {
    copyPoint(walk.start, walk.best, w);
    return stop(walk, w, RimlsState::Outside);
  }
  const float f = fit.value(i);
  const auto& g = fit.gradient();
  const float length = std::sqrt(g.x[i] * g.x[i] + g.y[i] * g.y[i] + g.z[i] * g.z[i]);
  if (!(length > 0.0f))
    return stop(walk, w, RimlsState::TooManySteps);
  const bool arrived = std::abs(f) <= accuracy;
  const bool nearer = std::abs(f) < walk.least[w];
  if (nearer && !arrived) {
    walk.least[w] = std::abs(f);
    copyPoint(walk.at, walk.best, w);
  }
  if (nearer || arrived) {
    walk.normal.x[w] = g.x[i] / length;
    walk.normal.y[w] = g.y[i] / length;
    walk.normal.z[w] = g.z[i] / length;
  }
  const float longest = 0.5f * fit.reach(i);
  const float move = std::clamp(f, -longest, longest) / length;
  walk.at.x[w] -= move * g.x[i];
  walk.at.y[w] -= move * g.y[i];
  walk.at.z[w] -= move * g.z[i];
  if (arrived) {
    copyPoint(walk.at, walk.best, w);
    stop(walk, w, RimlsState::Converged);
  }
}

RimlsProjectionStatistics
finish(const Walk& walk, MutableVectorsView positions, MutableVectorsView normals, RimlsState* states)
{
  RimlsProjectionStatistics statistics;
  for (std::size_t w = 0; w < walk.order.size(); ++w) {
    const std::size_t i = walk.order[w];
    const double dx = walk.best.x[w] - walk.start.x[w], dy = walk.best.y[w] - walk.start.y[w],
                 dz = walk.best.z[w] - walk.start.z[w];
    const double movement = std::sqrt(dx * dx + dy * dy + dz * dz);
    statistics.mean_movement += movement;
    statistics.max_movement = std::max(statistics.max_movement, movement);
    statistics.converged += walk.state[w] == RimlsState::Converged;
    statistics.too_many_steps += walk.state[w] == RimlsState::TooManySteps;
    statistics.outside += walk.state[w] == RimlsState::Outside;
    positions.x[i] = walk.best.x[w];
    positions.y[i] = walk.best.y[w];
    positions.z[i] = walk.best.z[w];
    const bool has_normal = walk.normal.x[w] != 0.0f || walk.normal.y[w] != 0.0f || walk.normal.z[w] != 0.0f;
    if (walk.state[w] != RimlsState::Outside && has_normal) {
      normals.x[i] = walk.normal.x[w];
      normals.y[i] = walk.normal.y[w];
      normals.z[i] = walk.normal.z[w];
    }
    if (states)
      states[i] = walk.state[w];
  }
  if (!walk.order.empty())
    statistics.mean_movement /= static_cast<double>(walk.order.size());
  return statistics;
}

} // namespace

RimlsProjectionStatistics
RimlsSurface::project(MutableVectorsView positions, MutableVectorsView normals, RimlsState* states,
                      const NeighborSearch& search, const ProgressCallback& progress) const
{
  const Implementation& surface = *implementation_;
  const auto report = [&](double fraction) {
    if (progress && !progress(fraction))
      throw Cancelled();
  };
  refuseExcessiveProjection(surface.parameters, *surface.index, surface.spacing, positions.size);
  const auto accuracy = static_cast<float>(surface.parameters.accuracy * surface.spacing);
  Walk walk(positions, resolveThreads(surface.parameters.number_of_threads));
  std::vector<std::uint32_t> walkers(walk.order.size());
  for (std::size_t w = 0; w < walkers.size(); ++w)
    walkers[w] = static_cast<std::uint32_t>(w);

  std::size_t iterations = 0;
  const std::size_t most = surface.parameters.maximum_iterations;
  for (; iterations < most && !walkers.empty(); ++iterations) {
    report(static_cast<double>(iterations) / static_cast<double>(most));
    const SortedVectors<float> here =
        gather<float>({walk.at.x.data(), walk.at.y.data(), walk.at.z.data(), walk.at.size()}, {}, walkers, 0.0f);
    surface.fitAll(
        {here.x.data(), here.y.data(), here.z.data(), walkers.size()}, search,
        [&](const RimlsFit& fit, std::size_t k, std::size_t i) { step(walk, walkers[k], fit, i, accuracy); });
    walkers.erase(std::remove_if(walkers.begin(), walkers.end(), [&](std::uint32_t w) { return walk.walking[w] == 0; }),
                  walkers.end());
  }
  RimlsProjectionStatistics statistics = finish(walk, positions, normals, states);
  statistics.iterations = iterations;
  report(1.0);
  return statistics;
}

} // namespace pcl_gpf
