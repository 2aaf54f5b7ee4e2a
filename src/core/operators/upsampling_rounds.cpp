// SPDX-License-Identifier: BSD-3-Clause
#include "upsampling_rounds.h"

#include "rival_gaps.h"

#include <pcl_gpf/core/parallel.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_gpf {

namespace {

constexpr std::size_t kPointsPerTask = 1024;
constexpr std::size_t kCopiesPerTask = 65536;
/** Partners are sought within this many times the square root of the least priority of a round: a gap's own width is twice it. */
constexpr float kReachInClearances = 3.4f;
/** Share of the points whose gaps, those of least priority, take no part in a round: so the widest are filled first. A round fills about
 * 0.4 gaps a point, so it is the last when not more than kLastRound a point are to be filled; of that one the best are taken. */
constexpr double kShareLeft = 0.17, kShareLeftOfLast = 0.13, kLastRound = 0.5;
/** Points by which the priorities of all are judged, at least, when there are more. */
constexpr std::size_t kPriorityProbes = 8192;
constexpr float kUnknown = std::numeric_limits<float>::infinity();

template <class Arrays>
void
setVector(Arrays& to, std::size_t k, const std::array<float, 3>& value)
{
  to.x[k] = value[0];
  to.y[k] = value[1];
  to.z[k] = value[2];
}

} // namespace

UpsamplingRounds::UpsamplingRounds(const UpsamplingPlan& plan, const PointIndex& points, NormalsView unit_normals)
: plan_(plan)
, input_size_(points.size())
, projection_(points, unit_normals, plan.radius, plan.angle, plan.sign_invariant)
, search_(plan.edge_sensitivity, plan.sign_invariant)
, cloud_(points, unit_normals, placesWithoutCopies(points.sorted(), unit_normals, static_cast<float>(plan.rounding), plan.sign_invariant), plan.threads)
, reach_(static_cast<float>(plan.radius))
{
  const float least = static_cast<float>(std::max(plan.rounding, plan.least_clearance));
  least_clearance_sq_ = least * least;
  for (Gap& gap : cloud_.gaps())
    gap.clearance_sq = kUnknown; // sought as far as allowed
}

void
UpsamplingRounds::searchGaps()
{
  const std::uint32_t first_new = searched_;
  Gap* gaps = cloud_.gaps().data();
  parallelBlocks(cloud_.size(), kPointsPerTask, plan_.threads, [&](std::size_t begin, std::size_t end) {
    GapSearch::Scratch scratch;
    search_.widest(cloud_, begin, end, first_new, reach_, static_cast<float>(plan_.radius), scratch, gaps + kGapsOfPoint * begin);
  });
  searched_ = cloud_.numberCount();
  least_filled_ = kUnknown;
}

float
UpsamplingRounds::widestClearance() const
{
  float widest_sq = 0.0f;
  for (const Gap& gap : cloud_.gaps())
    if (gap.priority > 0.0f && gap.priority < least_filled_)
      widest_sq = std::max(widest_sq, gap.clearance_sq);
  return std::sqrt(widest_sq);
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
  const std::size_t step = kGapsOfPoint * (1 + cloud_.size() / kPriorityProbes);
  for (std::size_t k = 0; k < cloud_.gaps().size(); k += step) // the best of each of some points
    if (counts(cloud_.gaps()[k]))
      priorities.push_back(cloud_.gaps()[k].priority);
  if (priorities.empty())
    return kUnknown;
  const bool last = static_cast<double>(plan_.target - size()) <= kLastRound * static_cast<double>(cloud_.size());
  const double share = last ? kShareLeftOfLast : kShareLeft;
  const auto middle = priorities.begin() + static_cast<std::ptrdiff_t>(static_cast<double>(priorities.size()) * share);
  std::nth_element(priorities.begin(), middle, priorities.end());
  return *middle;
}

std::vector<std::uint32_t>
UpsamplingRounds::chooseBases(float least) const
{
  const std::vector<Gap>& gaps = cloud_.gaps();
  std::vector<std::uint32_t> rivals;
  for (std::size_t k = 0; k < gaps.size(); ++k)
    if (gaps[k].priority >= least && counts(gaps[k]))
      rivals.push_back(static_cast<std::uint32_t>(k));
  return fillableTogether(gaps, rivals, plan_.threads);
}

