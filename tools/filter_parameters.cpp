// SPDX-License-Identifier: BSD-3-Clause
#include "filter_parameters.h"

#include "console.h"
#include "option_values.h"

#include <algorithm>
#include <utility>

namespace pcl_gpf {

namespace {

using P = DenoiseParameters;
template <typename T>
using Access = std::function<T&(P&)>;

/** Reads through an accessor that wants a struct to write to. */
template <typename T>
T
peek(const Access<T>& access, P parameters)
{
  return access(parameters);
}

FilterParameter
length(const std::string& name, const std::string& field, const Access<double>& access, const std::string& help)
{
  return {{name, OptionKind::Length, "LENGTH", "auto", help},
          field,
          [access](P& p, const std::string& text, const CloudScale& scale) {
            access(p) = parseLength(text).value().resolve(scale);
          },
          [access](const P& p) { return ParameterValue(peek(access, p)); }};
}

FilterParameter
number(const std::string& name, const std::string& field, const Access<double>& access, double least, double most,
       const std::string& help)
{
  OptionSpec option{name, OptionKind::Number, "X", shortNumber(peek(access, P{})), help};
  option.least = least;
  option.most = most;
  return {option, field,
          [access](P& p, const std::string& text, const CloudScale&) { access(p) = parseNumber(text).value(); },
          [access](const P& p) { return ParameterValue(peek(access, p)); }};
}

FilterParameter
count(const std::string& name, const std::string& field, const Access<unsigned>& access, double most, const std::string& help)
{
  OptionSpec option{name, OptionKind::Count, "N", std::to_string(peek(access, P{})), help};
  option.least = 0;
  option.most = most;
  return {option, field,
          [access](P& p, const std::string& text, const CloudScale&) {
            access(p) = static_cast<unsigned>(parseCount(text).value());
          },
          [access](const P& p) { return ParameterValue(std::uint64_t{peek(access, p)}); }};
}

/** One of some words, each of which stands for a value. */
template <typename T>
FilterParameter
words(const std::string& name, const std::string& field, const Access<T>& access,
      const std::vector<std::pair<std::string, T>>& values, const std::string& help)
{
  const auto word_of = [access, values](const P& p) {
    for (const auto& [word, value] : values)
      if (value == peek(access, p))
        return word;
    return std::string();
  };
  OptionSpec option{name, OptionKind::Choice, "", word_of(P{}), help};
  for (const auto& [word, value] : values)
    option.choices.push_back(word);
  return {option, field,
          [access, values](P& p, const std::string& text, const CloudScale&) {
            for (const auto& [word, value] : values)
              if (word == text)
                access(p) = value;
          },
          [word_of](const P& p) { return ParameterValue(word_of(p)); }};
}

FilterParameter
onOff(const std::string& name, const std::string& field, const Access<bool>& access, const std::string& help)
{
  return words<bool>(name, field, access, {{"on", true}, {"off", false}}, help);
}

FilterParameter
above(FilterParameter parameter)
{
  parameter.option.above_least = true;
  return parameter;
}

FilterParameter
below(FilterParameter parameter)
{
  parameter.option.below_most = true;
  return parameter;
}

std::vector<FilterParameter>
projectionParameters()
{
  return {
      length("radius", "gpf.support_radius", [](P& p) -> double& { return p.gpf.support_radius; },
             "support radius h: larger smooths more and takes longer, detail below h / 2 goes"),
      count("iterations", "gpf.maximum_iterations", [](P& p) -> unsigned& { return p.gpf.maximum_iterations; }, 10000,
            "most iterations; 0 copies the points"),
      number("repulsion", "gpf.repulsion_weight", [](P& p) -> double& { return p.gpf.repulsion_weight; }, 0, 0.5,
             "repulsion mu between points; above 0 they also move along the surface, towards an even spread"),
      below(number("outlier-weight", "gpf.outlier_weight", [](P& p) -> double& { return p.gpf.outlier_weight; }, 0, 1,
                   "weight omega of outliers in the mixture: larger flags more; weighs in the filter with --posterior-normalization on")),
      number("initial-variance", "gpf.initial_variance", [](P& p) -> double& { return p.gpf.initial_variance; }, 0, 1e6,
             "first sigma^2 of the mixture, in units of the squared box diagonal; 0 = (h / 2)^2"),
      words<VarianceUpdate>("variance-update", "gpf.variance_update",
                            [](P& p) -> VarianceUpdate& { return p.gpf.variance_update; },
                            {{"fixed", VarianceUpdate::Fixed}, {"one-dof", VarianceUpdate::OneDegreeOfFreedom},
                             {"paper", VarianceUpdate::Paper}},
                            "how sigma^2 goes on; paper collapses and stops filtering, for reproduction only"),
      words<DataTerm>("data-term", "gpf.data_term", [](P& p) -> DataTerm& { return p.gpf.data_term; },
                      {{"symmetric", DataTerm::Symmetric}, {"point-to-plane", DataTerm::PointToPlane}},
                      "which planes pull; point-to-plane (the paper) inflates curved parts"),
      onOff("posterior-normalization", "gpf.posterior_normalization",
            [](P& p) -> bool& { return p.gpf.posterior_normalization; },
            "divide the weights of an input point among the points that claim it (eq. 3)"),
      onOff("density-weights", "gpf.density_weights", [](P& p) -> bool& { return p.gpf.density_weights; },
            "weigh down dense parts of the input"),
      above(number("normal-angle", "gpf.normal_angle", [](P& p) -> double& { return p.gpf.normal_angle; }, 0, 90,
                   "degrees between normals at which points hardly pull each other; 90 = normals do not matter")),
      number("normal-weight-floor", "gpf.normal_weight_floor",
             [](P& p) -> double& { return p.gpf.normal_weight_floor; }, 0, 1,
             "share of the pull that does not depend on normals; 1 = the paper"),
      onOff("own-tangent-repulsion", "gpf.own_tangent_repulsion",
            [](P& p) -> bool& { return p.gpf.own_tangent_repulsion; },
            "keep repulsion in each point's own tangent plane, so that edges stay clean"),
      count("gap-filling", "gpf.gap_iterations", [](P& p) -> unsigned& { return p.gpf.gap_iterations; }, 100,
            "rounds after the iterations in which points piled up on edges spread over the empty bands beside them"),
      number("gap-radius", "gpf.gap_radius_factor", [](P& p) -> double& { return p.gpf.gap_radius_factor; }, 1, 8,
             "reach of gap filling in units of h / 2"),
      number("convergence-threshold", "gpf.convergence_threshold",
             [](P& p) -> double& { return p.gpf.convergence_threshold; }, 0, 1,
             "stop when the mean movement is below this share of h; 0 = run all iterations"),
      length("max-move", "max_move", [](P& p) -> double& { return p.max_move; },
             "no point is moved further than this, exactly so in the written numbers"),
      number("strength", "strength", [](P& p) -> double& { return p.strength; }, 0.5, 2,
             "times the measured noise that lengths are estimated from; more smooths more"),
      onOff("two-scales", "two_scales", [](P& p) -> bool& { return p.two_scales; },
            "filter at two scales and keep the finer result where the coarser one took detail away")};
}

std::vector<FilterParameter>
normalParameters()
{
  return {
      length("normal-radius", "normals.radius", [](P& p) -> double& { return p.normals.radius; },
             "radius of the plane fits that give first normals"),
      length("bilateral-radius", "bilateral.radius", [](P& p) -> double& { return p.bilateral.radius; },
             "radius of the bilateral normal filter"),
      count("bilateral-neighbors", "bilateral.neighbors", [](P& p) -> unsigned& { return p.bilateral.neighbors; }, 1000,
            "k nearest neighbours (3 or more) instead of --bilateral-radius; 0 = the radius"),
      above(number("bilateral-angle", "bilateral.angle", [](P& p) -> double& { return p.bilateral.angle; }, 0, 90,
                   "degrees between normals at which they are hardly averaged; smaller keeps weaker edges")),
      count("bilateral-iterations", "bilateral.iterations", [](P& p) -> unsigned& { return p.bilateral.iterations; }, 1000,
            "rounds of the bilateral normal filter; 0 leaves the normals"),
      onOff("bilateral-sign-invariant", "bilateral.sign_invariant",
            [](P& p) -> bool& { return p.bilateral.sign_invariant; },
            "flip opposite normals before averaging; off needs oriented normals")};
}

} // namespace

const std::vector<FilterParameter>&
filterParameters()
{
  static const std::vector<FilterParameter> parameters = [] {
    std::vector<FilterParameter> list = projectionParameters();
    for (FilterParameter& parameter : normalParameters())
      list.push_back(std::move(parameter));
    return list;
  }();
  return parameters;
}

std::vector<FilterParameter>
selectParameters(const std::vector<std::string>& fields)
{
  std::vector<FilterParameter> selected;
  for (const std::string& field : fields)
    for (const FilterParameter& parameter : filterParameters())
      if (parameter.field == field)
        selected.push_back(parameter);
  return selected;
}

} // namespace pcl_gpf
