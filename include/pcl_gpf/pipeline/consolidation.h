// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/common/abi_check.h>
#include <pcl_gpf/common/export.h>
#include <pcl_gpf/common/pack.h>
#include <pcl_gpf/pipeline/consolidate.h>

#include <pcl/PolygonMesh.h>
#include <pcl/surface/processing.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_gpf {

/** \brief What Consolidation did, after process(). */
struct ConsolidationStatistics {
  std::size_t input_points = 0; ///< finite ones
  ConsolidationResult chain;    ///< statistics and seconds of all stages, lengths in cloud units; its arrays are empty
  bool cancelled = false;       ///< the progress callback returned false; the outputs are empty
};

/** \brief The whole chain on a cloud: normals, noise filter, orientation, upsampling and mesh; consolidate() for PCL.
  *
  * \code
  * pcl_gpf::Consolidation<pcl::PointXYZRGBNormal> consolidation; // normals may be missing: 0 or NaN
  * consolidation.setInputCloud(scan);
  * pcl::PointCloud<pcl::PointXYZRGBNormal> clean;
  * pcl::PolygonMesh mesh;
  * consolidation.process(clean, mesh);
  * \endcode
  * - The cloud is what the last stage before the mesh made: the finite points of setIndices() (all by default), filtered, in
  *   their order, then those that upsampling inserted; height 1. An index given twice counts once.
  * - Each point, and each vertex of the mesh, is a copy of an input point as a whole, colour, intensity and label included,
  *   with position and normal replaced; getCorrespondingIndices() and getMeshCorrespondingIndices() tell which.
  * - process(output) alone leaves the stage mesh out.
  * - Header and sensor pose are the input's; is_dense is set by fact. The output may be the input cloud itself.
  * - Where ConsolidationParameters::viewpoint is not set, parts are oriented toward sensor_origin_ unless it is 0, 0, 0, as
  *   `pcl_gpf_tool run` does; see setUseSensorOrigin().
  * - No input cloud: PCL's error message and empty outputs. Nothing finite: a warning and empty outputs.
  * - After cancellation and exceptions both outputs are empty (a cloud that is the input stays as it was), and the object can
  *   be used again.
  *
  * \throws pcl::BadArgumentException if a parameter or an index is out of range, the target lies below the number of points, or
  * the stages make a mesh of points without normals; pcl::ComputeFailedException if the points are too few, identical or on one
  * line, or a resolution or target takes more than there is room for: all before the work wherever the input tells.
  * Results equal consolidate() rounded to float. Cost: that of the stages; 36 bytes a point for the input in double.
  * Thread safety: one object, one thread at a time; the result does not depend on the number of threads.
  * \ingroup surface
  */
template <typename PointT>
class Consolidation : public pcl::CloudSurfaceProcessing<PointT, PointT> {
  static_assert(pcl::traits::has_xyz_v<PointT> && pcl::traits::has_normal_v<PointT>,
                "pcl_gpf::Consolidation needs a point type with xyz and normal fields, for example pcl::PointXYZRGBNormal; "
                "copy the cloud into one with pcl::copyPointCloud(), normals that are 0 are estimated");

public:
  using Ptr = pcl::shared_ptr<Consolidation<PointT>>;
  using ConstPtr = pcl::shared_ptr<const Consolidation<PointT>>;
  using PointCloud = pcl::PointCloud<PointT>;

  /** \brief Stages and all their parameters; lengths in cloud units. process() checks them. */
  void setParameters(const ConsolidationParameters& parameters) { parameters_ = parameters; }
  const ConsolidationParameters& getParameters() const { return parameters_; }

  /** \brief Threads; 0 = all that the process may use. Default 0. */
  void setNumberOfThreads(unsigned threads) { parameters_.number_of_threads = threads; }
  unsigned getNumberOfThreads() const { return parameters_.number_of_threads; }

  /** \brief Whether a sensor_origin_ other than 0, 0, 0 is the viewpoint where the parameters have none. Default true. */
  void setUseSensorOrigin(bool use) { use_sensor_origin_ = use; }
  bool getUseSensorOrigin() const { return use_sensor_origin_; }

  /** \brief Called with the stage and the fraction done of the whole, from the calling thread; if it returns false, process()
    * prints a warning and leaves empty outputs, and getStatistics().cancelled is true. Default none. */
  void setProgressCallback(const StageProgress& callback) { progress_ = callback; }

  /** \brief All stages but the mesh. */
  void
  process(PointCloud& output) override;
  /** \brief All stages. \param[out] mesh empty where the stage is not chosen; mesh.cloud holds PointT */
  void
  process(PointCloud& output, pcl::PolygonMesh& mesh);

  /** \brief After process(): for each output point the input index of the point that it is, or was copied from. */
  const pcl::Indices& getCorrespondingIndices() const { return corresponding_; }
  /** \brief The same for each vertex of the mesh. */
  const pcl::Indices& getMeshCorrespondingIndices() const { return mesh_corresponding_; }

  /** \brief What the last process() did. */
  const ConsolidationStatistics& getStatistics() const { return statistics_; }

protected:
  /** \brief All stages but the mesh, with the output's header and pose as they are. */
  void
  performProcessing(PointCloud& output) override;

private:
  void
  runInto(PointCloud& output, pcl::PolygonMesh* mesh);
  void
  runStages(PointCloud& output, pcl::PolygonMesh* mesh);
  ConsolidationParameters
  effectiveParameters(bool with_mesh) const;
  void
  copyParents(const pcl::Indices& chosen, const std::vector<std::uint32_t>& rows, PointCloud& points, pcl::Indices& from) const;
  void
  writeCloud(const pcl::Indices& chosen, const ConsolidatedCloud& cloud, PointCloud& output);
  void
  writeMesh(const pcl::Indices& chosen, const MeshResult& made, pcl::PolygonMesh& mesh);

  ConsolidationParameters parameters_;
  bool use_sensor_origin_ = true;
  StageProgress progress_;
  pcl::Indices corresponding_;
  pcl::Indices mesh_corresponding_;
  ConsolidationStatistics statistics_;
};

} // namespace pcl_gpf

#ifdef PCL_NO_PRECOMPILE
#include <pcl_gpf/pipeline/impl/consolidation.hpp>
#endif
