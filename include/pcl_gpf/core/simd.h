// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/export.h>

#include <string>
#include <vector>

namespace pcl_gpf {

/** \brief Names of the instruction sets that both this build and this processor have, best first:
 * of "avx512", "avx2", "sse4", "scalar" (other architectures: the name that Highway gives them). */
PCL_GPF_CORE_EXPORT std::vector<std::string>
availableSimdTargets();

/** \brief The instruction set that the kernels run on now. */
PCL_GPF_CORE_EXPORT std::string
activeSimdTarget();

/** \brief Forces an instruction set for the whole process; the environment variable PCL_GPF_SIMD does so at first use.
 *
 * An empty name returns to the best. Results are the same bits on every one.
 * \throws InvalidParameter if the name is not in availableSimdTargets().
 * \note Not to be called while a filter runs.
 */
PCL_GPF_CORE_EXPORT void
setSimdTarget(const std::string& name);

} // namespace pcl_gpf
