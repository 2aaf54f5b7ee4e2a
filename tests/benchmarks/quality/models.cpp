// SPDX-License-Identifier: BSD-3-Clause
#include "models.h"
#include "analytic_models.h"
#include "mesh_surface.h"
#include "numbers.h"
#include "star_model.h"

#include <pcl_gpf/core/sampling.h>

#include <cmath>
#include <stdexcept>

namespace pcl_gpf::quality {

namespace {

constexpr double kDefaultGradient = 4, kDefaultGap = 4;

Model
makeSheets(double gap_in_spacings, std::size_t count)
{
  constexpr double kArea = 2;
  const double gap = gap_in_spacings * std::sqrt(kArea / static_cast<double>(count));
  return {"sheets", sheetsSurface(gap), 0, gap};
}

} // namespace

Model
makeModel(const std::string& name, std::size_t count)
{
  const std::size_t colon = name.find(':');
  const std::string base = name.substr(0, colon), rest = colon == std::string::npos ? "" : name.substr(colon + 1);
  Model model;
  if (base == "mesh")
    model.surface = sharedMeshSurface(rest);
  else if (name == "star")
    model.surface = starSurface();
  else if (base == "sheets")
    model = makeSheets(rest.empty() ? kDefaultGap : toNumber(rest), count);
  else if (base == "cube-graded" || base == "block-graded") {
    model.surface = analyticSurface(base.substr(0, base.find('-')));
    model.density_gradient = rest.empty() ? kDefaultGradient : toNumber(rest);
  } else if (rest.empty())
    model.surface = analyticSurface(base);
  if (!model.surface)
    throw std::invalid_argument("there is no model \"" + name + "\"; there are " + kModelNames);
  model.name = name;
  return model;
}

std::vector<SurfaceSample>
sampleModel(const Model& model, std::size_t count, std::uint64_t seed)
{
  if (model.density_gradient == 0)
    return model.surface->sample(count, seed);
  const BoundingBox box = model.surface->box();
  const double rate = model.density_gradient / box.diagonal();
  const double densest = rate > 0 ? box.max[0] : box.min[0];
  std::vector<SurfaceSample> kept;
  SplitMix64 random(seed);
  while (kept.size() < count)
    for (const SurfaceSample& s : model.surface->sample(4 * count, random.next()))
      if (random.uniform() < std::exp(rate * (s.point[0] - densest)) && kept.size() < count)
        kept.push_back(s);
  return kept;
}

double
spacingOf(const Model& model, std::size_t count)
{
  return std::sqrt(model.surface->area() / static_cast<double>(count));
}

} // namespace pcl_gpf::quality
