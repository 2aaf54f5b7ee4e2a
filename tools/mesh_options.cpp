// SPDX-License-Identifier: BSD-3-Clause
#include "mesh_options.h"

#include "console.h"
#include "option_groups.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pcl_gpf {

namespace {

OptionSpec
choice(const std::string& name, std::vector<std::string> choices, const std::string& help)
{
  OptionSpec spec{name, OptionKind::Choice, "", choices.front(), help};
  spec.choices = std::move(choices);
  return spec;
}

OptionSpec
count(const std::string& name, unsigned default_value, double least, double most, const std::string& help)
{
  OptionSpec spec{name, OptionKind::Count, "N", std::to_string(default_value), help};
  spec.least = least;
  spec.most = most;
  return spec;
}

OptionSpec
number(const std::string& name, double default_value, double least, double most, const std::string& help)
{
  OptionSpec spec{name, OptionKind::Number, "X", shortNumber(default_value), help};
  spec.least = least;
  spec.most = most;
  return spec;
}

/** An option that the other method does not have. */
void
refuseForeign(const Options& options, const std::vector<const char*>& names, const std::string& method)
{
  for (const char* name : names)
    if (options.given(name))
      throw UsageError("--" + std::string(name) + " has no meaning with --method " + method);
}

/** Levels that have at least as many cells as --resolution says. */
unsigned
octreeDepth(const Options& options)
{
  return static_cast<unsigned>(std::max(2.0, std::ceil(std::log2(static_cast<double>(options.count("resolution"))))));
}

constexpr double kBytesPerMebibyte = 1024.0 * 1024.0;

void
readRimls(const Options& options, const CloudScale& scale, RimlsMeshParameters& rimls)
{
  rimls.resolution = static_cast<unsigned>(options.count("resolution"));
  rimls.cell_size = options.length("cell").resolve(scale);
  rimls.rimls.scale = options.number("scale");
  rimls.rimls.radius = options.length("radius").resolve(scale);
  rimls.rimls.sigma_n = options.number("sigma-n");
  rimls.rimls.sigma_r = options.number("sigma-r");
  rimls.project_vertices = !options.given("no-projection");
  rimls.smallest_component = options.number("smallest");
  rimls.largest_hole = static_cast<unsigned>(options.count("holes"));
  rimls.memory_limit = static_cast<std::size_t>(static_cast<double>(options.count("memory")) * kBytesPerMebibyte);
}

void
readPoisson(const Options& options, PoissonMeshParameters& poisson)
{
  poisson.depth = octreeDepth(options);
  poisson.point_weight = options.number("point-weight");
  poisson.trim = options.number("trim");
  poisson.smallest_component = options.number("smallest");
}

} // namespace

std::vector<OptionSpec>
meshOptions()
{
  const RimlsMeshParameters rimls;
  const PoissonMeshParameters poisson;
  return {choice("method", {"rimls", "poisson"}, "rimls: sharp edges, ends where the points do; poisson: smooth, closes gaps"),
          count("resolution", rimls.resolution, 2, 65536,
                "cells along the longest side; poisson: rounded up to a power of two"),
          {"cell", OptionKind::Length, "LENGTH", "auto", "edge of a cell; auto: from the resolution (rimls)"},
          number("scale", rimls.rimls.scale, 1, 100,
                 "support radius in local radii, each 1.1 spacings; less: detail and noise, more: smoother (rimls)"),
          {"radius", OptionKind::Length, "LENGTH", "auto", "support radius of all points; auto: from the scale (rimls)"},
          number("sigma-n", rimls.rimls.sigma_n, 0.001, 1e6, "weight of normals, 0.5 sharp, 1.5 smooth (rimls)"),
          number("sigma-r", rimls.rimls.sigma_r, 0, 1e6, "weight of residuals as a share of the support radius, 0 = off (rimls)"),
          {"no-projection", OptionKind::Flag, "", "", "leave vertices on the edges of the cells (rimls)"},
          number("point-weight", poisson.point_weight, 0, 1000, "weight of points against normals (poisson)"),
          number("trim", poisson.trim, 0, 1e6, "drop triangles farther than this many spacings from all points, 0 = none (poisson)"),
          number("smallest", rimls.smallest_component, 0, 1, "drop parts smaller than this share of the largest one's triangles"),
          count("holes", rimls.largest_hole, 0, 1000, "close holes of at most this many edges (rimls)"),
          count("memory", 2048, 1, 1048576, "most memory for cells and mesh, MiB (rimls)"),
          choice("orientation", {"auto", "file", "orient"},
                 "auto: orient normals that contradict each other; file: take them as they are; orient: always")};
}

void
checkMeshOptions(const Options& options)
{
  if (options.text("method") == "poisson") {
    refuseForeign(options, {"cell", "scale", "radius", "sigma-n", "sigma-r", "no-projection", "holes", "memory"}, "poisson");
    if (octreeDepth(options) > 12)
      throw UsageError("--resolution " + options.text("resolution") + ": --method poisson goes up to 4096");
  } else
    refuseForeign(options, {"point-weight", "trim"}, "rimls");
}

MeshParameters
readMeshParameters(const Options& options, const LoadedCloud& cloud)
{
  MeshParameters parameters;
  parameters.number_of_threads = threadCount(options);
  const std::string& orientation = options.text("orientation");
  parameters.orientation = orientation == "file"     ? MeshOrientation::Keep
                           : orientation == "orient" ? MeshOrientation::Orient
                                                     : MeshOrientation::Auto;
  if (options.text("method") == "poisson") {
    parameters.method = MeshMethod::Poisson;
    readPoisson(options, parameters.poisson);
    return parameters;
  }
  const auto relative = [&options](const char* name) {
    const Length::Unit unit = options.length(name).unit;
    return unit == Length::Unit::Spacing || unit == Length::Unit::Diagonal;
  };
  const bool measured = relative("cell") || relative("radius");
  readRimls(options, measured ? measureCloud(cloud, parameters.number_of_threads) : CloudScale(), parameters.rimls);
  return parameters;
}

std::optional<std::array<double, 3>>
viewpointOf(const CloudFile& file)
{
  const std::array<double, 3> sensor{file.viewpoint[0], file.viewpoint[1], file.viewpoint[2]};
  return sensor == std::array<double, 3>{} ? std::nullopt : std::optional(sensor);
}

} // namespace pcl_gpf
