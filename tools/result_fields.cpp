// SPDX-License-Identifier: BSD-3-Clause
#include "result_fields.h"

#include "console.h"
#include "field_types.h"

#include <pcl_gpf/core/errors.h>

#include <algorithm>
#include <limits>

namespace pcl_gpf {

namespace {

const std::vector<std::string> kNames{"movement", "sigma", "edge", "outlier"};

bool
contains(const std::vector<std::string>& names, const std::string& name)
{
  return std::find(names.begin(), names.end(), name) != names.end();
}

/** Value of a field for the k-th point of the result; NaN where nothing could be found out. */
double
valueOf(const std::string& field, const DenoiseResult& result, const std::vector<double>& moves, std::size_t k)
{
  const auto at = [k](const auto& values) {
    return values.empty() ? std::numeric_limits<double>::quiet_NaN() : static_cast<double>(values[k]);
  };
  return field == "movement" ? moves[k] : field == "sigma" ? at(result.sigma) : field == "edge" ? at(result.edge) : at(result.outlier);
}

/** Whether no value of a field overflows a float, or underflows and becomes 0. */
bool
fitsFloat(const std::string& field, const DenoiseResult& result, const std::vector<double>& moves)
{
  using Float = std::numeric_limits<float>;
  double largest = 0.0;
  for (std::size_t k = 0; k < moves.size(); ++k)
    largest = std::max(largest, valueOf(field, result, moves, k)); // NaN is passed over
  return largest == 0.0 || (largest <= static_cast<double>(Float::max()) && largest >= 1e3 * static_cast<double>(Float::min()));
}

bool
isOutlier(const DenoiseResult& result, std::size_t k)
{
  return result.outlier[k] > DenoiseResult::kOutlier;
}

} // namespace

std::vector<OptionSpec>
resultFieldOptions()
{
  OptionSpec outliers{"outliers", OptionKind::Choice, "", "flag",
                      "flag: write their probability as field 'outlier'; drop: leave them out; keep: neither"};
  outliers.choices = {"keep", "flag", "drop"};
  return {outliers,
          {"fields", OptionKind::Text, "NAME,...", "",
           "extra float fields: movement (length of the move), sigma (noise taken out nearby), edge (1 = within h / 4 of a sharp edge), "
           "outlier (probability)"}};
}

OutlierHandling
outlierHandling(const Options& options)
{
  const std::string& word = options.text("outliers");
  return word == "keep" ? OutlierHandling::Keep : word == "drop" ? OutlierHandling::Drop : OutlierHandling::Flag;
}

std::vector<std::string>
resultFields(const Options& options)
{
  std::vector<std::string> fields;
  const std::string& text = options.text("fields");
  for (std::size_t begin = 0; options.given("fields") && begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string name = text.substr(begin, end - begin);
    if (!contains(kNames, name))
      throw UsageError("option '--fields': there is no field '" + name + "'; there are movement, sigma, edge and outlier");
    if (contains(fields, name))
      throw UsageError("option '--fields': '" + name + "' is given twice");
    fields.push_back(name);
    begin = end + 1;
  }
  if (outlierHandling(options) == OutlierHandling::Flag && !contains(fields, "outlier"))
    fields.push_back("outlier");
  return fields;
}

DenoiseFlags
neededFlags(const Options& options)
{
  const std::vector<std::string> fields = resultFields(options);
  DenoiseFlags flags;
  flags.outliers = true; // also where they are kept: they are no data for the others
  flags.sigma = contains(fields, "sigma");
  flags.edges = contains(fields, "edge");
  return flags;
}

void
checkResultFields(const CloudFile& cloud, const std::vector<std::string>& fields)
{
  for (const CloudField& field : cloud.fields)
    if (contains(fields, field.name) && field.count != 1)
      throw UnsuitableData("the input has a field '" + field.name + "' of " + std::to_string(field.count) +
                           " elements, which a field of the filter would replace; rename it, or leave it out with --fields and "
                           "--outliers keep");
}

void
applyResultFields(CloudFile& cloud, const DenoiseResult& result, const std::vector<std::uint32_t>& rows,
                  const std::vector<double>& moves, const std::vector<std::string>& fields, Console& console)
{
  for (const std::string& name : fields) {
    int field = cloud.findField(name);
    const FieldType type = fitsFloat(name, result, moves) ? FieldType::Float32 : FieldType::Float64;
    if (field >= 0) {
      console.say("the field '" + name + "' of the input is replaced");
      changeFieldTypes(cloud, {name}, type);
    } else
      field = cloud.addField(name, type);
    for (std::size_t i = 0; i < cloud.size(); ++i)
      cloud.setValue(i, field, std::numeric_limits<double>::quiet_NaN());
    for (std::size_t k = 0; k < rows.size(); ++k)
      cloud.setValue(rows[k], field, valueOf(name, result, moves, k));
  }
}

std::size_t
countOutliers(const DenoiseResult& result)
{
  std::size_t count = 0;
  for (std::size_t k = 0; k < result.outlier.size(); ++k)
    count += isOutlier(result, k);
  return count;
}

void
dropOutliers(CloudFile& cloud, const DenoiseResult& result, const std::vector<std::uint32_t>& rows)
{
  std::vector<std::uint8_t> dropped(cloud.size());
  for (std::size_t k = 0; k < result.outlier.size(); ++k)
    dropped[rows[k]] = isOutlier(result, k);
  std::vector<std::uint32_t> kept;
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (dropped[i] == 0)
      kept.push_back(static_cast<std::uint32_t>(i));
  if (kept.size() < cloud.size())
    cloud = cloud.select(kept);
}

} // namespace pcl_gpf
