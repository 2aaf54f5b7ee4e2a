// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/export.h>

#include <cstddef>
#include <functional>

namespace pcl_gpf {

/** \brief Number of threads that `requested` stands for: 0 = all that this process may use; otherwise clamped to [1, 1024]. */
PCL_GPF_CORE_EXPORT std::size_t
resolveThreads(unsigned requested);

/** \brief Calls body(begin, end) on consecutive blocks [k * block, (k + 1) * block) of [0, count), on up to `threads` threads.
 *
 * The blocks do not depend on the number of threads, so a body that writes only its own block's results (or one partial result a
 * block, summed in block order afterwards) gives the same bits for any number. Exceptions of the body are thrown to the caller.
 * Safe to call from several threads at once; from within a body, too.
 */
PCL_GPF_CORE_EXPORT void
parallelBlocks(std::size_t count,
               std::size_t block,
               std::size_t threads,
               const std::function<void(std::size_t begin, std::size_t end)>& body);

} // namespace pcl_gpf
