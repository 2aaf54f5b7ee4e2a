// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/common/point_types.h>
#include <pcl_gpf/pipeline/impl/consolidation.hpp>

#include <pcl/impl/instantiate.hpp>
#include <pcl/point_types.h>

PCL_INSTANTIATE(Consolidation, PCL_GPF_POINT_TYPES)
