// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>

namespace pcl_gpf::quality {

/** \brief What is measured of one filtered cloud; NaN = does not apply. docs/quality.md defines every figure. */
struct Figures {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  // 1e-4 of the box diagonal
  double mean = kNone, rms = kNone, p95 = kNone, max = kNone;
  double signed_mean = kNone;
  double edge_mean = kNone;                      ///< emean
  double edge_coverage = kNone;                  ///< ecov
  double coverage = kNone;                       ///< cov
  double mean_all = kNone, mean_inliers = kNone; ///< with all outliers, and without any
  // shares
  double edge_share = kNone; ///< efrac
  double wrong_sheet = kNone, middle_of_gap = kNone;
  // degrees
  double normal_error = kNone, normal_error_edge = kNone;
  // mean spacings
  double movement = kNone, movement_away = kNone, recession = kNone, boundary_pull = kNone;
  // others
  double points = 0, not_finite = 0;
  double mean_square = kNone; ///< of distance / diagonal, the paper's error
  double seconds = kNone, processor_seconds = kNone;
};

/** \brief A column of the table and of the CSV file. */
struct FigureColumn {
  const char* name;
  double Figures::*value;
  const char* format;
};

constexpr FigureColumn kFigureColumns[] = {
    {"n", &Figures::points, "%.0f"},
    {"mean", &Figures::mean, "%.2f"},
    {"rms", &Figures::rms, "%.2f"},
    {"p95", &Figures::p95, "%.1f"},
    {"max", &Figures::max, "%.0f"},
    {"emean", &Figures::edge_mean, "%.2f"},
    {"efrac", &Figures::edge_share, "%.4f"},
    {"ecov", &Figures::edge_coverage, "%.1f"},
    {"cov", &Figures::coverage, "%.1f"},
    {"signed", &Figures::signed_mean, "%+.2f"},
    {"nang", &Figures::normal_error, "%.2f"},
    {"nang_e", &Figures::normal_error_edge, "%.1f"},
    {"mse", &Figures::mean_square, "%.2e"},
    {"mean_all", &Figures::mean_all, "%.2f"},
    {"mean_in", &Figures::mean_inliers, "%.2f"},
    {"move", &Figures::movement, "%.4f"},
    {"move_away", &Figures::movement_away, "%.5f"},
    {"recede", &Figures::recession, "%+.2f"},
    {"pull", &Figures::boundary_pull, "%+.3f"},
    {"wrong", &Figures::wrong_sheet, "%.4f"},
    {"middle", &Figures::middle_of_gap, "%.4f"},
    {"bad", &Figures::not_finite, "%.0f"},
    {"cpu_s", &Figures::processor_seconds, "%.2f"},
    {"s", &Figures::seconds, "%.2f"},
};

} // namespace pcl_gpf::quality
