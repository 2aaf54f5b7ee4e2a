// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/operators/steered_fit.h>
#include <pcl_gpf/core/parallel.h>

#include "../check_range.h"
#include "../sorted_points.h"
#include "steered_guide.h"
#include "steered_planes.h"

#include <algorithm>
#include <cmath>

namespace pcl_gpf {

namespace {

/** Queries that have their arrays at one time; whole blocks. */
constexpr std::size_t kQueriesAtOnce = 4096;

MutableVectorsView
viewOf(SortedVectors<float>& v)
{
  return {v.x.data(), v.y.data(), v.z.data(), v.size()};
}

void
add(const SortedVectors<float>& from, std::size_t k, float scale, MutableVectorsView to, std::size_t i)
{
  to.x[i] += scale * from.x[k];
  to.y[i] += scale * from.y[k];
  to.z[i] += scale * from.z[k];
}

void
set(const SortedVectors<float>& from, std::size_t k, float scale, MutableVectorsView to, std::size_t i)
{
  to.x[i] = scale * from.x[k];
  to.y[i] = scale * from.y[k];
  to.z[i] = scale * from.z[k];
}

/** The passes over one cloud, which is sorted once. */
class SteeredPasses {
public:
  SteeredPasses(const SteeredFitParameters& parameters, PointsView noisy, const std::vector<std::uint32_t>& places,
                MutableVectorsView positions, MutableVectorsView normals)
  : p_(parameters)
  , threads_(resolveThreads(parameters.number_of_threads))
  , guide_(steeredGuide(parameters, noisy, positions, normals, threads_))
  , wanted_(noisy.size)
  , positions_(positions)
  , normals_(normals)
  {
    for (const std::uint32_t row : places)
      wanted_[row] = 1;
    std::vector<float> count(guide_.size()); // of wanted points
    for (std::size_t k = 0; k < guide_.order.size(); ++k)
      count[guide_.datumOf(k)] += wanted_[guide_.order[k]];
    for (std::size_t m = 0; m < guide_.size(); ++m)
      if (count[m] > 0.0f && (!guide_.merged() || 2.0f * count[m] >= guide_.weights[m]))
        moving_.push_back(static_cast<std::uint32_t>(m));
  }

  /** Moves the data, and with them the wanted points that they stand for. */
  void
  moveData()
  {
    const NormalTensors tensors = this->tensors();
    SteeredMoves all{SortedVectors<float>(guide_.size()), SortedVectors<float>(guide_.size())};
    for (std::size_t first = 0; first < moving_.size(); first += kQueriesAtOnce) {
      SteeredQueries queries;
      queries.data.assign(moving_.begin() + static_cast<std::ptrdiff_t>(first),
                          moving_.begin() + static_cast<std::ptrdiff_t>(std::min(first + kQueriesAtOnce, moving_.size())));
      queries.positions = gather<float>(guide_.view(), {}, queries.data, kFarAway, threads_);
      queries.normals = gather<float>(guide_.normalsView(), {}, queries.data, 0.0f, threads_);
      const SteeredMoves moves = fitPlanes(p_, guide_, tensors, queries, threads_);
      for (std::size_t q = 0; q < queries.data.size(); ++q) {
        set(moves.moves, q, 1.0f, viewOf(all.moves), queries.data[q]);
        set(moves.normals, q, 1.0f, viewOf(all.normals), queries.data[q]);
      }
    }
    for (std::size_t k = 0; k < guide_.order.size(); ++k)
      if (wanted_[guide_.order[k]] != 0)
        movePoint(guide_.order[k], all, guide_.datumOf(k));
    for (const std::uint32_t m : moving_) {
      if (!foundPlane(all, m))
        continue;
      add(all.moves, m, 1.0f, viewOf(guide_.positions), m);
      add(all.moves, m, -1.0f, viewOf(guide_.residuals), m);
      set(all.normals, m, 1.0f, viewOf(guide_.normals), m);
    }
    guide_.tree.fit(guide_.view(), threads_);
  }

