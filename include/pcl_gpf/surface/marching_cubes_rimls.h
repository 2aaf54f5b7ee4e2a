// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/common/abi_check.h>
#include <pcl_gpf/common/export.h>
#include <pcl_gpf/common/pack.h>
#include <pcl_gpf/core/iteration.h>
#include <pcl_gpf/core/operators/rimls_mesh.h>

#include <pcl/surface/marching_cubes.h>

#include <cstddef>
#include <string>
#include <vector>

namespace pcl_gpf {

/** \brief What MarchingCubesRIMLS did, after reconstruct(). */
struct MarchingCubesRIMLSStatistics {
  std::size_t points = 0;                ///< with finite position and a normal: those that make the surface
  std::size_t points_without_normal = 0; ///< left out
  std::size_t non_finite_points = 0;     ///< left out
  RimlsMeshStatistics mesh;              ///< lengths in cloud units
  double seconds = 0;                    ///< of the whole call
  bool cancelled = false;                ///< the progress callback returned false; the output is empty
};

/** \brief Mesh of the surface that points and their normals define, by robust implicit moving least squares; edges stay.
 *
 * Oeztireli, Guennebaud, Gross, **Feature Preserving Point Set Surfaces based on Non-Linear Kernel Regression**,
 * Eurographics 2009. Unlike PCL's other marching cubes it evaluates the function only where the surface is: time and
 * memory are proportional to the surface, not to the box.
 * \code
 * pcl_gpf::MarchingCubesRIMLS<pcl::PointNormal> rimls; // cloud: normals filtered and oriented consistently
 * rimls.setInputCloud(cloud);
 * rimls.setResolution(300);
 * pcl::PolygonMesh mesh;
 * rimls.reconstruct(mesh);
 * \endcode
 * - Vertices are shared and have normals (the gradient). A vertex is a copy of the nearest input point on the same side of
 *   the edge, colour and intensity included, with position and normal replaced. Faces are counterclockwise from outside.
 * - Closed where the points are. There is no sheet beyond the support: elsewhere the mesh ends beside the last points.
 * - The finite points of setIndices() with a normal make the surface, all points by default.
 * - No input cloud: an error message and an empty output; nothing finite: a warning and an empty output.
 * - The cloud of vertices may be the input cloud itself.
 * - After cancellation and exceptions the output is empty (a cloud that is the input stays after an exception), and the object can
 *   be used again.
 * \note Normals must be oriented consistently. If a tenth of them or more contradict their surface, reconstruct() throws;
 * setCheckOrientation() leaves that out.
 * \note Of the base class's settings, setGridResolution() counts by its largest number: cells are cubes.
 * setPercentageExtendGrid() has no meaning here, and setIsoLevel() must stay 0.
 *
 * \throws pcl::BadArgumentException if a parameter or an index is out of range or normals are missing or not oriented,
 * pcl::ComputeFailedException for fewer than 4 points, points in one place, and a resolution that takes more memory than
 * allowed, before the work starts
 * Thread safety: one object, one thread at a time; the result does not depend on the number of threads. Parameters:
 * RimlsMeshParameters.
 * \ingroup surface
 */
template <typename PointT>
class MarchingCubesRIMLS : public pcl::MarchingCubes<PointT> {
public:
  using Ptr = pcl::shared_ptr<MarchingCubesRIMLS<PointT>>;
  using ConstPtr = pcl::shared_ptr<const MarchingCubesRIMLS<PointT>>;
  using PointCloud = pcl::PointCloud<PointT>;

  MarchingCubesRIMLS();
  ~MarchingCubesRIMLS() override;

  /** \brief All parameters at once; lengths in cloud units. */
  void
  setParameters(const RimlsMeshParameters& parameters);
  RimlsMeshParameters
  getParameters() const;

  /** \brief Cells along the longest side of the box, 2 .. 65536. Default 200. The same as setGridResolution(cells, ...). */
  void setResolution(unsigned cells) { this->setGridResolution(static_cast<int>(cells), static_cast<int>(cells), static_cast<int>(cells)); }
  /** \brief Edge of a cell instead, cloud units; 0 = from the resolution. Default 0. */
  void setCellSize(double size) { parameters_.cell_size = size; }
  /** \brief Support radius in local radii, 1 .. 100. Default 6. */
  void setScale(double scale) { parameters_.rimls.scale = scale; }
  /** \brief sigma_n, weight of normals, 0.001 .. 1e6: 0.5 sharp, 1.5 smooth. Default 0.75. */
  void setSigmaN(double sigma) { parameters_.rimls.sigma_n = sigma; }
  /** \brief Parts smaller than this share of the largest are removed, 0 .. 1. Default 0.01. */
  void setSmallestComponent(double share) { parameters_.smallest_component = share; }
  /** \brief Most bytes for lattice and mesh. Default 2 GiB. */
  void setMemoryLimit(std::size_t bytes) { parameters_.memory_limit = bytes; }
  /** \brief Threads; 0 = all that the process may use. Default 0. */
  void setNumberOfThreads(unsigned threads) { parameters_.number_of_threads = threads; }
  /** \brief Whether reconstruct() refuses normals without consistent orientation. Default true. */
  void setCheckOrientation(bool check) { check_orientation_ = check; }
  bool getCheckOrientation() const { return check_orientation_; }

  /** \brief Called with the fraction done, from the calling thread; if it returns false, reconstruct() prints a warning and
   * leaves an empty output, and getStatistics().cancelled is true. Default none. */
  void setProgressCallback(const ProgressCallback& callback) { progress_ = callback; }

  void
  reconstruct(pcl::PolygonMesh& output) override;
  void
  reconstruct(PointCloud& points, std::vector<pcl::Vertices>& polygons) override;

  /** \brief After reconstruct(): for each vertex the input index of the point that it was copied from. */
  const pcl::Indices& getCorrespondingIndices() const { return corresponding_; }
  /** \brief What the last reconstruct() did. */
  const MarchingCubesRIMLSStatistics& getStatistics() const { return statistics_; }

protected:
  void
  performReconstruction(pcl::PolygonMesh& output) override;
  void
  performReconstruction(PointCloud& points, std::vector<pcl::Vertices>& polygons) override;
  /** \brief Not used: there is no dense grid. */
  void voxelizeData() override {}
  std::string getClassName() const override { return "MarchingCubesRIMLS"; }

private:
  SurfaceMesh
  makeMesh(const PackedCloud& packed);
  void
  writeMesh(const PackedCloud& packed, const SurfaceMesh& mesh, PointCloud& points, std::vector<pcl::Vertices>& polygons);

  RimlsMeshParameters parameters_; // resolution is kept by the base
  bool check_orientation_ = true;
  ProgressCallback progress_;
  pcl::Indices corresponding_;
  MarchingCubesRIMLSStatistics statistics_;
};

} // namespace pcl_gpf

#ifdef PCL_NO_PRECOMPILE
#include <pcl_gpf/surface/impl/marching_cubes_rimls.hpp>
#endif
