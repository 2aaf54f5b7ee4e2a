// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "options.h"

#include <pcl_gpf/io/cloud_file.h>
#include <pcl_gpf/pipeline/denoise.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace pcl_gpf {

class Console;

/** \brief What happens to outliers. */
enum class OutlierHandling { Keep, Flag, Drop };

/** \brief The options --outliers and --fields. */
std::vector<OptionSpec>
resultFieldOptions();

OutlierHandling
outlierHandling(const Options& options);

/** \brief Extra fields to write, in their order: those of --fields, then `outlier` where outliers are flagged.
 * \throws UsageError on a name that is none, or is given twice */
std::vector<std::string>
resultFields(const Options& options);

/** \brief What denoise() must find out for them. */
DenoiseFlags
neededFlags(const Options& options);

/** \brief Refuses, before any work, an input with a field of such a name that is a list. \throws UnsuitableData */
void
checkResultFields(const CloudFile& cloud, const std::vector<std::string>& fields);

/** \brief Writes the fields as float, NaN in rows without a result. A field of that name is replaced, and that is told.
 * \param[in] rows of `cloud` for each point of the result \param[in] moves as written, cloud units */
void
applyResultFields(CloudFile& cloud, const DenoiseResult& result, const std::vector<std::uint32_t>& rows,
                  const std::vector<double>& moves, const std::vector<std::string>& fields, Console& console);

/** \brief Points whose outlier probability is above DenoiseResult::kOutlier. */
std::size_t
countOutliers(const DenoiseResult& result);

/** \brief Takes the outliers out of `cloud`, which is organised no more then; rows without finite coordinates stay. */
void
dropOutliers(CloudFile& cloud, const DenoiseResult& result, const std::vector<std::uint32_t>& rows);

} // namespace pcl_gpf
