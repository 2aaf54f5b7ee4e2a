// SPDX-License-Identifier: BSD-3-Clause
#include "upsampling_rounds.h"

#include "rival_gaps.h"

#include <pcl_gpf/core/parallel.h>

#include <algorithm>
#include <cmath>

#include <limits>

namespace pcl_gpf {

namespace {

constexpr std::size_t kPointsPerTask = 256;
constexpr std::size_t kCopiesPerTask = 65536;
/** Clearances below this, in the frame whose box diagonal is 1, are rounding. */
constexpr float kLeastClearance = 1e-6f;
/** Partners are sought within this many times the square root of the least priority of a round: a gap's own width is twice it. */
constexpr float kReachInClearances = 3.6f;
/** Share of the gaps, those of least priority, that take no part in a round: so the widest are filled first. */
constexpr double kShareLeft = 0.5;
constexpr float kUnknown = std::numeric_limits<float>::infinity();

SoaBuffer
inOrder(VectorsView from, const std::vector<std::uint32_t>& order, std::size_t threads)
{
  SoaBuffer to(order.size());
  parallelBlocks(order.size(), kCopiesPerTask, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      to.x[k] = from.x[order[k]];
      to.y[k] = from.y[order[k]];
      to.z[k] = from.z[order[k]];
    }
  });
  return to;
}

} // namespace

UpsamplingRounds::UpsamplingRounds(const UpsamplingPlan& plan, PointsView points, SoaBuffer unit_normals)
: plan_(plan)
, input_size_(points.size)
, input_(std::make_unique<PointIndex>(points, static_cast<unsigned>(plan.threads)))
, input_normals_(inOrder(unit_normals.view(), input_->order(), plan.threads))
, projection_(*input_, static_cast<const SoaBuffer&>(input_normals_).view(), plan.radius, plan.angle, plan.sign_invariant)
, search_(plan.edge_sensitivity, plan.sign_invariant)
, x_(points.x, points.x + points.size)
, y_(points.y, points.y + points.size)
, z_(points.z, points.z + points.size)
, nx_(unit_normals.x.begin(), unit_normals.x.end())
, ny_(unit_normals.y.begin(), unit_normals.y.end())
, nz_(unit_normals.z.begin(), unit_normals.z.end())
, gaps_(points.size)
, reach_(static_cast<float>(plan.radius))
{
  const float least = std::max(kLeastClearance, static_cast<float>(plan.least_clearance));
  least_clearance_sq_ = least * least;
  for (Gap& gap : gaps_)
    gap.clearance_sq = kUnknown; // sought as far as allowed
}

void
UpsamplingRounds::indexPoints()
{
  index_ = std::make_unique<PointIndex>(positions(), static_cast<unsigned>(plan_.threads));
  sorted_normals_ = inOrder({nx_.data(), ny_.data(), nz_.data(), size()}, index_->order(), plan_.threads);
}

void
UpsamplingRounds::searchGaps()
{
  const std::vector<std::uint32_t>& order = index_->order();
  const NormalsView normals = static_cast<const SoaBuffer&>(sorted_normals_).view();
  const auto first_new = static_cast<std::uint32_t>(searched_);
  parallelBlocks(size(), kPointsPerTask, plan_.threads, [&](std::size_t begin, std::size_t end) {
    GapSearch::Scratch scratch;
    std::vector<Gap> gaps(end - begin);
    for (std::size_t k = begin; k < end; ++k)
      gaps[k - begin] = gaps_[order[k]];
    search_.widest(*index_, normals, begin, end, first_new, reach_, static_cast<float>(plan_.radius), scratch, gaps.data());
    for (std::size_t k = begin; k < end; ++k)
      gaps_[order[k]] = gaps[k - begin];
  });
  searched_ = size();
}

bool
UpsamplingRounds::counts(const Gap& gap) const
{
  return gap.clearance_sq >= least_clearance_sq_ && gap.priority > 0.0f;
}

float
UpsamplingRounds::leastPriority() const
{
  std::vector<float> priorities;
  priorities.reserve(gaps_.size());
  for (const Gap& gap : gaps_)
    if (counts(gap))
      priorities.push_back(gap.priority);
  if (priorities.empty())
    return kUnknown;
  const auto middle = priorities.begin() + static_cast<std::ptrdiff_t>(static_cast<double>(priorities.size()) * kShareLeft);
  std::nth_element(priorities.begin(), middle, priorities.end());
  return *middle;
}

std::vector<std::uint32_t>
UpsamplingRounds::chooseBases(float least) const
{
  std::vector<std::uint32_t> rivals;
  for (std::size_t i = 0; i < gaps_.size(); ++i)
    if (gaps_[i].priority >= least && counts(gaps_[i]))
      rivals.push_back(static_cast<std::uint32_t>(i));
  return bestWithinClearance(gaps_, rivals, plan_.threads);
}

