// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/common/export.h>
#include <pcl_gpf/pipeline/denoise.h>

namespace pcl_gpf {

/** \brief For machined parts: flat faces that meet in sharp edges. Twice as many rounds of the bilateral normal filter make normals flatter
 * and edges sharper; narrow rounded parts become facets. */
PCL_GPF_EXPORT DenoiseParameters
prismaticPreset();

/** \brief For smooth shapes: normals are averaged across 60 instead of 30 degrees, so that no edge is seen where noise bends them;
 * weak edges are rounded. */
PCL_GPF_EXPORT DenoiseParameters
freeformPreset();

/** \brief Algorithm 1 of the paper, GPFParameters::paper(). */
PCL_GPF_EXPORT DenoiseParameters
paperPreset();

} // namespace pcl_gpf
