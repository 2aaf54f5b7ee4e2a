// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/common/exceptions.h>
#include <pcl_gpf/core/errors.h>

#include <pcl/exceptions.h>

namespace pcl_gpf {
namespace {

// PCL stores this pointer, so it has to be a literal; no file name, which would be a path of the build machine.
constexpr const char* kFunction = "pcl_gpf";

} // namespace

void
rethrowAsPclException(const std::string& class_name)
{
  try {
    throw;
  }
  catch (const InvalidParameter& error) {
    throw pcl::BadArgumentException(class_name + ": " + error.what(), nullptr, kFunction);
  }
  catch (const UnsuitableData& error) {
    throw pcl::ComputeFailedException(class_name + ": " + error.what(), nullptr, kFunction);
  }
  catch (const ExcessiveWork& error) {
    throw pcl::ComputeFailedException(class_name + ": " + error.what(), nullptr, kFunction);
  }
}

} // namespace pcl_gpf
