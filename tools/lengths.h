// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/analysis/parameter_estimation.h>

#include <optional>
#include <string>

namespace pcl_gpf {

/** \brief A length as the user writes it: 0.01 (cloud units), 4x (times the mean spacing), 1% (of the box diagonal), auto. */
struct Length {
  enum class Unit { Auto, Cloud, Spacing, Diagonal };
  Unit unit = Unit::Auto;
  double value = 0.0; ///< in that unit; 4 for 4x, 1 for 1%

  /** \brief In cloud units; 0 for auto, which the library's structs read as "estimate". */
  double
  resolve(const CloudScale& scale) const;
};

/** \brief Reads a length; empty when the text is none, negative, or not finite. Independent of the locale. */
std::optional<Length>
parseLength(const std::string& text);

/** \brief Reads a finite number that fills the whole text. Independent of the locale. */
std::optional<double>
parseNumber(const std::string& text);

} // namespace pcl_gpf
