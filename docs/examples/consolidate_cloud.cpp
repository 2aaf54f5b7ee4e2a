// SPDX-License-Identifier: BSD-3-Clause
// The whole chain on a coloured cloud without normals: filter, orientation, upsampling and mesh in one call.
#include <pcl_gpf/pipeline/consolidation.h>

#include <pcl/PolygonMesh.h>
#include <pcl/conversions.h>
#include <pcl/exceptions.h>
#include <pcl/point_types.h>

#include <cmath>
#include <cstdio>
#include <random>
#include <string>

using Cloud = pcl::PointCloud<pcl::PointXYZRGBNormal>;

/** \brief A noisy ball, red above and blue below; yours comes from a file or a sensor. */
static Cloud::Ptr
noisyBall(int count, float sigma)
{
  Cloud::Ptr cloud(new Cloud);
  std::mt19937 random;
  std::normal_distribution<float> normal;
  for (int i = 0; i < count; ++i) {
    const float x = normal(random), y = normal(random), z = normal(random);
    const float scale = (1.0f + sigma * normal(random)) / std::sqrt(x * x + y * y + z * z);
    pcl::PointXYZRGBNormal point; // its normal is 0: to be estimated
    point.x = scale * x;
    point.y = scale * y;
    point.z = scale * z;
    point.r = z > 0 ? 255 : 0;
    point.b = z > 0 ? 0 : 255;
    cloud->push_back(point);
  }
  return cloud;
}

int
main()
try {
  pcl_gpf::ConsolidationParameters parameters;
  parameters.upsample = true; // twice as many points
  parameters.meshing.rimls.resolution = 80;

  pcl_gpf::Consolidation<pcl::PointXYZRGBNormal> consolidation;
  consolidation.setInputCloud(noisyBall(10000, 0.005f));
  consolidation.setParameters(parameters);
  consolidation.setProgressCallback([](const std::string& stage, double fraction) {
    std::printf("\r%3.0f %% %-12s", 100 * fraction, stage.c_str());
    return true; // false would cancel
  });
  Cloud clean;
  pcl::PolygonMesh mesh;
  consolidation.process(clean, mesh);

  const pcl_gpf::ConsolidationResult& did = consolidation.getStatistics().chain;
  std::printf("\nnoise %.4f, %zu points, %zu triangles, %zu edges at borders, %.2f s\n", did.denoise.scale.noise, clean.size(),
              mesh.polygons.size(), did.mesh.open_edges, did.seconds.total);
  Cloud vertices;
  pcl::fromPCLPointCloud2(mesh.cloud, vertices);
  for (const pcl::PointXYZRGBNormal& vertex : vertices)
    if (std::abs(vertex.z) > 0.1f && (vertex.r == 255) != (vertex.z > 0))
      return 1; // colours stay where they were
  return did.mesh.open_edges == 0 && clean.size() == 20000 && mesh.polygons.size() > 10000 ? 0 : 1;
}
catch (const pcl::PCLException& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
