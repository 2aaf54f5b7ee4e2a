// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/operators/gpf_parameters.h>

#include "../check_range.h"

namespace pcl_gpf {

GPFParameters
GPFParameters::paper()
{
  GPFParameters p;
  p.repulsion_weight = 0.2;
  p.outlier_weight = 0.02;
  p.initial_variance = 0.004;
  p.variance_update = VarianceUpdate::Paper;
  p.data_term = DataTerm::PointToPlane;
  p.posterior_normalization = true;
  p.density_weights = true;
  p.normal_angle = 90.0;
  p.normal_weight_floor = 1.0;
  p.own_tangent_repulsion = false;
  p.sample_ratio = 0.5;
  p.maximum_iterations = 30;
  p.convergence_threshold = 0.0;
  p.merge_above = 0;
  return p;
}

bool
runsInDouble(const GPFParameters& p)
{
  return p.posterior_normalization || p.variance_update != VarianceUpdate::Fixed;
}

void
validate(const GPFParameters& p)
{
  checkRange("support_radius", p.support_radius, p.support_radius >= 0.0, ">= 0, 0 = estimated");
  checkRange("repulsion_weight", p.repulsion_weight, p.repulsion_weight >= 0.0 && p.repulsion_weight <= 0.5,
             "0 .. 0.5");
  checkRange("outlier_weight", p.outlier_weight, p.outlier_weight >= 0.0 && p.outlier_weight < 1.0, "0 <= omega < 1");
  checkRange("initial_variance", p.initial_variance, p.initial_variance >= 0.0, ">= 0, 0 = (h / 2)^2");
  checkRange("normal_angle", p.normal_angle, p.normal_angle > 0.0 && p.normal_angle <= 90.0, "0 < angle <= 90 degrees");
  checkRange("normal_weight_floor", p.normal_weight_floor, p.normal_weight_floor >= 0.0 && p.normal_weight_floor <= 1.0,
             "0 .. 1");
  checkRange("sample_ratio", p.sample_ratio, p.sample_ratio > 0.0 && p.sample_ratio <= 1.0, "0 < ratio <= 1");
  checkRange("maximum_iterations", p.maximum_iterations, p.maximum_iterations <= 10000, "0 .. 10000");
  checkRange("gap_iterations", p.gap_iterations, p.gap_iterations <= 100, "0 .. 100");
  checkRange("gap_radius_factor", p.gap_radius_factor, p.gap_radius_factor >= 1.0 && p.gap_radius_factor <= 8.0, "1 .. 8");
  checkRange("convergence_threshold", p.convergence_threshold, p.convergence_threshold >= 0.0, ">= 0");
}

} // namespace pcl_gpf
