// SPDX-License-Identifier: BSD-3-Clause
#include "json_report.h"

#include "console.h"
#include "options.h"

#include <pcl_gpf/io/atomic_file.h>
#include <pcl_gpf/version.h>

#include <nlohmann/json.hpp>

#include <sys/resource.h>

namespace pcl_gpf {

nlohmann::ordered_json
newReport(const std::string& command)
{
  nlohmann::ordered_json report;
  report["schema"] = "pcl_gpf." + command + "/1";
  report["version"] = PCL_GPF_VERSION;
  return report;
}

void
writeReport(const nlohmann::ordered_json& report, const Options& options)
{
  if (!options.given("json"))
    return;
  // File names need not be UTF-8; JSON must be.
  const auto replace = nlohmann::ordered_json::error_handler_t::replace;
  const std::string text = report.dump(2, ' ', false, replace) + "\n";
  if (options.text("json") == "-")
    return printToStandardOutput(text);
  AtomicFile file(options.text("json"), options.given("overwrite"));
  file.write(text.data(), text.size());
  file.commit();
}

std::size_t
peakMemory()
{
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
#ifdef __APPLE__
  return static_cast<std::size_t>(usage.ru_maxrss);
#else
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024; // Linux counts kibibytes
#endif
}

} // namespace pcl_gpf
