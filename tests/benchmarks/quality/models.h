// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "surface.h"

#include <memory>
#include <string>
#include <vector>

namespace pcl_gpf::quality {

/** \brief A surface and how points lie on it. */
struct Model {
  std::string name;
  std::shared_ptr<const Surface> surface;
  double density_gradient = 0; ///< G: density along x is exp(G x / diagonal), 0 = even
  double sheet_gap = 0;        ///< distance of two parallel sheets in model units; 0 = no such model
};

constexpr const char* kModelNames =
    "cube, block, sphere, relief, cylinder, torus, sheets[:gap in spacings, default 4], plane, cap, star, "
    "cube-graded[:G, default 4], block-graded[:G], mesh:<name of a shared mesh>";

/** \brief Makes a model. \param[in] count points that will be drawn; the gap of `sheets` is in their spacing.
 * \throws std::invalid_argument on unknown names, std::runtime_error when the file of a mesh is not there */
Model
makeModel(const std::string& name, std::size_t count);

/** \brief `count` clean points, repeatable by `seed`. */
std::vector<SurfaceSample>
sampleModel(const Model& model, std::size_t count, std::uint64_t seed);

/** \brief Mean spacing sqrt(area / count), model units. */
double
spacingOf(const Model& model, std::size_t count);

} // namespace pcl_gpf::quality
