// SPDX-License-Identifier: BSD-3-Clause
#include "result_cloud.h"
#include "charts.h"

#include <pcl_gpf/io/write_cloud.h>

#include <cmath>
#include <cstdio>

namespace pcl_gpf::quality {

namespace {

bool
isFinite(const Position& p)
{
  return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
}

} // namespace

std::string
cloudFileName(const Record& record)
{
  char noise[40];
  std::snprintf(noise, sizeof noise, "_%g_", record.noise.percent);
  return fileSafe(seriesOf(record) + noise + record.method) + ".ply";
}

void
writeResultCloud(const std::string& path, const NoisyCloud& cloud, const MethodResult& result)
{
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < result.points.size(); ++i)
    if (isFinite(result.points[i]))
      kept.push_back(i);
  const bool has_normals = result.normals.size() == result.points.size();
  CloudFile file;
  file.width = static_cast<std::uint32_t>(kept.size());
  for (const char* name : {"x", "y", "z"})
    file.addField(name, FieldType::Float64);
  for (const char* name : {"normal_x", "normal_y", "normal_z"})
    if (has_normals)
      file.addField(name, FieldType::Float32);
  const int distance = file.addField("distance", FieldType::Float32);
  const double unit = 1e-4 * cloud.model.surface->diagonal();
  for (std::size_t row = 0; row < kept.size(); ++row) {
    const Position& p = result.points[kept[row]];
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      file.setValue(row, axis, p[a]);
      if (has_normals)
        file.setValue(row, 3 + axis, result.normals[kept[row]][a]);
    }
    file.setValue(row, distance, std::abs(cloud.model.surface->nearest(p).signed_distance) / unit);
  }
  WriteOptions options;
  options.format = CloudFormat::PlyLittleEndian;
  options.overwrite = true;
  writeCloud(file, path, options);
}

} // namespace pcl_gpf::quality
