// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/** \file
 * \brief Symbol visibility of the PCL-facing library, which is built with hidden visibility.
 */
#if defined(_WIN32) && defined(PCL_GPF_SHARED)
#ifdef PCL_GPF_BUILD
#define PCL_GPF_EXPORT __declspec(dllexport)
#else
#define PCL_GPF_EXPORT __declspec(dllimport)
#endif
#elif defined(__GNUC__)
#define PCL_GPF_EXPORT __attribute__((visibility("default")))
#else
#define PCL_GPF_EXPORT
#endif
