// SPDX-License-Identifier: BSD-3-Clause
#include "default_reasons.h"

namespace pcl_gpf {

namespace {

struct Reason {
  const char* field;
  const char* text;
};

const Reason kReasons[] = {
    {"gpf.maximum_iterations", "moves have settled by then"},
    {"gpf.repulsion_weight", "mu-hat 0: points move along normals only, colours and ids stay in place"},
    {"gpf.outlier_weight", "omega: one point in fifty may be an outlier"},
    {"gpf.variance_update", "eq. 11 makes sigma collapse, and filtering stop"},
    {"gpf.data_term", "the paper's point-to-plane term inflates curved parts"},
    {"gpf.posterior_normalization", "needed only when sigma moves"},
    {"gpf.density_weights", "they add noise where density is even"},
    {"gpf.normal_angle", "faces do not pull each other"},
    {"gpf.normal_weight_floor", "points beside an edge still find the other face"},
    {"gpf.own_tangent_repulsion", "points at edges stay on their face"},
    {"gpf.gap_iterations", "no band empties beside edges unless normals do not weigh; points stay in place"},
    {"gpf.gap_radius_factor", "twice the width of an empty band"},
    {"gpf.convergence_threshold", "share of h below which nothing is seen"},
    {"bilateral.angle", "edges above it stay sharp"},
    {"bilateral.iterations", "enough for edges to become sharp"},
    {"bilateral.sign_invariant", "normals need no orientation"},
    {"two_scales", "fine detail is kept where heights above the coarse surface are more than noise"},
    {"strength", "the noise as it was measured"},
};

} // namespace

std::string
reasonOfDefault(const std::string& field)
{
  for (const Reason& reason : kReasons)
    if (field == reason.field)
      return reason.text;
  return "";
}

} // namespace pcl_gpf
