// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "models.h"

#include <cstdint>
#include <string>
#include <vector>

namespace pcl_gpf::quality {

/** \brief What is done to the points of a model. */
enum class NoiseKind {
  Gaussian, ///< isotropic, standard deviation = level on each axis
  Normal,   ///< Gaussian along the true normal, standard deviation = level
  Uniform,  ///< even in [-level, level] on each axis; standard deviation 0.577 level
  Scanner   ///< seen from one viewpoint: three times as much along the ray as across, more with distance and grazing
            ///< angle
};

/** \brief The kind called "gaussian", "normal", "uniform" or "scanner". \throws std::invalid_argument */
NoiseKind
noiseKind(const std::string& name);
const char*
nameOf(NoiseKind kind);

/** \brief How a cloud is made. */
struct NoiseSpec {
  NoiseKind kind = NoiseKind::Gaussian;
  double percent = 0; ///< level in percent of the box diagonal of the model
  double outliers =
      0; ///< share of the points replaced by points of the box enlarged 1.2 times, at least 0.2 diagonals wide
  std::uint64_t seed = 1;
};

/** \brief A cloud with all that is known about it. */
struct NoisyCloud {
  Model model;
  NoiseSpec spec;
  std::vector<SurfaceSample> clean; ///< where each point came from
  std::vector<Position> points;
  std::vector<std::uint8_t> is_outlier; ///< 1 = has nothing to do with the surface
  double spacing = 0;                   ///< mean, of the clean points
};

/** \brief Draws `count` points and adds noise. The clean points depend on model, count and seed only. */
NoisyCloud
makeNoisyCloud(const Model& model, std::size_t count, const NoiseSpec& spec);

} // namespace pcl_gpf::quality