void
UpsamplingRounds::fill(const std::vector<std::uint32_t>& chosen)
{
  const std::size_t count = chosen.size(), before = parents_.size();
  ProjectionQueries queries(count);
  for (std::vector<std::uint32_t>* values : {&parents_, &first_base_, &second_base_})
    values->resize(before + count);
  parallelBlocks(count, kCopiesPerTask, plan_.threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) {
      const Gap& gap = cloud_.gaps()[chosen[c]];
      const std::size_t place = chosen[c] / kGapsOfPoint;
      const std::array<float, 3> v = cloud_.position(place);
      const float dx = gap.base[0] - v[0], dy = gap.base[1] - v[1], dz = gap.base[2] - v[2];
      setVector(queries.positions, c, gap.base);
      setVector(queries.directions[0], c, cloud_.normal(place));
      setVector(queries.directions[1], c, cloud_.normal(cloud_.placeOf(gap.partner)));
      queries.longest_move[c] = 2.0f * std::sqrt(dx * dx + dy * dy + dz * dz);
      first_base_[before + c] = cloud_.numbers()[place];
      second_base_[before + c] = gap.partner;
    }
  });
  const ProjectedPoints projected = projection_.project(queries, plan_.threads);
  for (std::size_t c = 0; c < count; ++c) {
    const std::uint32_t v = first_base_[before + c];
    parents_[before + c] = projected.nearest[c] != ProjectedPoints::kNone ? projected.nearest[c]
                           : v < input_size_                              ? v
                                                                          : parents_[v - input_size_];
  }
  const auto append = [](std::vector<float>& to, const AlignedArray<float>& from) {
    to.insert(to.end(), from.begin(), from.end());
  };
  append(x_, projected.positions.x);
  append(y_, projected.positions.y);
  append(z_, projected.positions.z);
  append(nx_, projected.normals.x);
  append(ny_, projected.normals.y);
  append(nz_, projected.normals.z);
  filled_ = chosen;
}

void
UpsamplingRounds::joinInserted()
{
  if (filled_.empty())
    return;
  const std::size_t first = parents_.size() - filled_.size();
  cloud_.insert(filled_, {x_.data() + first, y_.data() + first, z_.data() + first}, {nx_.data() + first, ny_.data() + first, nz_.data() + first});
  filled_.clear();
}

void
UpsamplingRounds::keepBest(std::vector<std::uint32_t>& chosen, std::size_t count) const
{
  std::vector<std::uint32_t> ranked = chosen;
  const std::vector<Gap>& gaps = cloud_.gaps();
  const auto better = [&gaps](std::uint32_t a, std::uint32_t b) {
    return gaps[a].priority > gaps[b].priority || (gaps[a].priority == gaps[b].priority && a < b);
  };
  std::nth_element(ranked.begin(), ranked.begin() + static_cast<std::ptrdiff_t>(count), ranked.end(), better);
  const std::uint32_t first_left = ranked[count];
  chosen.erase(std::remove_if(chosen.begin(), chosen.end(), [&](std::uint32_t i) { return !better(i, first_left); }), chosen.end());
}

bool
UpsamplingRounds::step()
{
  if (size() >= plan_.target)
    return false;
  joinInserted();
  searchGaps();
  const float least = leastPriority();
  std::vector<std::uint32_t> chosen = chooseBases(least);
  if (chosen.empty())
    return false;
  if (chosen.size() > plan_.target - size())
    keepBest(chosen, plan_.target - size());
  if (rounds_++ == 0)
    first_priority_ = static_cast<double>(least);
  last_priority_ = least;
  for (const std::uint32_t gap : chosen)
    least_filled_ = std::min(least_filled_, cloud_.gaps()[gap].priority);
  fill(chosen);
  reach_ = std::min(reach_, kReachInClearances * std::sqrt(least));
  return true;
}

double
UpsamplingRounds::fractionDone() const
{
  const double by_count = static_cast<double>(parents_.size()) / std::max(1.0, static_cast<double>(plan_.target - input_size_));
  if (plan_.least_clearance <= 0.0 || rounds_ == 0)
    return plan_.least_clearance > 0.0 ? 0.0 : by_count;
  const double goal = std::log(first_priority_ / static_cast<double>(least_clearance_sq_));
  const double come = std::log(first_priority_ / static_cast<double>(last_priority_));
  return goal > 0.0 ? std::clamp(come / goal, 0.0, 1.0) : 1.0;
}

EdgeAwareUpsamplingResult
UpsamplingRounds::result()
{
  EdgeAwareUpsamplingResult result;
  const std::size_t count = parents_.size();
  result.points = SoaBuffer(count);
  result.normals = SoaBuffer(count);
  const auto copy = [](const std::vector<float>& from, AlignedArray<float>& to) { std::copy(from.begin(), from.end(), to.begin()); };
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
  if (searched_ == 0)
    searchGaps(); // nothing was to be inserted
  result.widest_gap = static_cast<double>(widestClearance());
  result.rounds = rounds_;
  result.target_reached = plan_.least_clearance > 0.0 || size() >= plan_.target;
  return result;
}

} // namespace pcl_gpf
