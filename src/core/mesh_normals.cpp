// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/surface_mesh.h>

#include <cmath>

namespace pcl_gpf {

namespace {

/** Sums of the faces' normals, weighted by area. */
SoaBuffer
faceNormals(const SurfaceMesh& mesh)
{
  const SoaBuffer& v = mesh.vertices;
  SoaBuffer sums(mesh.vertexCount());
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
    const std::size_t a = mesh.triangles[t], b = mesh.triangles[t + 1], c = mesh.triangles[t + 2];
    const float u[3] = {v.x[b] - v.x[a], v.y[b] - v.y[a], v.z[b] - v.z[a]};
    const float w[3] = {v.x[c] - v.x[a], v.y[c] - v.y[a], v.z[c] - v.z[a]};
    for (const std::size_t k : {a, b, c}) {
      sums.x[k] += u[1] * w[2] - u[2] * w[1];
      sums.y[k] += u[2] * w[0] - u[0] * w[2];
      sums.z[k] += u[0] * w[1] - u[1] * w[0];
    }
  }
  return sums;
}

/** \return false when the vector has no direction */
bool
normalise(MutableVectorsView vectors, std::size_t i)
{
  const double x = vectors.x[i], y = vectors.y[i], z = vectors.z[i], length = std::sqrt(x * x + y * y + z * z);
  if (!(length > 0.0) || !std::isfinite(length))
    return false;
  vectors.x[i] = static_cast<float>(x / length);
  vectors.y[i] = static_cast<float>(y / length);
  vectors.z[i] = static_cast<float>(z / length);
  return true;
}

} // namespace

void
completeNormals(SurfaceMesh& mesh)
{
  SoaBuffer instead;
  for (std::size_t i = 0; i < mesh.vertexCount(); ++i) {
    if (normalise(mesh.normals.view(), i))
      continue;
    if (instead.size() == 0)
      instead = faceNormals(mesh);
    const bool found = normalise(instead.view(), i);
    mesh.normals.x[i] = found ? instead.x[i] : 0.0f;
    mesh.normals.y[i] = found ? instead.y[i] : 0.0f;
    mesh.normals.z[i] = found ? instead.z[i] : 1.0f;
  }
}

} // namespace pcl_gpf
