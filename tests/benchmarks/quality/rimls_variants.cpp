// SPDX-License-Identifier: BSD-3-Clause
#include "rimls_variants.h"
#include "stopwatch.h"

#include <pcl_gpf/core/local_frame.h>
#include <pcl_gpf/core/operators/rimls.h>
#include <pcl_gpf/core/soa_buffer.h>
#include <pcl_gpf/pipeline/orient.h>

#include <cstdio>

namespace pcl_gpf::quality {

namespace {

/** Who says which side of the surface is outside. */
enum class Signs { Estimated, Truth };

/** The cloud as orientCloud() takes it, with the noisy points' normals. */
struct OrientedCloud {
  OrientedCloud(const NoisyCloud& cloud, unsigned threads, Signs signs)
  {
    for (const Position& p : cloud.points)
      for (std::size_t axis = 0; axis < 3; ++axis)
        axes[axis].push_back(p[axis]);
    DenoiseInput input{axes[0].data(), axes[1].data(), axes[2].data(), cloud.points.size()};
    DenoiseParameters parameters;
    parameters.number_of_threads = threads;
    normals = denoiseNormals(input, parameters);
    if (signs == Signs::Truth)
      takeSignsFrom(cloud.clean);
    else
      orient(input, threads);
  }

  std::vector<double> axes[3];
  DenoiseResult normals;

private:
  void
  orient(DenoiseInput input, unsigned threads)
  {
    input.normal_x = normals.normal_x.data();
    input.normal_y = normals.normal_y.data();
    input.normal_z = normals.normal_z.data();
    NormalOrientationParameters parameters;
    parameters.number_of_threads = threads;
    OrientResult oriented = orientCloud(input, parameters);
    normals.normal_x = std::move(oriented.normal_x);
    normals.normal_y = std::move(oriented.normal_y);
    normals.normal_z = std::move(oriented.normal_z);
  }

  void
  takeSignsFrom(const std::vector<SurfaceSample>& clean)
  {
    for (std::size_t i = 0; i < clean.size(); ++i) {
      const Position n = {normals.normal_x[i], normals.normal_y[i], normals.normal_z[i]};
      if (dot(n, clean[i].normal) >= 0)
        continue;
      for (std::vector<float>* const component : {&normals.normal_x, &normals.normal_y, &normals.normal_z})
        (*component)[i] = -(*component)[i];
    }
  }
};

MethodResult
project(const OrientedCloud& cloud, const RimlsParameters& parameters)
{
  const std::size_t size = cloud.axes[0].size();
  BoundingBox box;
  for (std::size_t i = 0; i < size; ++i)
    box.add(cloud.axes[0][i], cloud.axes[1][i], cloud.axes[2][i]);
  const LocalFrame frame = localFrame(box);
  SoaBuffer positions(size), normals(size), made(size);
  for (std::size_t i = 0; i < size; ++i) {
    positions.x[i] = frame.toLocal(cloud.axes[0][i], 0);
    positions.y[i] = frame.toLocal(cloud.axes[1][i], 1);
    positions.z[i] = frame.toLocal(cloud.axes[2][i], 2);
    normals.x[i] = made.x[i] = cloud.normals.normal_x[i];
    normals.y[i] = made.y[i] = cloud.normals.normal_y[i];
    normals.z[i] = made.z[i] = cloud.normals.normal_z[i];
  }
  RimlsParameters local = parameters;
  local.radius = frame.lengthToLocal(parameters.radius);
  RimlsSurface(local, positions.view(), normals.view()).project(positions.view(), made.view());
  MethodResult result;
  for (std::size_t i = 0; i < size; ++i) {
    result.points.push_back(
        {frame.toWorld(positions.x[i], 0), frame.toWorld(positions.y[i], 1), frame.toWorld(positions.z[i], 2)});
    result.normals.push_back({made.x[i], made.y[i], made.z[i]});
    result.seeds.push_back(static_cast<std::uint32_t>(i));
  }
  return result;
}

Variant
variant(const std::string& setting, double radius_in_diagonals, RimlsParameters parameters, Signs signs)
{
  return {setting, [=](const NoisyCloud& cloud, unsigned threads) {
            RimlsParameters used = parameters;
            used.radius = radius_in_diagonals * cloud.model.surface->diagonal();
            used.number_of_threads = threads;
            const Stopwatch watch;
            MethodResult result = project(OrientedCloud(cloud, threads, signs), used);
            watch.writeTo(result);
            return result;
          }};
}

/** Radii of 1.5 to 15 % of the diagonal; normals weighed sharply and smoothly, residuals or not. */
std::vector<Variant>
grid()
{
  struct Widths {
    double normals, residuals;
  };
  std::vector<Variant> variants;
  for (const double radius : {0.015, 0.025, 0.04, 0.06, 0.1, 0.15})
    for (const Widths& widths : {Widths{0.75, 0}, Widths{0.75, 0.5}, Widths{1.5, 0}}) {
      RimlsParameters parameters;
      parameters.accuracy = 1e-2; // of the spacing, far below the errors measured
      parameters.sigma_n = widths.normals;
      parameters.sigma_r = widths.residuals;
      char setting[80];
      std::snprintf(setting, sizeof setting, "r %g %% sigma_n %g sigma_r %g", 100 * radius, widths.normals,
                    widths.residuals);
      variants.push_back(variant(setting, radius, parameters, Signs::Truth));
    }
  return variants;
}

} // namespace

std::vector<Variant>
rimlsVariants(const std::string& name)
{
  if (name == "rimls")
    return {variant("scale 4", 0, RimlsParameters(), Signs::Estimated)};
  if (name == "rimls-best")
    return grid();
  return {};
}

} // namespace pcl_gpf::quality
