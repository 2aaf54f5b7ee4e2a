// SPDX-License-Identifier: BSD-3-Clause
// The whole chain on a pcl::PointCloud without normals: filter, orientation and mesh in one call.
#include <pcl_gpf/pipeline/consolidation.h>

#include <pcl/PolygonMesh.h>
#include <pcl/conversions.h>
#include <pcl/point_types.h>

#include <cmath>
#include <cstdio>
#include <exception>
#include <random>
#include <string>
#include <vector>

/** \brief Vertices with normals and the colours of the points that they come from. */
static pcl::PolygonMesh
toPolygonMesh(const pcl_gpf::MeshResult& mesh, const pcl::PointCloud<pcl::PointXYZRGB>& source)
{
  pcl::PointCloud<pcl::PointXYZRGBNormal> vertices;
  for (std::size_t v = 0; v < mesh.source_rows.size(); ++v) {
    pcl::PointXYZRGBNormal point;
    point.x = static_cast<float>(mesh.vertices[3 * v]);
    point.y = static_cast<float>(mesh.vertices[3 * v + 1]);
    point.z = static_cast<float>(mesh.vertices[3 * v + 2]);
    point.normal_x = mesh.normals[3 * v];
    point.normal_y = mesh.normals[3 * v + 1];
    point.normal_z = mesh.normals[3 * v + 2];
    point.rgba = source[mesh.source_rows[v]].rgba;
    vertices.push_back(point);
  }
  pcl::PolygonMesh result;
  pcl::toPCLPointCloud2(vertices, result.cloud);
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
    pcl::Vertices triangle;
    for (std::size_t corner = 0; corner < 3; ++corner)
      triangle.vertices.push_back(static_cast<pcl::index_t>(mesh.triangles[t + corner]));
    result.polygons.push_back(triangle);
  }
  return result;
}

int
main()
try {
  // A noisy ball, red above and blue below; yours comes from a file or a sensor.
  pcl::PointCloud<pcl::PointXYZRGB> cloud;
  std::mt19937 random;
  std::normal_distribution<float> normal;
  for (int i = 0; i < 10000; ++i) {
    const float x = normal(random), y = normal(random), z = normal(random);
    const float scale = (1.0f + 0.005f * normal(random)) / std::sqrt(x * x + y * y + z * z);
    pcl::PointXYZRGB point;
    point.x = scale * x;
    point.y = scale * y;
    point.z = scale * z;
    point.r = z > 0 ? 255 : 0;
    point.b = z > 0 ? 0 : 255;
    cloud.push_back(point);
  }

  std::vector<double> x, y, z;
  for (const pcl::PointXYZRGB& point : cloud) {
    x.push_back(static_cast<double>(point.x));
    y.push_back(static_cast<double>(point.y));
    z.push_back(static_cast<double>(point.z));
  }
  pcl_gpf::DenoiseInput input;
  input.x = x.data();
  input.y = y.data();
  input.z = z.data();
  input.size = cloud.size();

  pcl_gpf::ConsolidationParameters parameters;
  parameters.meshing.rimls.resolution = 80;
  const pcl_gpf::ConsolidationResult result =
      pcl_gpf::consolidate(input, parameters, [](const std::string& stage, double fraction) {
        std::printf("\r%-12s %3.0f %%", stage.c_str(), 100 * fraction);
        return true; // false would cancel
      });
  const pcl::PolygonMesh mesh = toPolygonMesh(result.mesh, cloud);

  std::printf("\nnoise %.4f, %zu triangles, %zu edges at borders, %.2f s\n", result.denoise.scale.noise, mesh.polygons.size(),
              result.mesh.open_edges, result.seconds.total);
  return result.mesh.open_edges == 0 && mesh.polygons.size() > 10000 ? 0 : 1;
}
catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
