// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "options.h"

#include <pcl_gpf/pipeline/denoise.h>

#include <cstdint>
#include <functional>
#include <string>
#include <variant>
#include <vector>

namespace pcl_gpf {

using ParameterValue = std::variant<double, std::uint64_t, std::string>;

/** \brief One field of DenoiseParameters and the option that sets it. */
struct FilterParameter {
  OptionSpec option;
  std::string field; ///< as ParameterOrigin names it
  std::function<void(DenoiseParameters&, const std::string& text, const CloudScale&)> set;
  std::function<ParameterValue(const DenoiseParameters&)> get;
};

/** \brief A parameter as it was used: for the report and for the reader of the terminal. */
struct EffectiveParameter {
  std::string name; ///< of the option
  ParameterValue value;
  std::string origin; ///< "user", "estimated", "preset" or "default"
  std::string reason; ///< "12 x noise", or what the user wrote; may be empty
};

/** \brief The parameters of the chain, in the order of the help; defaults and ranges are those of the library's structs. */
const std::vector<FilterParameter>&
filterParameters();

/** \brief Those whose field is in the list, in its order. */
std::vector<FilterParameter>
selectParameters(const std::vector<std::string>& fields);

std::vector<OptionSpec>
optionsOf(const std::vector<FilterParameter>& parameters);

/** \brief Writes every option that was given over `base`. \param[in] scale for 4x and 1% */
DenoiseParameters
readParameters(const std::vector<FilterParameter>& table, const Options& options, const CloudScale& scale,
               const DenoiseParameters& base);

/** \brief Whether a length was given in multiples of spacing or diagonal, so that the cloud must be measured first. */
bool
needsScale(const std::vector<FilterParameter>& table, const Options& options);

/** \brief What was used and why: "preset" stands where neither the user nor an estimate decided and the default differs.
 * \param[in] estimated DenoiseResult::parameters */
std::vector<EffectiveParameter>
effectiveParameters(const std::vector<FilterParameter>& table, const Options& options, const DenoiseParameters& used,
                    const std::vector<ParameterOrigin>& estimated);

/** \brief The word, or six significant digits. */
std::string
valueText(const ParameterValue& value);

} // namespace pcl_gpf
