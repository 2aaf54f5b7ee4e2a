// SPDX-License-Identifier: BSD-3-Clause
#include "io/format_writers.h"
#include "io/viewpoint_text.h"
#include "io/write_blocks.h"

namespace pcl_gpf {

namespace {

std::string columnNames(const OutputLayout& layout) {
  std::string names;
  for (const CloudField& field : layout.fields) {
    for (std::uint32_t k = 0; k < field.count; ++k) {
      names += ' ' + field.name;
      if (field.count > 1) names += '_' + std::to_string(k);
    }
  }
  return names;
}

} // namespace

void writeXyz(const CloudFile& cloud, const ByteSink& sink) {
  const OutputLayout layout = xyzLayout(cloud);
  std::string text;
  for (const std::string& comment : commentLines(cloud))
    text += "# " + comment + '\n';
  if (cloud.viewpoint != kIdentityViewpoint) text += "# viewpoint " + viewpointText(cloud.viewpoint) + '\n';
  text += "# columns:" + columnNames(layout) + '\n';
  sink(text.data(), text.size());
  writeTextRows(cloud, layout, ListLengths::None, sink);
}

} // namespace pcl_gpf
