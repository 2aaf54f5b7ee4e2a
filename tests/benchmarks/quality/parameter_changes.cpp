// SPDX-License-Identifier: BSD-3-Clause
#include "parameter_changes.h"
#include "numbers.h"

#include <pcl_gpf/pipeline/presets.h>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <vector>

namespace pcl_gpf::quality {

namespace {

/** One part of the method off or replaced. To add an ablation, add a line. */
struct Ablation {
  const char* name;
  const char* meaning;
  void (*apply)(DenoiseParameters&);
};

const Ablation kAblations[] = {
    {"prismatic", "the preset", [](DenoiseParameters& p) { p = prismaticPreset(); }},
    {"freeform", "the preset", [](DenoiseParameters& p) { p = freeformPreset(); }},
    {"no-symmetric", "the paper's point-to-plane term (also: point-to-plane)",
     [](DenoiseParameters& p) { p.gpf.data_term = DataTerm::PointToPlane; }},
    {"point-to-plane", "same as no-symmetric", [](DenoiseParameters& p) { p.gpf.data_term = DataTerm::PointToPlane; }},
    {"no-normal-weights", "data weights without normals", [](DenoiseParameters& p) { p.gpf.normal_angle = 90; }},
    {"no-weight-floor", "each face by itself", [](DenoiseParameters& p) { p.gpf.normal_weight_floor = 0; }},
    {"no-bilateral", "normals of plane fits as they are", [](DenoiseParameters& p) { p.bilateral.iterations = 0; }},
    {"one-iteration", "", [](DenoiseParameters& p) { p.gpf.maximum_iterations = 1; }},
    {"one-scale", "the lengths of a filter that runs alone", [](DenoiseParameters& p) { p.two_scales = false; }},
    {"no-steered-fit", "the fine scale as GPF leaves it", [](DenoiseParameters& p) { p.steered.passes = 0; }},
    {"no-thin-parts", "no finest scale", [](DenoiseParameters& p) { p.thin_parts = false; }},
    {"no-quadric-fit", "smooth parts as planes leave them", [](DenoiseParameters& p) { p.quadric.levels = 0; }},
    {"no-pooled-misfit", "each quadric judged by its own misfit", [](DenoiseParameters& p) { p.quadric.pooling = 0; }},
    {"no-limit", "moves of any length",
     [](DenoiseParameters& p) { p.max_move = std::numeric_limits<double>::infinity(); }},
    {"keep-outliers", "outliers stay among the data of the others",
     [](DenoiseParameters& p) { p.flags.outliers = false; }},
    {"posterior", "eq. 3's normalisation, sigma still fixed",
     [](DenoiseParameters& p) { p.gpf.posterior_normalization = true; }},
    {"one-degree", "sigma updated with one degree of freedom, posteriors normalised",
     [](DenoiseParameters& p) {
       p.gpf.posterior_normalization = true;
       p.gpf.variance_update = VarianceUpdate::OneDegreeOfFreedom;
     }},
    {"density-weights", "eq. 10's weights", [](DenoiseParameters& p) { p.gpf.density_weights = true; }},
    {"repulsion", "mu-hat 0.2", [](DenoiseParameters& p) { p.gpf.repulsion_weight = 0.2; }},
    {"plain-repulsion", "mu-hat 0.2, eq. 10 as printed",
     [](DenoiseParameters& p) {
       p.gpf.repulsion_weight = 0.2;
       p.gpf.own_tangent_repulsion = false;
     }},
};

/** A number that can be set. Lengths are given in percent of the box diagonal of the model. */
struct Setting {
  const char* name;
  const char* unit;
  void (*apply)(DenoiseParameters&, double value, double percent_of_diagonal);
};

const Setting kSettings[] = {
    {"h", "% of the diagonal", [](DenoiseParameters& p, double v, double unit) { p.gpf.support_radius = v * unit; }},
    {"normal-radius", "% of the diagonal",
     [](DenoiseParameters& p, double v, double unit) { p.normals.radius = v * unit; }},
    {"bilateral-radius", "% of the diagonal",
     [](DenoiseParameters& p, double v, double unit) { p.bilateral.radius = v * unit; }},
    {"bilateral-angle", "degrees", [](DenoiseParameters& p, double v, double) { p.bilateral.angle = v; }},
    {"bilateral-iterations", "rounds",
     [](DenoiseParameters& p, double v, double) { p.bilateral.iterations = static_cast<unsigned>(v); }},
    {"iterations", "rounds",
     [](DenoiseParameters& p, double v, double) { p.gpf.maximum_iterations = static_cast<unsigned>(v); }},
    {"normal-angle", "degrees", [](DenoiseParameters& p, double v, double) { p.gpf.normal_angle = v; }},
    {"weight-floor", "share", [](DenoiseParameters& p, double v, double) { p.gpf.normal_weight_floor = v; }},
    {"variance", "in the frame of diagonal 1",
     [](DenoiseParameters& p, double v, double) { p.gpf.initial_variance = v; }},
    {"repulsion-weight", "mu-hat", [](DenoiseParameters& p, double v, double) { p.gpf.repulsion_weight = v; }},
    {"strength", "times the noise", [](DenoiseParameters& p, double v, double) { p.strength = v; }},
    {"outlier-weight", "omega", [](DenoiseParameters& p, double v, double) { p.gpf.outlier_weight = v; }},
    {"sample-ratio", "share of the points", [](DenoiseParameters& p, double v, double) { p.gpf.sample_ratio = v; }},
};

ParameterChange
parseOne(const std::string& text)
{
  const std::size_t equals = text.find('=');
  const std::string name = text.substr(0, equals);
  if (equals == std::string::npos) {
    for (const Ablation& a : kAblations)
      if (name == a.name)
        return [&a](DenoiseParameters& p, const NoisyCloud&) { a.apply(p); };
  } else {
    for (const Setting& s : kSettings)
      if (name == s.name)
        return [&s, value = toNumber(text.substr(equals + 1))](DenoiseParameters& p, const NoisyCloud& cloud) {
          s.apply(p, value, 0.01 * cloud.model.surface->diagonal());
        };
  }
  throw std::invalid_argument("there is no change \"" + text + "\"; there are\n" + describeChanges());
}

std::string
line(const std::string& name, const std::string& meaning)
{
  return "    " + name + std::string(name.size() < 28 ? 28 - name.size() : 1, ' ') + meaning + "\n";
}

} // namespace

ParameterChange
parseChanges(const std::string& text)
{
  std::vector<ParameterChange> changes;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('+', begin), text.size());
    changes.push_back(parseOne(text.substr(begin, end - begin)));
    begin = end + 1;
  }
  return [changes](DenoiseParameters& p, const NoisyCloud& cloud) {
    for (const ParameterChange& change : changes)
      change(p, cloud);
  };
}

std::string
describeChanges()
{
  std::string text;
  for (const Ablation& a : kAblations)
    text += line(a.name, a.meaning);
  for (const Setting& s : kSettings)
    text += line(std::string(s.name) + "=", s.unit);
  return text;
}

} // namespace pcl_gpf::quality
