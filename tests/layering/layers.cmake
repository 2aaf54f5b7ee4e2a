# SPDX-License-Identifier: BSD-3-Clause
# The house's layers as data. For each place, the first expression that matches a file's path decides:
#   <regular expression of the path>  ->  own layers it may include | other libraries it may include
# "std" (the standard library and the system) is allowed everywhere; version.h belongs to the layer "version".
set(layer_rules
  "^include/pcl_gpf/version[.]h$ -> |"
  "^include/pcl_gpf/core/ -> core version|"
  "^src/core/parallel[.]cpp$ -> core version|tbb"
  "^src/core/(kernels/|simd[.]cpp$) -> core|hwy"
  "^src/core/(operators|analysis)/ -> core version|eigen"
  "^src/core/ -> core version|"
  "^(include/pcl_gpf|src)/common/ -> common core version|pcl eigen"
  "^(include/pcl_gpf|src)/io/ -> io common core version|pcl eigen"
  "^(include/pcl_gpf|src)/filters/ -> filters common core version|pcl eigen"
  "^(include/pcl_gpf|src)/surface/ -> surface common core version|pcl eigen"
  "^(include/pcl_gpf|src)/tiling/ -> tiling filters surface common core version|pcl eigen"
  "^(include/pcl_gpf|src)/pipeline/ -> pipeline filters surface common core version|pcl eigen"
  "^(include/pcl_gpf|src)/distributed/ -> distributed tiling common core version|pcl eigen mpi"
  "^tools/ -> tools version core common io filters surface pipeline tiling distributed|pcl eigen boost json")

# <regular expression of an include's text>  ->  library
set(library_rules
  "^pcl/ -> pcl" "^(Eigen|unsupported/Eigen)/ -> eigen" "^(tbb|oneapi)/ -> tbb" "^hwy/ -> hwy" "^boost/ -> boost"
  "^nlohmann/ -> json" "^(flann|vtk|Qt)[^ ]*/ -> other" "^mpi[.]h$ -> mpi" "^omp[.]h$ -> openmp")
