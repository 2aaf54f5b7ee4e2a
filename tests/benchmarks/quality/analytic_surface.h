// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "patches.h"
#include "surface.h"

#include <functional>
#include <memory>
#include <vector>

namespace pcl_gpf::quality {

/** \brief A surface of patches with exact distances. */
class AnalyticSurface : public Surface {
public:
  struct Parts {
    std::vector<std::unique_ptr<Patch>> patches;
    std::vector<Curve> edges;
    std::vector<Curve> boundary; ///< empty: the surface is closed
    Position box_min{0, 0, 0}, box_max{0, 0, 0};
    std::function<bool(const Position&)> inside; ///< gives distances their sign
  };
  explicit AnalyticSurface(Parts parts);

  BoundingBox
  box() const override
  {
    return box_;
  }
  double
  area() const override
  {
    return areas_.back();
  }
  bool
  closed() const override
  {
    return parts_.boundary.empty();
  }
  std::vector<SurfaceSample>
  sample(std::size_t count, std::uint64_t seed) const override;
  SurfaceHit
  nearest(const Position& p) const override;
  double
  edgeDistance(const Position& p) const override
  {
    return distanceToCurves(parts_.edges, p);
  }
  std::vector<Position>
  edgeSamples(double step) const override;
  double
  boundaryDistance(const Position& p) const override
  {
    return distanceToCurves(parts_.boundary, p);
  }
  std::vector<BoundarySample>
  boundarySamples(double step) const override
  {
    return sampleCurves(parts_.boundary, step);
  }

private:
  Parts parts_;
  BoundingBox box_;
  std::vector<double> areas_; ///< of patches 0 .. i together
};

} // namespace pcl_gpf::quality
