// SPDX-License-Identifier: BSD-3-Clause
#include "overall_progress.h"

#include "two_scales.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pcl_gpf {

namespace {

/** Microseconds of one thread a point; a fine stage works on some of them only. */
constexpr double kQuadrics = 1.0;
constexpr double kNormals = 6.0, kBilateral = 8.0, kFilter = 8.0, kFineShare = 0.4, kOrient = 12.0, kEdgeAwarePoint = 25.0, kMlsPoint = 15.0,
                 kMeshPoint = 20.0, kPoissonPoint = 40.0;
/** The same a cell of the surface's longest side, squared. */
constexpr double kMeshCells = 50.0;
constexpr double kMostCells = 65536.0;

/** Points after the stage upsample, roughly where a spacing is asked for. */
double
pointsAfterUpsampling(const EdgeAwareUpsamplingParameters& p, double points)
{
  if (p.target_count > 0)
    return std::max(points, static_cast<double>(p.target_count));
  return points * std::max(1.0, p.factor > 0.0 ? p.factor : 2.0);
}

double
meshCost(const MeshParameters& p, double points, double longest_side)
{
  if (p.method == MeshMethod::Poisson)
    return kPoissonPoint * points;
  double cells = p.rimls.resolution;
  if (p.rimls.cell_size > 0.0)
    cells = std::min(longest_side / p.rimls.cell_size, kMostCells);
  return kMeshPoint * points + kMeshCells * cells * cells;
}

} // namespace

std::vector<ExpectedStage>
expectedStages(const ConsolidationParameters& p, std::size_t points, double longest_side)
{
  double count = static_cast<double>(points);
  std::vector<ExpectedStage> stages;
  if (p.normals || p.filter)
    stages = {{"normals", kNormals * count}, {"bilateral", kBilateral * count}};
  if (p.filter)
    stages.push_back({"filter", kFilter * count});
  if (p.filter && filtersTwoScales(p.denoise))
    for (std::size_t k = 0; k < 3; ++k)
      stages.push_back({"fine " + stages[k].name, kFineShare * stages[k].cost});
  if (p.filter && filtersTwoScales(p.denoise) && p.denoise.steered.passes > 0)
    stages.push_back({"fine planes", kFineShare * kFilter * count});
  if (p.filter && filtersTwoScales(p.denoise) && p.denoise.quadric.levels > 0)
    stages.push_back({"quadrics", kQuadrics * count});
  if (p.filter)
    count *= p.denoise.gpf.sample_ratio;
  if (p.orient)
    stages.push_back({"orient", kOrient * count});
  if (p.upsample) {
    const double made = pointsAfterUpsampling(p.upsampling.edge_aware, count);
    const bool edge_aware = p.upsampling.method == UpsamplingMethod::EdgeAware;
    stages.push_back({"upsampling", edge_aware ? kEdgeAwarePoint * (made - count) : kMlsPoint * made});
    count = made;
  }
  if (p.mesh)
    stages.push_back({"mesh", meshCost(p.meshing, count, longest_side)});
  return stages;
}

OverallProgress::OverallProgress(std::vector<ExpectedStage> stages, StageProgress callback)
: stages_(std::move(stages)), callback_(std::move(callback))
{
  double sum = 0.0;
  for (const ExpectedStage& stage : stages_)
    sum += stage.cost;
  if (sum > 0.0)
    unexpected_cost_ = sum / (4.0 * static_cast<double>(stages_.size()));
}

void
OverallProgress::begin(const std::string& stage)
{
  if (!stages_.empty() && stages_.front().name == stage)
    return;
  const auto expected = std::find_if(stages_.begin(), stages_.end(), [&stage](const ExpectedStage& e) { return e.name == stage; });
  if (expected != stages_.end())
    stages_.erase(stages_.begin(), expected);
  else
    stages_.insert(stages_.begin(), {stage, unexpected_cost_});
  begin_ = value_;
}

bool
OverallProgress::report(const std::string& stage, double fraction)
{
  begin(stage);
  double left = 0.0;
  for (const ExpectedStage& e : stages_)
    left += e.cost;
  const double share = left > 0.0 ? stages_.front().cost / left : 0.0;
  const double whole = begin_ + (1.0 - begin_) * share * std::clamp(fraction, 0.0, 1.0);
  value_ = std::clamp(whole, value_, 1.0);
  return callback_(stage, value_);
}

bool
OverallProgress::finish()
{
  value_ = 1.0;
  return callback_(stages_.empty() ? std::string() : stages_.front().name, value_);
}

} // namespace pcl_gpf
