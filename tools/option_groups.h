// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "options.h"

#include <pcl_gpf/io/cloud_file.h>
#include <pcl_gpf/io/write_cloud.h>

#include <optional>
#include <string>
#include <vector>

namespace pcl_gpf {

// Options that several commands have, so that they look the same everywhere.
OptionSpec
helpOption(); ///< --help, -h
OptionSpec
quietOption(); ///< --quiet, -q
OptionSpec
outputOption(); ///< --output, -o FILE
OptionSpec
formatOption(); ///< --format pcd-ascii|...|xyz
OptionSpec
overwriteOption(); ///< --overwrite
OptionSpec
jsonOption(); ///< --json[=FILE]
OptionSpec
threadsOption(); ///< --threads N, 0 = all
OptionSpec
seedOption(); ///< --seed N
OptionSpec
progressOption(); ///< --progress auto|bar|plain|none
OptionSpec
forceOption(); ///< --force, for data that would be refused

/** \brief Joins lists of options. */
std::vector<OptionSpec>
operator+(std::vector<OptionSpec> first, const std::vector<OptionSpec>& second);

/** \brief Value of --threads. */
unsigned
threadCount(const Options& options);

/** \brief The value of --output. \throws UsageError when it is missing */
const std::string&
outputPath(const Options& options);

/** \brief The value of --format, empty when it is not given. */
std::optional<CloudFormat>
chosenFormat(const Options& options);

/** \brief Format and overwriting as writeCloud() wants them. */
WriteOptions
writeOptions(const Options& options);

/** \brief Asks before any work whether the format of the output can hold such a cloud. \throws IoError (kind Unwritable) */
void
checkOutputHolds(const CloudFile& cloud, const Options& options);

/** \brief Asks before any work whether the file of --json, if there is one, can be written and is not an input.
 * \throws UsageError, IoError (kind Unwritable) */
void
checkReport(const Options& options);

/** \brief Asks before any work whether --output and --json FILE can be written and whether the extension names a format; refuses
 * both on standard output.
 * \throws UsageError, IoError (kind Unwritable) */
void
checkOutputs(const Options& options);

} // namespace pcl_gpf