void
UpsamplingRounds::insert(const std::vector<std::uint32_t>& chosen)
{
  const std::size_t first = size(), count = chosen.size();
  gaps_.resize(first + count);
  for (std::size_t c = 0; c < count; ++c)
    gaps_[first + c].clearance_sq = gaps_[chosen[c]].clearance_sq; // what was free around the new point
  for (std::vector<float>* values : {&x_, &y_, &z_, &nx_, &ny_, &nz_})
    values->resize(first + count);
  for (std::vector<std::uint32_t>* values : {&parents_, &first_base_, &second_base_})
    values->resize(first - input_size_ + count);
  parallelBlocks(count, kPointsPerTask, plan_.threads, [&](std::size_t begin, std::size_t end) {
    BilateralProjection::Scratch scratch;
    std::vector<BilateralProjection::Query> queries(end - begin);
    std::vector<ProjectedPoint> projected(end - begin);
    for (std::size_t c = begin; c < end; ++c) {
      const std::size_t v = chosen[c], t = gaps_[v].partner;
      queries[c - begin] = {gaps_[v].base, {nx_[v], ny_[v], nz_[v]}, {nx_[t], ny_[t], nz_[t]},
                            std::sqrt((x_[v] - x_[t]) * (x_[v] - x_[t]) + (y_[v] - y_[t]) * (y_[v] - y_[t]) + (z_[v] - z_[t]) * (z_[v] - z_[t]))};
    }
    projection_.project(queries, scratch, projected.data());
    for (std::size_t c = begin; c < end; ++c) {
      const std::size_t v = chosen[c], t = gaps_[v].partner, to = first + c, inserted = to - input_size_;
      const ProjectedPoint& p = projected[c - begin];
      x_[to] = p.position[0];
      y_[to] = p.position[1];
      z_[to] = p.position[2];
      nx_[to] = p.normal[0];
      ny_[to] = p.normal[1];
      nz_[to] = p.normal[2];
      first_base_[inserted] = static_cast<std::uint32_t>(v);
      second_base_[inserted] = static_cast<std::uint32_t>(t);
      parents_[inserted] = p.found          ? input_->order()[p.nearest]
                           : v < input_size_ ? static_cast<std::uint32_t>(v)
                                             : parents_[v - input_size_];
    }
  });
}

void
UpsamplingRounds::keepBest(std::vector<std::uint32_t>& chosen, std::size_t count) const
{
  std::vector<std::uint32_t> ranked = chosen;
  const auto better = [this](std::uint32_t a, std::uint32_t b) {
    return gaps_[a].priority > gaps_[b].priority || (gaps_[a].priority == gaps_[b].priority && a < b);
  };
  std::nth_element(ranked.begin(), ranked.begin() + static_cast<std::ptrdiff_t>(count), ranked.end(), better);
  const std::uint32_t first_left = ranked[count];
  chosen.erase(std::remove_if(chosen.begin(), chosen.end(), [&](std::uint32_t i) { return !better(i, first_left); }), chosen.end());
}

bool
UpsamplingRounds::step()
{
  if (size() >= plan_.target && searched_ > 0)
    return false;
  indexPoints();
  searchGaps(); // even where nothing is to be inserted: result() tells the widest gap
  if (size() >= plan_.target)
    return false;
  const float least = leastPriority();
  std::vector<std::uint32_t> chosen = chooseBases(least);
  if (chosen.empty())
    return false;
  if (chosen.size() > plan_.target - size())
    keepBest(chosen, plan_.target - size());
  if (rounds_++ == 0)
    first_priority_ = static_cast<double>(least);
  last_priority_ = least;
  insert(chosen);
  reach_ = std::min(reach_, kReachInClearances * std::sqrt(least));
  return true;
}

double
UpsamplingRounds::fractionDone() const
{
  const double by_count = static_cast<double>(size() - input_size_) / std::max(1.0, static_cast<double>(plan_.target - input_size_));
  if (plan_.least_clearance <= 0.0 || rounds_ == 0)
    return plan_.least_clearance > 0.0 ? 0.0 : by_count;
  const double goal = std::log(first_priority_ / static_cast<double>(least_clearance_sq_));
  const double come = std::log(first_priority_ / static_cast<double>(last_priority_));
  return goal > 0.0 ? std::clamp(come / goal, 0.0, 1.0) : 1.0;
}

EdgeAwareUpsamplingResult
UpsamplingRounds::result() const
{
  EdgeAwareUpsamplingResult result;
  const std::size_t count = size() - input_size_;
  result.points = SoaBuffer(count);
  result.normals = SoaBuffer(count);
  const auto copy = [&](const std::vector<float>& from, AlignedArray<float>& to) {
    std::copy(from.begin() + static_cast<std::ptrdiff_t>(input_size_), from.end(), to.begin());
  };
  copy(x_, result.points.x);
  copy(y_, result.points.y);
  copy(z_, result.points.z);
  copy(nx_, result.normals.x);
  copy(ny_, result.normals.y);
  copy(nz_, result.normals.z);
  result.parents = parents_;
  result.first_base = first_base_;
  result.second_base = second_base_;
  result.radius = plan_.radius;
  float widest = 0.0f;
  for (const Gap& gap : gaps_)
      widest = std::max(widest, gap.clearance_sq);
  result.widest_gap = std::sqrt(static_cast<double>(widest));
  result.rounds = rounds_;
  result.target_reached = plan_.least_clearance > 0.0 || size() >= plan_.target;
  return result;
}

} // namespace pcl_gpf