  /** Moves the wanted points one by one. */
  void
  movePoints()
  {
    const NormalTensors tensors = this->tensors();
    std::vector<std::uint32_t> rows;
    SteeredQueries queries;
    for (std::size_t k = 0; k < guide_.order.size(); ++k) {
      if (wanted_[guide_.order[k]] != 0) {
        rows.push_back(guide_.order[k]);
        queries.data.push_back(static_cast<std::uint32_t>(guide_.datumOf(k)));
      }
      if (rows.size() < kQueriesAtOnce && k + 1 < guide_.order.size())
        continue;
      if (rows.empty())
        break;
      queries.positions = gather<float>(positions_, {}, rows, kFarAway, threads_);
      queries.normals = gather<float>(normals_, {}, rows, 0.0f, threads_);
      const SteeredMoves moves = fitPlanes(p_, guide_, tensors, queries, threads_);
      for (std::size_t q = 0; q < rows.size(); ++q)
        movePoint(rows[q], moves, q);
      rows.clear();
      queries.data.clear();
    }
  }

private:
  NormalTensors
  tensors() const
  {
    const float* const weights = guide_.merged() ? guide_.weights.data() : nullptr;
    return {guide_.view(), guide_.tree, guide_.normalsView(), weights, p_.direction_radius, threads_};
  }

  static bool
  foundPlane(const SteeredMoves& moves, std::size_t q)
  {
    const SortedVectors<float>& n = moves.normals;
    return n.x[q] != 0.0f || n.y[q] != 0.0f || n.z[q] != 0.0f;
  }

  /** The point keeps the side of its normal. */
  void
  movePoint(std::size_t row, const SteeredMoves& moves, std::size_t q)
  {
    if (!foundPlane(moves, q))
      return;
    const SortedVectors<float>& n = moves.normals;
    const float cosine = n.x[q] * normals_.x[row] + n.y[q] * normals_.y[row] + n.z[q] * normals_.z[row];
    add(moves.moves, q, 1.0f, positions_, row);
    set(n, q, std::copysign(1.0f, cosine), normals_, row);
  }

  const SteeredFitParameters& p_;
  std::size_t threads_;
  SteeredGuide guide_;
  std::vector<std::uint8_t> wanted_;
  std::vector<std::uint32_t> moving_; ///< data of which at least half of the points are wanted
  MutableVectorsView positions_, normals_;
};

} // namespace

void
validate(const SteeredFitParameters& p)
{
  checkRange("steered radius", p.radius, p.radius >= 0.0, ">= 0, 0 = estimated");
  checkRange("direction radius", p.direction_radius, p.direction_radius >= 0.0, ">= 0, 0 = estimated");
  checkRange("longest share", p.longest_share, p.longest_share >= 1.0, ">= 1");
  checkRange("bending weight", p.bending_weight, p.bending_weight >= 0.0, ">= 0");
}

void
fitSteeredPlanes(const SteeredFitParameters& parameters, PointsView noisy, const std::vector<std::uint32_t>& places,
                 MutableVectorsView positions, MutableVectorsView normals, const ProgressCallback& progress)
{
  validate(parameters);
  if (parameters.passes == 0)
    return;
  checkRange("steered radius", parameters.radius, parameters.radius > 0.0, "> 0");
  checkRange("direction radius", parameters.direction_radius, parameters.direction_radius > 0.0, "> 0");
  if (places.empty())
    return;
  if (*std::max_element(places.begin(), places.end()) >= noisy.size || positions.size != noisy.size || normals.size != noisy.size)
    throw InvalidParameter("a place beyond the points, or positions and normals of another number");
  const auto report = [&](double fraction) {
    if (progress && !progress(fraction))
      throw Cancelled();
  };
  report(0.0);
  SteeredPasses passes(parameters, noisy, places, positions, normals);
  for (unsigned pass = 1; pass < parameters.passes; ++pass) {
    passes.moveData();
    report(static_cast<double>(pass) / parameters.passes);
  }
  passes.movePoints();
  report(1.0);
}

} // namespace pcl_gpf
