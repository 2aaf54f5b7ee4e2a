// SPDX-License-Identifier: BSD-3-Clause
#include "console.h"
#include "default_reasons.h"
#include "filter_parameters.h"

#include <algorithm>
#include <cmath>

namespace pcl_gpf {

std::vector<OptionSpec>
optionsOf(const std::vector<FilterParameter>& parameters)
{
  std::vector<OptionSpec> options;
  for (const FilterParameter& parameter : parameters)
    options.push_back(parameter.option);
  return options;
}

DenoiseParameters
readParameters(const std::vector<FilterParameter>& table, const Options& options, const CloudScale& scale,
               const DenoiseParameters& base)
{
  DenoiseParameters parameters = base;
  for (const FilterParameter& parameter : table) {
    if (!options.given(parameter.option.name))
      continue;
    const std::string& text = options.text(parameter.option.name);
    parameter.set(parameters, text, scale);
    // 0 would mean "estimate" to the library.
    if (parameter.option.kind == OptionKind::Length && text != "auto" && parameter.get(parameters) == ParameterValue(0.0))
      throw UsageError("option '--" + parameter.option.name + "': " + text + " is 0 for this cloud");
  }
  return parameters;
}

bool
needsScale(const std::vector<FilterParameter>& table, const Options& options)
{
  return std::any_of(table.begin(), table.end(), [&options](const FilterParameter& parameter) {
    if (parameter.option.kind != OptionKind::Length)
      return false;
    const Length::Unit unit = options.length(parameter.option.name).unit;
    return unit == Length::Unit::Spacing || unit == Length::Unit::Diagonal;
  });
}

std::vector<EffectiveParameter>
effectiveParameters(const std::vector<FilterParameter>& table, const Options& options, const DenoiseParameters& used,
                    const std::vector<ParameterOrigin>& estimated)
{
  std::vector<EffectiveParameter> list;
  for (const FilterParameter& parameter : table) {
    EffectiveParameter effective{parameter.option.name, parameter.get(used), "default", ""};
    if (effective.value != parameter.get(DenoiseParameters{}))
      effective.origin = "preset";
    for (const ParameterOrigin& origin : estimated)
      if (origin.name == parameter.field) {
        effective.value = std::isfinite(origin.value) ? ParameterValue(origin.value) : ParameterValue(std::string("none"));
        effective.origin = origin.origin;
        effective.reason = origin.reason;
      }
    const std::string& text = options.text(parameter.option.name);
    if (options.given(parameter.option.name) && text != "auto") {
      effective.origin = "user";
      effective.reason = parameter.option.kind == OptionKind::Length ? text : "";
    }
    if (effective.origin == "default" && effective.reason.empty())
      effective.reason = reasonOfDefault(parameter.field);
    list.push_back(effective);
  }
  return list;
}

std::string
valueText(const ParameterValue& value)
{
  if (const double* number = std::get_if<double>(&value))
    return shortNumber(*number);
  if (const std::uint64_t* count = std::get_if<std::uint64_t>(&value))
    return std::to_string(*count);
  return std::get<std::string>(value);
}

} // namespace pcl_gpf
