// SPDX-License-Identifier: BSD-3-Clause
#include "upsample_options.h"

#include "console.h"
#include "option_groups.h"

#include <string>

namespace pcl_gpf {

namespace {

bool
isEdgeAware(const Options& options)
{
  return options.text("method") == "ear";
}

} // namespace

std::vector<OptionSpec>
upsampleOptions()
{
  const EdgeAwareUpsamplingParameters defaults;
  const auto number = [](const char* name, double least, double most, double value, const char* help) {
    OptionSpec spec{name, OptionKind::Number, "X", shortNumber(value), help};
    spec.least = least;
    spec.most = most;
    return spec;
  };
  OptionSpec count{"count", OptionKind::Count, "N", "", "points of the output in all, at least as many as the input has"};
  count.least = 3;
  count.most = 2147483648.0;
  OptionSpec method{"method", OptionKind::Choice, "", "ear", "ear: gaps are filled, edges first; mls: points on fitted polynomials, "
                                                             "which smooth the cloud and round edges"};
  method.choices = {"ear", "mls"};
  OptionSpec normals{"normals", OptionKind::Choice, "", "auto", "auto: those of the file if it has any, else estimated"};
  normals.choices = {"auto", "file", "estimate"};
  OptionSpec order{"mls-order", OptionKind::Count, "N", "2", "mls: degree of the polynomials"};
  order.least = 0;
  order.most = 5;
  OptionSpec angle = number("angle", 0, 90, defaults.angle, "ear: turn of the normals, degrees, at which a neighbour's weight is 1/e");
  angle.above_least = true;
  return {number("factor", 1, 1000, 2, "points of the output in all, as a multiple of the input's"),
          count,
          {"spacing", OptionKind::Length, "LENGTH", "", "fill up to this distance between neighbours; finer parts stay"},
          method,
          number("edge-sensitivity", 0, 10, defaults.edge_sensitivity, "ear: 0 fills evenly, higher values edges first and denser"),
          angle,
          {"radius", OptionKind::Length, "LENGTH", "auto", "wider gaps stay open; auto is 3x for ear, 4x for mls"},
          normals,
          {"oriented", OptionKind::Flag, "", "", "ear: the normals of the file are consistently oriented; keeps thin sheets apart"},
          order};
}

void
checkUpsampleOptions(const Options& options)
{
  if (options.given("factor") + options.given("count") + options.given("spacing") > 1)
    throw UsageError("--factor, --count and --spacing exclude each other");
  const std::vector<const char*> foreign = isEdgeAware(options)
                                               ? std::vector<const char*>{"mls-order", "seed"}
                                               : std::vector<const char*>{"edge-sensitivity", "angle", "oriented"};
  for (const char* name : foreign)
    if (options.given(name))
      throw UsageError(std::string("--") + name + " does not go with --method " + options.text("method"));
}

UpsampleParameters
readUpsampleParameters(const Options& options, const LoadedCloud& cloud)
{
  UpsampleParameters p;
  p.method = isEdgeAware(options) ? UpsamplingMethod::EdgeAware : UpsamplingMethod::MovingLeastSquares;
  p.mls_order = static_cast<unsigned>(options.count("mls-order"));
  p.mls_seed = options.count("seed");
  EdgeAwareUpsamplingParameters& e = p.edge_aware;
  e.number_of_threads = threadCount(options);
  const CloudScale scale = measureCloud(cloud, e.number_of_threads);
  e.radius = options.length("radius").resolve(scale);
  if (options.given("count")) {
    e.target_count = options.count("count");
    if (e.target_count < cloud.finite)
      throw UsageError("--count is " + std::to_string(e.target_count) + ", but the cloud has " + std::to_string(cloud.finite) +
                       " points already");
  }
  else if (options.given("spacing")) {
    e.spacing = options.length("spacing").resolve(scale);
    if (!(e.spacing > 0.0))
      throw UsageError("--spacing must be a length, not auto");
  }
  else
    e.factor = options.number("factor");
  e.edge_sensitivity = options.number("edge-sensitivity");
  e.angle = options.number("angle");
  e.sign_invariant = !options.given("oriented");
  return p;
}

} // namespace pcl_gpf
