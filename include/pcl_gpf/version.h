// SPDX-License-Identifier: BSD-3-Clause
/** \file
  * \brief The one place of the version number; CMake reads these three lines, a test compares package.xml.
  *
  * Semantic versioning; while the major number is 0, a new minor number may break source and binary compatibility.
  */
#pragma once

#define PCL_GPF_VERSION_MAJOR 0
#define PCL_GPF_VERSION_MINOR 1
#define PCL_GPF_VERSION_PATCH 0

#define PCL_GPF_VERSION_STRINGIZE_(major, minor, patch) #major "." #minor "." #patch
#define PCL_GPF_VERSION_STRINGIZE(major, minor, patch) PCL_GPF_VERSION_STRINGIZE_(major, minor, patch)

/** \brief The version as text, "major.minor.patch". */
#define PCL_GPF_VERSION \
  PCL_GPF_VERSION_STRINGIZE(PCL_GPF_VERSION_MAJOR, PCL_GPF_VERSION_MINOR, PCL_GPF_VERSION_PATCH)

/** \brief The version as one number for comparisons: major * 10000 + minor * 100 + patch. */
#define PCL_GPF_VERSION_NUMBER \
  (PCL_GPF_VERSION_MAJOR * 10000 + PCL_GPF_VERSION_MINOR * 100 + PCL_GPF_VERSION_PATCH)
